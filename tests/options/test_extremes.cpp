// What RELAX makes of radiance to the limit of half floats, of what is no radiance, and of a constant.
#include "catch.h"
#include "measures.h"
#include "options.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>

using namespace options;
using Slot = nrd::ResourceType;

namespace
{
constexpr glm::ivec2 kSize{64, 48};
constexpr float kHalfMax = 65504.0f, kHitDist = 1.5f;
std::vector<nrd::Denoiser> relaxDenoisers()
{
    std::vector<nrd::Denoiser> result;
    std::copy_if(testedDenoisers().begin(), testedDenoisers().end(), std::back_inserter(result), isRelax);
    return result;
}

bool isDirections(Slot slot) { return slot == Slot::OUT_DIFF_SH1 || slot == Slot::OUT_SPEC_SH1; }
bool isSh0(Slot slot) { return slot == Slot::OUT_DIFF_SH0 || slot == Slot::OUT_SPEC_SH0; }

float lumaOf(Slot slot, glm::vec4 v) { return isSh0(slot) ? v.x : 0.25f * (v.x + v.z) + 0.5f * v.y; }

// [0; 1), another one for each pixel, frame and use.
float random(glm::ivec2 pixel, int frame, uint32_t use)
{
    uint32_t x =
        static_cast<uint32_t>(pixel.x + 4096 * pixel.y) * 0x9E3779B9u + static_cast<uint32_t>(frame) * 0x85EBCA6Bu;
    x = (x ^ (use * 0xC2B2AE35u)) * 0x27D4EB2Fu;
    x = (x ^ (x >> 15)) * 0x2C1B3C6Du;
    x = (x ^ (x >> 12)) * 0x297A2D39u;
    return static_cast<float>((x ^ (x >> 15)) >> 8) * (1.0f / 16777216.0f);
}

// Independent in each channel, so that hues are as extreme as brightness.
glm::vec3 brightColour(glm::ivec2 pixel, int frame)
{
    glm::vec3 colour;
    for (int i = 0; i < 3; i++)
        colour[i] = 1e4f + (kHalfMax - 1e4f) * random(pixel, frame, static_cast<uint32_t>(i + 1));
    if (random(pixel, frame, 7) < 0.25f) colour[static_cast<int>(3.0f * random(pixel, frame, 8))] = kHalfMax;
    return colour;
}

struct Input
{
    const char* name;
    glm::vec4 (*sampleAt)(glm::ivec2 pixel, int frame);
};

const Input kExtremes[] = {
    {"65504 everywhere", [](glm::ivec2, int) { return glm::vec4(kHalfMax); }},
    {"65504 in one channel",
     [](glm::ivec2 pixel, int)
     {
         glm::vec4 colour(1.0f, 1.0f, 1.0f, kHitDist);
         colour[(pixel.x / 8) % 3] = kHalfMax;
         return colour;
     }},
    {"65504 in one channel, by chance",
     [](glm::ivec2 pixel, int frame)
     {
         glm::vec4 colour(1e-4f, 1e-4f, 1e-4f, kHitDist);
         colour[static_cast<int>(3.0f * random(pixel, frame, 5))] = kHalfMax;
         return colour;
     }},
    {"65504 sprinkled", [](glm::ivec2 pixel, int frame)
     { return glm::vec4(glm::vec3(random(pixel, frame, 0) < 0.02f ? kHalfMax : 1.0f), kHitDist); }},
    {"1e4 to 65504 sprinkled",
     [](glm::ivec2 pixel, int frame)
     {
         const bool isBright = random(pixel, frame, 0) < 0.05f;
         return glm::vec4(isBright ? brightColour(pixel, frame) : glm::vec3(0.5f, 1.0f, 0.25f), kHitDist);
     }},
    {"1e4 to 65504 everywhere",
     [](glm::ivec2 pixel, int frame) { return glm::vec4(brightColour(pixel, frame), kHitDist); }},
    {"black or 65504", [](glm::ivec2 pixel, int frame)
     { return glm::vec4(glm::vec3(random(pixel, frame, 0) < 0.5f ? kHalfMax : 1e-3f), kHitDist); }},
    {"1 after 65504",
     [](glm::ivec2, int frame) { return glm::vec4(glm::vec3(frame < 6 ? kHalfMax : 1.0f), kHitDist); }},
};

glm::vec4 brokenSample(glm::ivec2 pixel, int frame)
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
    const glm::vec4 samples[] = {glm::vec4(kNan), {kInf, 1, 1, 1}, {1, -kInf, kNan, 1},
                                 {1, 1, 1, kNan}, {1, 1, 1, kInf}, {-kInf, 1, 1, kInf}};
    return samples[static_cast<size_t>(6.0f * random(pixel, frame, 3))];
}

