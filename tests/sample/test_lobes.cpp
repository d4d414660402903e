// Frames that trace one lobe per pixel: by chance or on a checkerboard.
#include "catch.h"
#include "engine/commands.h"
#include "engine/transfer.h"
#include "scene_cornell.h"
#include "tracer_fixture.h"

using namespace sample;

namespace
{
// The two lobes of one frame.
struct LobeFrame
{
    test::Pixels radiance[2]; // diffuse, specular; .w: hit distance
    test::Pixels direction[2];
    test::Pixels motion; // .w: material

    bool has(size_t lobe, size_t pixel) const { return radiance[lobe][pixel].w > 0.0f; }
};

// Frame after frame of a scene that stands still.
class FrameTracer
{
public:
    FrameTracer(const Scene& scene, const Environment* environment, const TracerDesc& desc, const Camera& camera)
        : m_tracer(test::device(), scene, environment, desc)
    {
        m_view.camera = camera;
        m_tracer.setPose(scene, ScenePose(scene), environment);
    }
    LobeFrame next()
    {
        engine::submitAndWait(test::device(), [&](VkCommandBuffer cmd) { m_tracer.recordFrame(cmd, m_view); });
        ++m_view.frameIndex;
        const auto read = [](engine::Image& image) { return engine::readBackAs<glm::vec4>(test::device(), image); };
        FrameImages& i = m_tracer.images();
        return {
            {read(i.diffuse), read(i.specular)}, {read(i.diffuseDirection), read(i.specularDirection)}, read(i.motion)};
    }

private:
    PathTracer m_tracer;
    View m_view;
};

constexpr int kWidth = 48, kHeight = 27;
constexpr float kMetal = 4.0f; // material of the Cornell box

FrameTracer cornellTracer(const Scene& scene, TracerDesc desc)
{
    desc.width = kWidth;
    desc.height = kHeight;
    return {scene, nullptr, desc, findCamera(scene, ScenePose(scene), 16.0f / 9.0f).value()};
}

// Mean over `frames` frames of both lobes in each of three horizontal strips.
std::array<std::array<glm::dvec3, 2>, 3> stripMeans(FrameTracer tracer, int frames)
{
    std::array<std::array<glm::dvec3, 2>, 3> means = {};
    for (int f = 0; f < frames; ++f)
    {
        const LobeFrame frame = tracer.next();
        const size_t count = frame.motion.size();
        for (size_t i = 0; i < count; ++i)
            for (size_t lobe = 0; lobe < 2; ++lobe)
                means[i * 3 / count][lobe] +=
                    glm::dvec3(frame.radiance[lobe][i]) * 3.0 / (double(count) * double(frames));
    }
    return means;
}

void checkEqualMeans(const std::function<FrameTracer(const TracerDesc&)>& create, int frames, double tolerance)
{
    TracerDesc desc;
    const auto both = stripMeans(create(desc), frames);
    desc.lobes = Lobes::Probabilistic;
    const auto one = stripMeans(create(desc), frames);
    for (size_t strip = 0; strip < 3; ++strip)
        for (size_t lobe = 0; lobe < 2; ++lobe)
        {
            INFO("strip " << strip << ", lobe " << lobe);
            CHECK(one[strip][lobe].g == Approx(both[strip][lobe].g).epsilon(tolerance));
        }
}

// Whether the 3x3 window around a pixel lies on surfaces that have both lobes, and has a sample of the lobe.
bool isDielectricWindow(const LobeFrame& frame, int x, int y)
{
    for (int i = 0; i < 9; ++i)
        if (frame.motion[size_t((y + i / 3 - 1) * kWidth + x + i % 3 - 1)].w == kMetal) return false;
    return true;
}

bool hasSample(const LobeFrame& frame, size_t lobe, int x, int y)
{
    for (int i = 0; i < 9; ++i)
        if (frame.has(lobe, size_t((y + i / 3 - 1) * kWidth + x + i % 3 - 1))) return true;
    return false;
}

size_t countWindowsWithout(const LobeFrame& frame, size_t lobe)
{
    size_t count = 0;
    for (int y = 1; y < kHeight - 1; ++y)
        for (int x = 1; x < kWidth - 1; ++x) count += isDielectricWindow(frame, x, y) && !hasSample(frame, lobe, x, y);
    return count;
}

size_t countNonZeroOfSkipped(const LobeFrame& frame)
{
    size_t count = 0;
    for (size_t i = 0; i < frame.motion.size(); ++i)
        for (size_t lobe = 0; lobe < 2; ++lobe)
            count += !frame.has(lobe, i) && (glm::vec3(frame.radiance[lobe][i]) != glm::vec3(0.0f) ||
                                             glm::vec3(frame.direction[lobe][i]) != glm::vec3(0.0f));
    return count;
}
} // namespace

