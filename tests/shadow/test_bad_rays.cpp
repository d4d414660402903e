// Rays that are missing or make no sense, and the split screen that shows them.
#include "catch.h"
#include "pictures.h"
#include <cstdio>
#include <limits>
#include <runner.h>

using namespace shadow;
using options::LightRay;
using options::Result;
using options::Runner;

namespace
{
constexpr glm::ivec2 kSize{96, 64};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Bad
{
    const char* name;
    float penumbra;
    bool isNoSample; // what its neighbours have stands in
};

const Bad kBad[] = {
    {"NaN", kNan, true},  {"-1", -1.0f, true}, {"-infinity", -kInfinity, true}, {"infinity", kInfinity, false},
    {"-0", -0.0f, false}, {"0", 0.0f, false},  {"a denormal", 6e-8f, false},    {"1e-30", 1e-30f, false}};

bool isDamaged(glm::ivec2 pixel, int frame) { return (pixel.x * 7 + pixel.y * 13 + frame * 5) % 23 == 0; }

options::Setup makeFloor(nrd::Denoiser denoiser)
{
    return makeSetup(denoiser, kSize, makeSun(90.0f, 0.0f, 0.1f), makeEdge(2.0f, 0.1f));
}

options::Setup damage(options::Setup setup, const Bad& bad)
{
    setup.rayAt = [rayAt = setup.rayAt, &bad](glm::vec3 P, glm::ivec2 pixel, int frame)
    {
        if (!isDamaged(pixel, frame)) return rayAt(P, pixel, frame);
        return LightRay{bad.penumbra, glm::vec4(bad.isNoSample ? kNan : 0.0f)};
    };
    return setup;
}

struct Findings
{
    size_t broken = 0;         // not in [0; 1]
    float darkest = 1.0f;      // visibility in the light, where the rays are whole
    float darkestStood = 1.0f; // ... where others stand in
};

void look(const Result& result, const Bad& bad, int frame, Findings& findings)
{
    for (int y = 0; y < kSize.y; y++)
    {
        for (int x = 0; x < kSize.x; x++)
        {
            const glm::vec4 v = result.outputs.at(nrd::ResourceType::OUT_SHADOW_TRANSLUCENCY)[result.frame.texel(x, y)];
            for (int c = 0; c < 4; c++) findings.broken += !(v[c] >= 0.0f && v[c] <= 1.0f);
            if (options::worldPosition(result.frame, x, y).x < 1.1f) continue;
            const bool isHurt = isDamaged({x, y}, frame);
            float& darkest = isHurt ? findings.darkestStood : findings.darkest;
            if (!isHurt || bad.isNoSample) darkest = std::min(darkest, v.x * v.x);
        }
    }
}

// Thin poles in front of the floor: hardly a pole's pixel has a neighbour that is one.
void plantPoles(options::Setup& setup)
{
    setup.scene = [scene = setup.scene](const quality::Camera& camera, glm::ivec2 size, int frame)
    {
        quality::Guides guides = scene(camera, size, frame);
        for (size_t i = 0; i < guides.viewZ.size(); i++)
            if (i % static_cast<size_t>(size.x) % 5 == 2) guides.viewZ[i] *= 0.5f;
        return guides;
    };
}
} // namespace

TEST_CASE("whatever a penumbra holds, outputs are shares of one, and no dot is larger than the damage", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        for (const Bad& bad : kBad)
        {
            for (const bool hasHistory : {true, false})
            {
                options::Setup setup = damage(makeFloor(denoiser), bad);
                setup.hasHistory = hasHistory;
                runner.start(setup);
                Findings findings;
                for (int frame = 0; frame < 6; frame++) look(runner.denoise(frame), bad, frame, findings);
                if (findings.darkest < 1.0f)
                    std::printf("FIGURE %s, %s in one ray of 23, %s: darkest of whole rays %.4f, of those %.4f\n",
                                nrd::toString(denoiser), bad.name, hasHistory ? "history" : "no history",
                                double(findings.darkest), double(findings.darkestStood));
                INFO(nrd::toString(denoiser) << ", " << bad.name << ", " << hasHistory);
                CHECK(findings.broken == 0);
                CHECK(findings.darkest > 0.9f);
                CHECK(findings.darkestStood == 1.0f);
            }
        }
    }
}

TEST_CASE("a checkerboard's holes on thin poles are no dark dots", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        for (const nrd::CheckerboardMode mode : {nrd::CheckerboardMode::BLACK, nrd::CheckerboardMode::WHITE})
        {
            options::Setup setup = makeFloor(denoiser);
            setup.sigmaSettings.checkerboardMode = mode;
            setup.rayAt = [](glm::vec3, glm::ivec2, int) { return LightRay{}; };
            plantPoles(setup);
            runner.start(setup);
            for (int frame = 0; frame < 3; frame++)
            {
                const Result result = runner.denoise(frame);
                size_t dark = 0;
                for (size_t i = 0; i < result.frame.guides.viewZ.size(); i++) dark += shadowOf(result, i).x != 1.0f;
                INFO(nrd::toString(denoiser) << ", frame " << frame);
                CHECK(dark == 0);
            }
        }
    }
}

TEST_CASE("the split screen shows the rays as they came, as square roots, and the rest as without it", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        options::Setup setup = makeFloor(denoiser);
        setup.rayAt = [rayAt = setup.rayAt](glm::vec3 P, glm::ivec2 pixel, int frame)
        {
            LightRay ray = rayAt(P, pixel, frame);
            if (ray.penumbra < 65504.0f) ray.translucency = {0.0f, 0.25f, 0.5f, 0.0f};
            return ray;
        };
        const Result plain = options::runFrames(runner, setup, 4);
        setup.changeCommon = [](nrd::CommonSettings& common, int) { common.splitScreen = 0.5f; };
        const Result split = options::runFrames(runner, setup, 4);
        const options::Plane &left = split.frame.noisy.at(nrd::ResourceType::OUT_SHADOW_TRANSLUCENCY),
                             &out = split.outputs.at(nrd::ResourceType::OUT_SHADOW_TRANSLUCENCY),
                             &right = plain.outputs.at(nrd::ResourceType::OUT_SHADOW_TRANSLUCENCY);
        size_t wrong = 0;
        for (int y = 0; y < kSize.y; y++)
        {
            for (int x = 0; x < kSize.x; x++)
            {
                const size_t i = split.frame.texel(x, y);
                const glm::vec4 difference = out[i] - (x < kSize.x / 2 ? left[split.frame.pixel(x, y)] : right[i]);
                for (int c = 0; c < 4; c++) wrong += !(std::abs(difference[c]) < (x < kSize.x / 2 ? 1e-3f : 1e-12f));
            }
        }
        CHECK(wrong == 0);
    }
}