bool isBroken(glm::ivec2 pixel, int frame) { return random(pixel, frame, 2) < 0.05f; }
bool hasNumbers(glm::vec4 v) { return std::isfinite(v.x + v.y + v.z + v.w); }

// Settings under which values take different ways.
const Option kWays[] = {
    {"defaults", [](Setup&) {}},
    {"no pre-pass",
     [](Setup& s) { s.relaxSettings.diffusePrepassBlurRadius = s.relaxSettings.specularPrepassBlurRadius = 0.0f; }},
    {"anti-firefly, no history fix",
     [](Setup& s)
     {
         s.relaxSettings.enableAntiFirefly = true;
         s.relaxSettings.historyFixFrameNum = 0;
         s.relaxSettings.diffusePrepassBlurRadius = s.relaxSettings.specularPrepassBlurRadius = 0.0f;
     }},
};

struct Findings
{
    size_t nonFinite = 0, dark = 0, negative = 0;
};

void look(const Result& result, Findings& findings)
{
    findings.nonFinite += countBroken(result);
    for (const auto& [slot, plane] : result.outputs)
    {
        if (isDirections(slot)) continue;
        forEachPixel(result.frame,
                     [&, &slot = slot, &plane = plane](size_t, size_t texel)
                     {
                         const glm::vec4 v = plane[texel];
                         findings.dark += !(lumaOf(slot, v) > 0.0f);
                         findings.negative += !isSh0(slot) && std::min({v.x, v.y, v.z}) < 0.0f;
                     });
    }
}

// Largest distance of any channel from what the input says, as a share of the largest channel; of radiance, or of the
// directions. Only where the input holds numbers.
double worstDeviation(const Result& result, bool isOfDirections)
{
    double worst = 0.0;
    for (const auto& [slot, plane] : result.outputs)
    {
        if (isDirections(slot) != isOfDirections) continue;
        const Plane& expected = result.frame.noisy.at(slot);
        forEachPixel(result.frame,
                     [&, &plane = plane](size_t pixel, size_t texel)
                     {
                         if (!hasNumbers(expected[pixel])) return;
                         const glm::vec3 d = glm::abs(glm::vec3(plane[texel] - expected[pixel]));
                         const glm::vec3 size = glm::abs(glm::vec3(expected[pixel]));
                         const float share = std::max({d.x, d.y, d.z}) / std::max({size.x, size.y, size.z});
                         worst = std::isfinite(share) ? std::max(worst, double(share)) : HUGE_VAL;
                     });
    }
    return worst;
}

struct Worst
{
    double radiance = 0.0, direction = 0.0;

    void add(const Result& result)
    {
        radiance = std::max(radiance, worstDeviation(result, false));
        direction = std::max(direction, worstDeviation(result, true));
    }
};

Worst runConstant(Runner& runner, nrd::Denoiser denoiser, float value, float speed)
{
    Setup setup = makeSetup(denoiser, kSize);
    setup.speed = speed;
    setup.sampleAt = [value](glm::ivec2, int) { return glm::vec4(value * glm::vec3(1.0f, 0.625f, 0.25f), kHitDist); };
    runner.start(setup);
    Worst worst;
    for (int frame = 0; frame < 12; frame++) worst.add(runner.denoise(frame));
    return worst;
}

double worstBesideBroken(Runner& runner, nrd::Denoiser denoiser, const Option& way)
{
    Setup setup = makeSetup(denoiser, kSize);
    setup.speed = 0.0f;
    setup.sampleAt = [](glm::ivec2 pixel, int frame)
    { return isBroken(pixel, frame) && frame > 0 ? brokenSample(pixel, frame) : glm::vec4(1, 1, 1, kHitDist); };
    way.apply(setup);
    runner.start(setup);
    Worst worst;
    for (int frame = 0; frame < 9; frame++) worst.add(runner.denoise(frame));
    return worst.radiance;
}
} // namespace