TEST_CASE("frames of one lobe per pixel have the mean of frames of both, where light is even", "[gpu]")
{
    // From below the eye to the horizon, so that the share of reflected light goes from little to much. Even light
    // leaves hardly any noise: a probability that isn't met exactly, on average over time, would be seen.
    const Scene scene = test::makeScene({test::makeFloor(50.0f, 0)}, {test::makeMaterial(glm::vec3(0.2f), 0.0f, 0.4f)});
    const Environment sky = makeUniformEnvironment(glm::vec3(1.0f));
    const auto create = [&](TracerDesc desc)
    {
        desc.width = 16;
        desc.height = 24;
        return FrameTracer(scene, &sky, desc, lookAt({0, 1, 3}, {0, 0, 0}, 0.6f, 16.0f / 24.0f, 0.01f));
    };
    checkEqualMeans(create, 512, 0.01);
}

TEST_CASE("frames of one lobe per pixel have the mean of frames of both in the Cornell box", "[gpu]")
{
    const Scene scene = makeCornellBox();
    checkEqualMeans([&](const TracerDesc& desc) { return cornellTracer(scene, desc); }, 384, 0.03);
}

TEST_CASE("every 3x3 window of a probabilistic frame has both lobes, every pixel one", "[gpu]")
{
    const Scene scene = makeCornellBox();
    TracerDesc desc;
    desc.lobes = Lobes::Probabilistic;
    FrameTracer tracer = cornellTracer(scene, desc);
    size_t specularCount = 0, metalCount = 0, count = 0;
    for (int f = 0; f < 24; ++f)
    {
        const LobeFrame frame = tracer.next();
        CHECK(countWindowsWithout(frame, 0) == 0);
        CHECK(countWindowsWithout(frame, 1) == 0);
        CHECK(countNonZeroOfSkipped(frame) == 0);
        size_t wrongCount = 0;
        for (size_t i = 0; i < frame.motion.size(); ++i)
        {
            const bool isMetal = frame.motion[i].w == kMetal;
            wrongCount += frame.has(0, i) == frame.has(1, i) || (isMetal && frame.has(0, i));
            metalCount += isMetal;
            specularCount += !isMetal && frame.has(1, i);
            count += !isMetal;
        }
        CHECK(wrongCount == 0);
    }
    CHECK(metalCount > 1000);
    // The box is mostly plaster: its reflected share is small and held at the least probability.
    CHECK(double(specularCount) / double(count) == Approx(0.26).margin(0.04));
}

TEST_CASE("a checkerboard has each lobe in its half of the pixels, by turns", "[gpu]")
{
    const Scene scene = makeCornellBox();
    TracerDesc desc;
    desc.checkerboard = GENERATE(nrd::CheckerboardMode::BLACK, nrd::CheckerboardMode::WHITE);
    FrameTracer tracer = cornellTracer(scene, desc);
    FrameTracer full = cornellTracer(scene, TracerDesc());
    for (uint32_t f = 0; f < 2; ++f)
    {
        const LobeFrame frame = tracer.next(), both = full.next();
        CHECK(countNonZeroOfSkipped(frame) == 0);
        size_t wrongCount = 0, differentCount = 0;
        for (uint32_t i = 0; i < frame.motion.size(); ++i)
        {
            const bool isEven = ((i % kWidth + i / kWidth + f) & 1u) == 0;
            const bool isDiffuse = isEven == (desc.checkerboard == nrd::CheckerboardMode::BLACK);
            const bool isMetal = frame.motion[i].w == kMetal;
            wrongCount += frame.has(0, i) != (isDiffuse && !isMetal) || frame.has(1, i) == isDiffuse;
            // A sample is what it would be without a checkerboard: not multiplied.
            for (size_t lobe = 0; lobe < 2; ++lobe)
                differentCount += frame.has(lobe, i) && frame.radiance[lobe][i] != both.radiance[lobe][i];
        }
        CHECK(wrongCount == 0);
        CHECK(differentCount == 0);
    }
}
