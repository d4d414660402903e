// The generated input is what a renderer's would be: geometry that the matrices agree with, plausible lobes, 2 % sky.
#include "catch.h"

#include "bench_inputs.h"

#include "engine/transfer.h"

#include <nrd/integration.h>

#include <algorithm>
#include <cmath>

using namespace sample;
using namespace sample::bench;

namespace
{
constexpr Extent kSize = {128, 72};
constexpr size_t kPixelCount = size_t(kSize.width) * kSize.height;

struct Texel
{
    float x, y, z, w;
};

// Every content as floats, whatever format its slot has in the benchmark.
const std::vector<BenchSlot>& slots()
{
    using nrd::ResourceType;
    constexpr VkFormat kFloats = VK_FORMAT_R32G32B32A32_SFLOAT;
    static const std::vector<BenchSlot> rows = {
        {ResourceType::IN_NORMAL_ROUGHNESS, Family::None, kFloats, BENCH_NORMAL_ROUGHNESS, false, false},
        {ResourceType::IN_VIEWZ, Family::None, VK_FORMAT_R32_SFLOAT, BENCH_VIEWZ, false, false},
        {ResourceType::IN_DIFF_RADIANCE_HITDIST, Family::None, kFloats, BENCH_RADIANCE, false, false},
        {ResourceType::IN_SPEC_RADIANCE_HITDIST, Family::None, kFloats, BENCH_RADIANCE, true, false},
        {ResourceType::IN_DIFF_HITDIST, Family::None, kFloats, BENCH_HITDIST, false, false},
        {ResourceType::IN_DIFF_DIRECTION_HITDIST, Family::None, kFloats, BENCH_DIRECTION, false, false},
        {ResourceType::IN_SPEC_SH1, Family::None, kFloats, BENCH_SH1, true, false},
        {ResourceType::IN_SPEC_SH0, Family::Relax, kFloats, BENCH_RELAX, true, false},
    };
    return rows;
}

engine::Device& device()
{
    static const std::unique_ptr<engine::Device> shared = []
    {
        const nrd::RequiredDeviceFeatures required = nrd::GetRequiredDeviceFeatures();
        engine::DeviceDesc desc;
        desc.validation = true;
        desc.features = required.features;
        return std::make_unique<engine::Device>(desc);
    }();
    return *shared;
}

struct Frames
{
    explicit Frames(const Workload& workload) : inputs(device(), slots(), workload, kSize)
    {
        CHECK(device().validationMessageCount() == 0);
    }
    std::vector<Texel> texels(nrd::ResourceType slot, uint32_t frame = 0)
    {
        return engine::readBackAs<Texel>(device(), inputs.image(slot, frame));
    }
    std::vector<float> depth(uint32_t frame)
    {
        return engine::readBackAs<float>(device(), inputs.image(nrd::ResourceType::IN_VIEWZ, frame));
    }
    Inputs inputs;
};

float roughnessOf(const Texel& guide) { return std::abs(2.0f * guide.z - 1.0f); }
bool isMetal(const Texel& guide) { return guide.w > 0.1f; } // material 1 of 3

// World position -> pixel of the frame before.
std::array<double, 3> reproject(const nrd::CommonSettings& s, double x, double y, double viewZ)
{
    const double view[3] = {(2.0 * x / kSize.width - 1.0) * viewZ / s.viewToClipMatrix[0],
                            (1.0 - 2.0 * y / kSize.height) * viewZ / s.viewToClipMatrix[5], viewZ};
    double world[3] = {}, before[3] = {};
    for (size_t i = 0; i < 3; i++)
        for (size_t row = 0; row < 3; row++)
            world[i] += s.worldToViewMatrix[i * 4 + row] * (view[row] - s.worldToViewMatrix[12 + row]);
    for (size_t row = 0; row < 3; row++)
    {
        before[row] = s.worldToViewMatrixPrev[12 + row];
        for (size_t i = 0; i < 3; i++) before[row] += s.worldToViewMatrixPrev[i * 4 + row] * world[i];
    }
    return {(before[0] / before[2] * s.viewToClipMatrixPrev[0] * 0.5 + 0.5) * kSize.width,
            (0.5 - before[1] / before[2] * s.viewToClipMatrixPrev[5] * 0.5) * kSize.height, before[2]};
}
} // namespace