TEST_CASE("RELAX takes radiance to the limit of half floats", "[gpu]")
{
    for (const nrd::Denoiser denoiser : relaxDenoisers())
    {
        Runner runner(denoiser);
        for (const Input& input : kExtremes)
        {
            for (const Option& way : kWays)
            {
                Setup setup = makeSetup(denoiser, kSize);
                setup.sampleAt = input.sampleAt;
                way.apply(setup);
                runner.start(setup);
                Findings findings;
                for (int frame = 0; frame < 10; frame++) look(runner.denoise(frame), findings);
                INFO(nrd::toString(denoiser) << ", " << input.name << ", " << way.name);
                CHECK(findings.nonFinite == 0);
                CHECK(findings.dark == 0);
                CHECK(findings.negative == 0);
            }
        }
    }
}

TEST_CASE("what is no radiance leaves RELAX's pixels with a history as they would be without it", "[gpu]")
{
    for (const nrd::Denoiser denoiser : relaxDenoisers())
    {
        const bool isDiffuse = denoiser == nrd::Denoiser::RELAX_DIFFUSE || denoiser == nrd::Denoiser::RELAX_DIFFUSE_SH;
        Runner runner(denoiser);
        for (const Option& way : kWays)
            if (isDiffuse || &way != kWays) CHECK(worstBesideBroken(runner, denoiser, way) < 2e-3);
    }
}

// The pre-pass of a mirror finds no other sample, and says so.
TEST_CASE("what is no radiance leaves RELAX's mirrors as they would be without it, with a pre-pass", "[gpu]")
{
    Runner runner(nrd::Denoiser::RELAX_SPECULAR);
    CHECK(worstBesideBroken(runner, nrd::Denoiser::RELAX_SPECULAR, kWays[0]) < 2e-3);
}

TEST_CASE("what is no radiance from the first frame on never reaches RELAX's outputs", "[gpu]")
{
    for (const nrd::Denoiser denoiser : relaxDenoisers())
    {
        Runner runner(denoiser);
        for (const Option& way : kWays)
        {
            Setup setup = makeSetup(denoiser, kSize);
            setup.sampleAt = [](glm::ivec2 pixel, int frame)
            { return isBroken(pixel, frame) ? brokenSample(pixel, frame) : glm::vec4(1, 1, 1, kHitDist); };
            way.apply(setup);
            runner.start(setup);
            INFO(nrd::toString(denoiser) << ", " << way.name);
            for (int frame = 0; frame < 6; frame++) CHECK(countBroken(runner.denoise(frame)) == 0);
        }
    }
}

TEST_CASE("negative radiance counts as none to RELAX", "[gpu]")
{
    for (const nrd::Denoiser denoiser : relaxDenoisers())
    {
        Runner runner(denoiser);
        const auto run = [&](float bad)
        {
            Setup setup = makeSetup(denoiser, kSize);
            setup.sampleAt = [bad](glm::ivec2 pixel, int frame)
            { return glm::vec4(glm::vec3(isBroken(pixel, frame) ? bad : 1.0f), kHitDist); };
            return runFrames(runner, setup, 6);
        };
        const Result negative = run(-1000.0f), black = run(0.0f);
        INFO(nrd::toString(denoiser));
        CHECK(countBroken(negative) == 0);
        CHECK(countDifferent(negative, black) == 0);
    }
}

TEST_CASE("a constant stays constant in RELAX", "[gpu]")
{
    for (const nrd::Denoiser denoiser : relaxDenoisers())
    {
        Runner runner(denoiser);
        for (const float value : {1e-3f, 1.0f, 250.0f, 4e4f})
        {
            for (const float speed : {0.0f, 0.05f, 0.6f})
            {
                const Worst worst = runConstant(runner, denoiser, value, speed);
                std::printf("FIGURE %s, constant %g at speed %g: worst deviation %.3g, of directions %.3g\n",
                            nrd::toString(denoiser), double(value), double(speed), worst.radiance, worst.direction);
                INFO(nrd::toString(denoiser) << ", value " << value << ", speed " << speed);
                CHECK(worst.radiance <= 1.0 / 1024.0); // a half float's step
                // Two of ten bits' steps, of a largest component of 0.8: passes round directions at random.
                CHECK(worst.direction <= 2.0 / 511.0 / 0.8);
            }
        }
    }
}
