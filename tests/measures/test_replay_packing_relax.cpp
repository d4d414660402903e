// What the replay tool puts into RELAX's slots, and what it makes of them.
#include "catch.h"
#include "packing_bench.h"
#include "relax_slots.h"

#include "shaders/replay_modes.h"

#include <set>

using namespace sample;
using namespace sample::test;
using nrd::ResourceType;

namespace
{
struct RadianceLobe
{
    ResourceType input, output;
    Channel radiance, hitDistance;
};
constexpr RadianceLobe kRadianceLobes[] = {
    {ResourceType::IN_DIFF_RADIANCE_HITDIST, ResourceType::OUT_DIFF_RADIANCE_HITDIST, Channel::DiffuseR,
     Channel::DiffuseHitDist},
    {ResourceType::IN_SPEC_RADIANCE_HITDIST, ResourceType::OUT_SPEC_RADIANCE_HITDIST, Channel::SpecularR,
     Channel::SpecularHitDist},
};

// Linear radiance and the recorded hit distance, as half floats.
void checkSignal(const PackingBench& bench, const RadianceLobe& lobe, const std::vector<float>& values)
{
    size_t missCount = 0;
    for (size_t i = 0; i < bench.frame.pixelCount(); i++)
    {
        const Vec3 rgb = pixelOf(bench.frame, lobe.radiance, i);
        const float distance = bench.frame[lobe.hitDistance][i];
        for (size_t c = 0; c < 3; c++) CHECK(values[i * 4 + c] == Approx(rgb[c]).epsilon(kHalfError));
        CHECK(values[i * 4 + 3] == Approx(distance).epsilon(kHalfError));
        if (distance >= kHitDistMiss) CHECK(values[i * 4 + 3] == REPLAY_HIT_DIST_MISS);
        missCount += distance >= kHitDistMiss;
    }
    CHECK(missCount > 10);
}
} // namespace

TEST_CASE("RELAX's slots hold linear radiance and the hit distance in world units, and give it back", "[gpu]")
{
    PackingBench bench(-1.0);
    for (const RadianceLobe& lobe : kRadianceLobes)
    {
        engine::Image slot = bench.pack(lobe.input, Family::Relax);
        checkSignal(bench, lobe, bench.unpack(slot, slot, REPLAY_UNPACK_COPY, true));
        checkSignal(bench, lobe, bench.unpack(slot, slot, findSlot(lobe.output, Family::Relax)->mode, true));
    }
    for (size_t l = 0; l < std::size(kShLobes); l++)
        checkSignal(bench, kRadianceLobes[l], bench.copy(kShLobes[l].sh0, Family::Relax));
}

TEST_CASE("RELAX's SH vector is REBLUR's, so that one extraction serves both families", "[gpu]")
{
    PackingBench bench(1.0);
    for (const ShLobe& lobe : kShLobes)
    {
        CHECK(bench.copy(lobe.sh1, Family::Relax) == bench.copy(lobe.sh1, Family::Reblur));
        // RELAX returns SH0 in YCoCg, as REBLUR takes it.
        engine::Image sh0 = bench.pack(lobe.sh0, Family::Reblur), sh1 = bench.pack(lobe.sh1, Family::Relax);
        const std::vector<float> values = bench.unpack(sh0, sh1, REPLAY_UNPACK_EXTRACT, lobe.isDiffuse);
        for (size_t i = 0; i < bench.frame.pixelCount(); i++)
        {
            const Vec3 rgb = pixelOf(bench.frame, lobe.radiance, i);
            for (size_t c = 0; c < 3; c++) CHECK(values[i * 4 + c] == Approx(rgb[c]).margin(8.0 * kHalfError));
        }
    }
}

TEST_CASE("the replay tool serves every slot of every RELAX denoiser", "[unit]")
{
    size_t count = 0;
    for (const ReplayDenoiser& denoiser : replayDenoisers())
    {
        if (denoiser.family != Family::Relax) continue;
        std::set<Signal> measured;
        for (ResourceType type : relaxSlots(denoiser.name))
        {
            INFO(denoiser.name << " " << nrd::toString(type));
            const SlotRow* row = findSlot(type, Family::Relax);
            REQUIRE(row);
            count++;
            CHECK(row->type == type);
            CHECK(row->isOutput == isOutputSlot(type));
            CHECK_FALSE(row->scalar); // the fourth channel is a history length
            if (row->radiance) CHECK(row->isDiffuse == (*row->radiance == Signal::Diffuse));
            if (row->radiance) measured.insert(*row->radiance);
            if (row->sh1) CHECK(static_cast<size_t>(*row->sh1) == static_cast<size_t>(type) + 1);
        }
        CHECK(measured == std::set<Signal>(denoiser.signals.begin(), denoiser.signals.end()));
    }
    CHECK(count == 6 * 4 + 2 + 4 + 2 + 4 + 4 + 8); // three guides and the overlay each, and the lobes
}
