// Nothing moves: for thousands of frames the mean stays, and two eyes see the same.
#include "catch.h"
#include "figures.h"
#include "levels.h"
#include "runners.h"
#include "scenes.h"
#include <map>

using namespace stability;

namespace
{
constexpr double kDrift = 0.2; // %, what the project promises
constexpr int kWarmUp = 64;    // frames, twice the longest history but REFERENCE's

struct Length
{
    int frames;
    int window; // frames whose mean is compared
};
Length driftLength() { return isLong() ? Length{4096, 256} : Length{192, 64}; }

// From the first window to the last, of the output where it is largest.
double driftOf(nrd::Denoiser denoiser)
{
    options::Setup setup = makeSetup(denoiser);
    setup.size = setup.rect = {32, 24};
    setup.isAntithetic = true; // the input's mean is the same in every window
    const Length length = driftLength();
    std::map<nrd::ResourceType, double> first, last;
    run(setup, length.frames,
        [&](int frame, const options::Result& result)
        {
            const bool isFirst = frame >= kWarmUp && frame < kWarmUp + length.window;
            const bool isLast = frame >= length.frames - length.window;
            if (!isFirst && !isLast) return;
            for (const Level& l : levelsOf(result, denoiser))
            {
                if (isFirst) first[l.output] += l.denoised;
                if (isLast) last[l.output] += l.denoised;
            }
        });
    double drift = 0.0;
    for (const auto& [output, sum] : first) drift = std::max(drift, 100.0 * std::abs(last[output] / sum - 1.0));
    return drift;
}
} // namespace

TEST_CASE("the mean of a static scene does not drift", "[gpu]")
{
    Figure figure("static scene, " + std::to_string(driftLength().frames) + " frames: drift of the mean", "%", kDrift);
    for (const nrd::Denoiser denoiser : denoisersThat(isWidest)) figure.add(denoiser, driftOf(denoiser));
}

namespace
{
constexpr int kEyeFrames = 12;
constexpr float kHalfEyeDistance = 0.0325f; // metres

struct Eye
{
    float x;
    unsigned seed;
};

options::Result see(nrd::Denoiser denoiser, Eye eye)
{
    options::Setup setup = makeSetup(denoiser);
    setup.seed = eye.seed;
    setup.camera = [eye](int) { return lookFrom({eye.x, 1.5f, -1.0f}, {0.0f, -0.1f, 1.0f}); };
    setup.meanAt = [](glm::vec3 p, glm::ivec2, int)
    { return 0.7f + 0.3f * std::sin(2.0f * p.x) * std::cos(2.0f * (p.y + p.z)); };
    return runToLast(setup, kEyeFrames);
}

// Where a point is seen in another picture, if it is.
std::optional<size_t> findPixel(const options::Frame& frame, glm::vec3 position)
{
    const quality::Camera& camera = frame.guides.camera;
    const glm::vec4 view = camera.worldToView * glm::vec4(position, 1.0f), clip = camera.viewToClip * view;
    const glm::vec2 uv = glm::vec2(0.5f, -0.5f) * glm::vec2(clip) / clip.w + 0.5f;
    const glm::ivec2 pixel(glm::floor(uv * glm::vec2(frame.rect)));
    if (glm::any(glm::lessThan(pixel, glm::ivec2(0))) || glm::any(glm::greaterThanEqual(pixel, frame.rect))) return {};
    constexpr float kSameDepth = 0.02f; // of the depth: a pixel's slope on the floor
    const size_t i = frame.pixel(pixel.x, pixel.y);
    if (std::abs(frame.guides.viewZ[i] - view.z) > kSameDepth * view.z) return {};
    return i;
}

// Root mean square difference of the errors that two pictures show of the same points.
double differenceOf(nrd::Denoiser denoiser, const options::Result& a, const options::Result& b)
{
    std::map<std::pair<nrd::ResourceType, size_t>, double> errors;
    for (const Level& l : levelsOf(b, denoiser))
        errors[{l.output, b.frame.pixel(l.pixel.x, l.pixel.y)}] = l.denoised - l.truth;
    double sum = 0.0, count = 0.0;
    for (const Level& l : levelsOf(a, denoiser))
    {
        const std::optional<size_t> pixel = findPixel(b.frame, l.position);
        if (!pixel) continue;
        const double difference = l.denoised - l.truth - errors.at({l.output, *pixel});
        sum += difference * difference;
        count += 1.0;
    }
    CHECK(count > 1000.0);
    return std::sqrt(sum / count);
}
} // namespace

TEST_CASE("two eyes see the same but for the noise", "[gpu]")
{
    // What the same eye sees with other noise is the measure; one in ten is what such a difference is known to.
    Figure figure("stereo pair: difference of the two views", "times that of their noise", 1.1);
    for (const nrd::Denoiser denoiser : someThat(isAny))
    {
        const options::Result left = see(denoiser, {-kHalfEyeDistance, 1});
        const options::Result again = see(denoiser, {-kHalfEyeDistance, 2});
        const options::Result right = see(denoiser, {kHalfEyeDistance, 3});
        figure.add(denoiser, differenceOf(denoiser, left, right) / differenceOf(denoiser, left, again));
    }
}