TEST_CASE("the sky has the share that was asked for", "[gpu]")
{
    for (float share : {0.0f, 0.02f, 0.2f})
    {
        Workload workload;
        workload.skyShare = share;
        const std::optional<double> percent = Frames(workload).inputs.skyPercent(device());
        REQUIRE(percent);
        INFO(share);
        CHECK(*percent >= 100.0 * share - 1.0);
        CHECK(*percent <= 100.0 * share + 1.0);
        if (share == 0.0f) CHECK(*percent == 0.0);
    }
}

TEST_CASE("depth and matrices of consecutive frames agree where nothing is uncovered", "[gpu]")
{
    Frames frames{Workload()};
    for (uint32_t index : {1u, kInputFrameCount + 2u}) // there, and on the way back
    {
        const nrd::CommonSettings settings = bench::commonSettingsOf(Workload(), kSize, index);
        const std::vector<float> now = frames.depth(inputFrameOf(index));
        const std::vector<float> before = frames.depth(inputFrameOf(index - 1));
        size_t agreedCount = 0, count = 0, movedCount = 0;
        for (uint32_t i = 0; i < kPixelCount; i++)
        {
            if (now[i] == kSkyViewZ) continue;
            const double x = i % kSize.width + 0.5 + settings.cameraJitter[0];
            const double y = i / kSize.width + 0.5 + settings.cameraJitter[1];
            const auto [px, py, pz] = reproject(settings, x, y, now[i]);
            const double column = std::floor(px - settings.cameraJitterPrev[0]);
            const double row = std::floor(py - settings.cameraJitterPrev[1]);
            if (column < 0 || row < 0 || column >= kSize.width || row >= kSize.height) continue;
            const float found = before[static_cast<size_t>(row) * kSize.width + static_cast<size_t>(column)];
            count++;
            agreedCount += std::abs(found - pz) < 0.03 * pz ? 1 : 0;
            movedCount += std::abs(px - x) > 0.1 ? 1 : 0;
        }
        INFO("frame " << index << ": " << agreedCount << " of " << count << " pixels");
        CHECK(count > kPixelCount * 9 / 10);
        CHECK(static_cast<double>(agreedCount) > 0.85 * static_cast<double>(count));
        CHECK(movedCount > count / 2);
    }
}

TEST_CASE("metals and dielectrics have all roughnesses, and metals no diffuse sample", "[gpu]")
{
    Frames frames{Workload()};
    const std::vector<Texel> guides = frames.texels(nrd::ResourceType::IN_NORMAL_ROUGHNESS);
    const std::vector<Texel> diffuse = frames.texels(nrd::ResourceType::IN_DIFF_RADIANCE_HITDIST);
    const std::vector<float> depth = frames.depth(0);
    float low[2] = {1.0f, 1.0f}, high[2] = {};
    size_t metalCount = 0;
    for (size_t i = 0; i < kPixelCount; i++)
    {
        if (depth[i] == kSkyViewZ) continue;
        const bool metal = isMetal(guides[i]);
        metalCount += metal ? 1 : 0;
        low[metal] = std::min(low[metal], roughnessOf(guides[i]));
        high[metal] = std::max(high[metal], roughnessOf(guides[i]));
        if (metal) CHECK((diffuse[i].x == 0.0f && diffuse[i].w == 0.0f));
    }
    for (bool metal : {false, true})
    {
        CHECK(low[metal] < 0.1f);
        CHECK(high[metal] > 0.9f);
    }
    CHECK(metalCount > kPixelCount / 10);
    CHECK(metalCount < kPixelCount / 2);
}

