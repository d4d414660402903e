// The passes on the device against the same mathematics in double precision.
#include "catch.h"
#include "confidence.h"
#include "passes.h"
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <random>

using namespace confidence;

namespace
{
constexpr float kSky = 2000.0f; // beyond the denoising range
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

float toHalf(float value) { return glm::unpackHalf1x16(glm::packHalf1x16(value)); }
glm::vec4 toHalf(const glm::vec4& v) { return {toHalf(v.x), toHalf(v.y), toHalf(v.z), toHalf(v.w)}; }

struct Case
{
    Inputs device;
    nrdtest::ConfidenceInput reference;
};

// A floor one unit below the camera, which has a field of view of 90 degrees each way, a wall at six units, and sky in
// a corner.
nrdtest::ConfidenceTile tileAt(int x, int y)
{
    const glm::dvec3 ray((2 * x + 1.0) / kWidth - 1.0, 1.0 - (2 * y + 1.0) / kHeight, 1.0);
    const double floor = ray.y < 0.0 ? -1.0 / ray.y : 1e9;
    const bool isFloor = floor<6.0, isSky = x> kWidth - 8 && y < 8;
    const double viewZ = double(toHalf(isSky ? kSky : float(std::min(floor, 6.0))));
    nrdtest::ConfidenceTile tile;
    tile.stored.z = tile.retraced.z = viewZ;
    tile.position = ray * viewZ;
    tile.normal = isFloor ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    return tile;
}

// Octahedral, as NRD_FrontEnd_PackNormalAndRoughness has it for these two normals and a roughness of 1.
glm::vec4 guideOf(const nrdtest::ConfidenceTile& tile)
{
    return tile.normal.y > 0.5 ? glm::vec4(1.0f, 1.0f, 1.0f, 0.0f) : glm::vec4(0.5f, 0.5f, 0.0f, 0.0f);
}

glm::vec4 randomSample(std::mt19937& rng)
{
    std::lognormal_distribution<float> luminance(-0.35f, 0.8f);
    return toHalf(glm::vec4(luminance(rng), luminance(rng), 0.0f, 0.0f));
}

// Light changes by more and more from left to right, specular half as much; some tiles show another surface now.
Case makeCase(const nrd::ConfidenceSettings& settings)
{
    std::mt19937 rng(7);
    Case c;
    for (int i = 0; i < kWidth * kHeight; i++)
    {
        const int x = i % kWidth, y = i / kWidth;
        nrdtest::ConfidenceTile tile = tileAt(x, y);
        const float change = 0.35f * float(x) / kWidth;
        const glm::vec4 stored = randomSample(rng);
        const glm::vec4 now = toHalf(stored * glm::vec4(1.0f - change, 1.0f + 0.5f * change, 0.0f, 0.0f));
        if (rng() % 16 == 0) tile.retraced.z = double(toHalf(float(tile.stored.z) * (rng() % 2 ? 1.12f : 1.5f)));
        tile.stored = glm::dvec3(stored.x, stored.y, tile.stored.z);
        tile.retraced = glm::dvec3(now.x, now.y, tile.retraced.z);
        c.reference.tiles.push_back(tile);
        c.device.stored.emplace_back(tile.stored, 0.0f);
        c.device.retraced.emplace_back(tile.retraced, 0.0f);
        c.device.normalRoughness.push_back(guideOf(tile));
    }
    c.reference.width = kWidth;
    c.reference.height = kHeight;
    c.reference.planeDistance = 2.0 * double(settings.planeDistanceSensitivity); // the frustum's size at a depth of 1
    c.reference.denoisingRange = 1000.0;
    c.reference.sensitivity = double(settings.sensitivity);
    c.reference.tolerance = double(settings.tolerance);
    c.reference.minLuminance = double(settings.minLuminance);
    c.reference.maxLuminance = double(settings.maxLuminance);
    c.reference.blurPassNum = int(settings.blurPassNum);
    return c;
}

// The first frame has no history, whatever it is handed.
Outputs runSecond(const nrd::ConfidenceSettings& settings, const Inputs& inputs)
{
    Passes passes(settings);
    passes.run(inputs);
    return passes.run(inputs);
}

// Half floats round each pass's gradients and luminances by 2^-12 of themselves at the worst: after six of them a
// change of up to 1 / sensitivity is off by 0.3 %; then 8 bits round by half a step. Normals of ten bits tilt planes.
constexpr double kTolerance = 3.0 / 255.0;

void requireEqual(const Outputs& outputs, const std::vector<glm::dvec2>& expected)
{
    double worst = 0.0, least = 1.0, most = 0.0;
    for (size_t i = 0; i < expected.size(); i++)
    {
        worst = std::max(worst, std::abs(double(outputs.diffuse[i]) - expected[i].x));
        worst = std::max(worst, std::abs(double(outputs.specular[i]) - expected[i].y));
        least = std::min(least, expected[i].x);
        most = std::max(most, expected[i].x);
    }
    INFO("worst difference " << worst << ", confidences " << least << " to " << most);
    CHECK(worst < kTolerance);
    CHECK(least < 0.2); // the case shows the whole range
    CHECK(most == 1.0);
}
} // namespace

TEST_CASE("the passes agree with their formulas, however many blurs", "[gpu]")
{
    for (uint32_t num : {0u, 1u, 3u, 4u, 5u})
    {
        INFO(num << " blurs");
        nrd::ConfidenceSettings settings;
        settings.blurPassNum = num;
        const Case c = makeCase(settings);
        requireEqual(runSecond(settings, c.device), nrdtest::confidences(c.reference));
    }
}

TEST_CASE("every setting of confidence does what its formula says", "[gpu]")
{
    nrd::ConfidenceSettings settings;
    settings.sensitivity = 9.0f;
    settings.tolerance = 0.05f;
    settings.minLuminance = 0.5f;
    settings.maxLuminance = 0.9f;
    settings.planeDistanceSensitivity = 0.3f;
    const Case c = makeCase(settings);
    requireEqual(runSecond(settings, c.device), nrdtest::confidences(c.reference));
}

TEST_CASE("samples that are no numbers take no part", "[gpu]")
{
    nrd::ConfidenceSettings settings;
    Case c = makeCase(settings);
    for (const int i : {3, kWidth + 17, 5 * kWidth + 20, 12 * kWidth + 30})
    {
        c.device.stored[size_t(i)].x = kNan;
        c.device.retraced[size_t(i) + 1].y = std::numeric_limits<float>::infinity();
        c.reference.tiles[size_t(i)].stored.x = double(kNan);
        c.reference.tiles[size_t(i) + 1].retraced.y = INFINITY;
    }
    requireEqual(runSecond(settings, c.device), nrdtest::confidences(c.reference));
}

TEST_CASE("a frame without history is trusted in full, as is one in which nothing changed", "[gpu]")
{
    Case c = makeCase({});
    Passes passes;
    const Outputs first = passes.run(c.device);
    c.device.retraced = c.device.stored;
    const Outputs still = passes.run(c.device);
    for (const Outputs* outputs : {&first, &still})
        for (const std::vector<float>* lobe : {&outputs->diffuse, &outputs->specular})
            CHECK(*std::min_element(lobe->begin(), lobe->end()) == 1.0f);
}

TEST_CASE("confidence images of another size than the tiles' are refused by name", "[gpu]")
{
    Passes passes;
    CHECK_THAT(passes.refusalOf(kWidth + 1),
               containing("IN_DIFF_CONFIDENCE: the image is 41 x 24, but the resource size "
                          "is 40 x 24"));
}