TEST_CASE("hit distances are spread as in a real frame, and differ from frame to frame", "[gpu]")
{
    Workload workload;
    workload.isStatic = true;
    Frames frames(workload);
    const std::vector<Texel> guides = frames.texels(nrd::ResourceType::IN_NORMAL_ROUGHNESS);
    const std::vector<Texel> now = frames.texels(nrd::ResourceType::IN_DIFF_HITDIST, 0);
    const std::vector<Texel> next = frames.texels(nrd::ResourceType::IN_DIFF_HITDIST, 1);
    const std::vector<float> depth = frames.depth(0);
    size_t count = 0, farCount = 0, nearCount = 0, changedCount = 0;
    for (size_t i = 0; i < kPixelCount; i++)
    {
        if (depth[i] == kSkyViewZ || isMetal(guides[i])) continue;
        count++;
        CHECK((now[i].x > 0.0f && now[i].x <= 1.0f));
        farCount += now[i].x == 1.0f ? 1 : 0;
        nearCount += now[i].x < 0.3f ? 1 : 0;
        changedCount += now[i].x != next[i].x ? 1 : 0;
    }
    INFO(count << " pixels, " << farCount << " far, " << nearCount << " near, " << changedCount << " changed");
    CHECK(farCount > count / 5);
    CHECK(farCount < count * 9 / 10);
    CHECK(nearCount > count / 50);
    CHECK(changedCount > count / 5);
}

TEST_CASE("all inputs of a frame are of the same paths", "[gpu]")
{
    Frames frames{Workload()};
    const std::vector<Texel> diffuse = frames.texels(nrd::ResourceType::IN_DIFF_RADIANCE_HITDIST);
    const std::vector<Texel> hitDistance = frames.texels(nrd::ResourceType::IN_DIFF_HITDIST);
    const std::vector<Texel> direction = frames.texels(nrd::ResourceType::IN_DIFF_DIRECTION_HITDIST);
    const std::vector<Texel> specular = frames.texels(nrd::ResourceType::IN_SPEC_RADIANCE_HITDIST);
    const std::vector<Texel> vector = frames.texels(nrd::ResourceType::IN_SPEC_SH1);
    const std::vector<Texel> relax = frames.texels(nrd::ResourceType::IN_SPEC_SH0);
    size_t litCount = 0, missCount = 0;
    for (size_t i = 0; i < kPixelCount; i++)
    {
        const Texel &d = direction[i], &v = vector[i], &r = relax[i];
        CHECK(diffuse[i].w == hitDistance[i].x);
        CHECK(d.w == hitDistance[i].x);
        CHECK(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z) == Approx(d.w).margin(1e-4));
        CHECK(std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z) == Approx(specular[i].x).epsilon(1e-3).margin(1e-4));
        // RELAX's is linear, and not normalised: the distance is 0 or a miss where REBLUR's is.
        CHECK(0.25f * r.x + 0.5f * r.y + 0.25f * r.z == Approx(specular[i].x).epsilon(1e-3).margin(1e-4));
        CHECK(0.5f * (r.x - r.z) == Approx(specular[i].y).epsilon(1e-3).margin(1e-4));
        CHECK((r.w > 0.0f) == (specular[i].w > 0.0f));
        CHECK((r.w >= specular[i].w && r.w <= 65504.0f));
        missCount += r.w == 65504.0f ? 1 : 0;
        litCount += specular[i].x > 0.0f ? 1 : 0;
        for (float value : {diffuse[i].x, specular[i].x, specular[i].w}) CHECK((value >= 0.0f && value < 250.0f));
    }
    CHECK(litCount > kPixelCount * 8 / 10);
    CHECK(missCount > kPixelCount / 50);
    CHECK(missCount < kPixelCount * 9 / 10);
}
