// Frames over the recording device: constants, descriptor sets, timings, labels and pools from frame to frame.
#include "denoiser_constants.h"
#include "recording_fixture.h"
#include "reference_constants.h"
#include <cstring>
#include <map>
#include <set>

using nrd::Denoiser;
using nrd::ResourceType;
using rhi::CallType;
using test::RecordingFixture;
using test::require;

namespace
{
// The constants that a recorded binding of set 0 shows.
template <class Constants> Constants constantsAt(const RecordingFixture& f, const rhi::RecordedCall& bind)
{
    REQUIRE(f.spy.uploadBuffers().size() == 1);
    const rhi::Buffer& ring = *f.spy.uploadBuffers()[0];
    REQUIRE(bind.dynamicOffsets.size() == 1);
    REQUIRE(bind.dynamicOffsets[0] % f.device->limits().uniformOffsetAlignment == 0);
    REQUIRE(bind.dynamicOffsets[0] + sizeof(Constants) <= ring.desc().size);
    Constants result;
    std::memcpy(&result, static_cast<const std::byte*>(ring.mapped()) + bind.dynamicOffsets[0], sizeof(result));
    return result;
}

std::vector<rhi::RecordedCall> constantBindings(const RecordingFixture& f)
{
    std::vector<rhi::RecordedCall> result;
    for (const rhi::RecordedCall& call : f.calls(CallType::BindSet))
        if (call.index == 0) result.push_back(call);
    return result;
}
} // namespace

TEST_CASE("the frame index reaches the shaders of command buffers that are recorded anew", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.fillReblurSlots();
    f.requireCreated();
    for (uint32_t frame = 0; frame < 6; frame++)
    {
        f.beginFrame();
        f.device->clearCalls();
        require(f.denoise({3}), f.integration);
        const auto bindings = constantBindings(f);
        REQUIRE_FALSE(bindings.empty());
        for (const rhi::RecordedCall& bind : bindings)
            CHECK(constantsAt<nrd::shared::DenoiserConstants>(f, bind).frameIndex == f.settings.frameIndex);
    }
}

TEST_CASE("constants of a frame stay as they were until its slot comes round", "[unit]")
{
    RecordingFixture f;
    f.desc.framesInFlight = GENERATE(1u, 2u, 3u, 4u);
    f.requireCreated();
    std::vector<rhi::RecordedCall> pending; // of the frames in flight, oldest first
    std::vector<float> weights;
    for (uint32_t frame = 0; frame < 12; frame++)
    {
        if (pending.size() == f.desc.framesInFlight) // the GPU is done with the oldest
        {
            pending.erase(pending.begin());
            weights.erase(weights.begin());
        }
        f.device->clearCalls();
        f.beginFrame();
        require(f.denoise(), f.integration);
        const auto bindings = constantBindings(f);
        REQUIRE_FALSE(bindings.empty());
        pending.push_back(bindings[0]);
        weights.push_back(1.0f / static_cast<float>(1 + frame));
        for (size_t i = 0; i < pending.size(); i++)
            CHECK(constantsAt<nrd::shared::ReferenceConstants>(f, pending[i]).weight == weights[i]);
    }
}

TEST_CASE("constants are stored once where a dispatch repeats those of the one before", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.fillReblurSlots();
    f.requireCreated();
    for (int frame = 0; frame < 2; frame++)
    {
        f.beginFrame();
        f.device->clearCalls();
        require(f.denoise({3}), f.integration);
    }
    std::set<uint32_t> offsets;
    for (const rhi::RecordedCall& bind : constantBindings(f)) offsets.insert(bind.dynamicOffsets[0]);
    CHECK(f.count(CallType::Dispatch) > 4);
    CHECK(offsets.size() == 1); // all passes of REBLUR share one block
}

TEST_CASE("no descriptor set is written or reset while a frame that uses it is pending", "[unit]")
{
    RecordingFixture f;
    f.desc.framesInFlight = GENERATE(1u, 2u, 3u, 4u);
    f.requireCreated();
    std::map<std::string, uint32_t> lastUse; // of a pool, by frame
    std::map<uint64_t, std::string> poolOf;  // by set
    std::set<uint64_t> written;
    uint32_t resetCount = 0;
    for (uint32_t frame = 1; frame <= 80; frame++)
    {
        f.device->clearCalls();
        // Other images at every frame, for a while: sets that say so pile up.
        if (frame < 50) f.pool[nrd::ResourceType::IN_SIGNAL] = f.image(0x1000 + frame);
        f.beginFrame();
        require(f.denoise(), f.integration);
        if (frame == 80) CHECK(f.count(CallType::WriteSet) == 0); // nothing has changed for as long as sets are kept
        for (const rhi::RecordedCall& call : f.device->calls())
        {
            if (call.type == CallType::ResetPool && lastUse.count(call.name))
            {
                CHECK(lastUse[call.name] + f.desc.framesInFlight <= frame);
                resetCount++;
            }
            if (call.type == CallType::AllocateSet) poolOf[call.handle] = call.name;
            if (call.type == CallType::WriteSet) CHECK(written.insert(call.handle).second); // once in its life
            if (call.type == CallType::BindSet) lastUse[poolOf[call.handle]] = frame;
        }
    }
    CHECK(resetCount > 0);
}

TEST_CASE("pool textures begin undefined, and history stays where it is", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}}); // whose history changes places
    f.fillReblurSlots();
    f.requireCreated();
    f.beginFrame();
    require(f.denoise({3}), f.integration);
    for (const char* name : {"NRD P(0)", "NRD P(1)"})
    {
        const auto barriers = f.barriersOf(name);
        REQUIRE_FALSE(barriers.empty());
        CHECK(barriers[0].before == rhi::states::kUndefined);
    }
    f.device->clearCalls();
    for (int frame = 0; frame < 5; frame++)
    {
        f.beginFrame();
        require(f.denoise({3}), f.integration);
    }
    for (const char* name : {"NRD P(0)", "NRD P(1)"})
        for (const rhi::RecordedBarrier& barrier : f.barriersOf(name)) // from UNDEFINED would drop the history
            CHECK(barrier.before.layout != rhi::Layout::Undefined);
}

TEST_CASE("each dispatch has one batch of barriers at most, and a label", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.fillReblurSlots();
    f.requireCreated();
    f.beginFrame();
    f.device->clearCalls();
    require(f.denoise({3}), f.integration);
    uint32_t batches = 0;
    for (const rhi::RecordedCall& call : f.device->calls())
    {
        if (call.type == CallType::Barriers) CHECK(++batches == 1);
        if (call.type == CallType::Dispatch) batches = 0;
    }
    const auto labels = f.calls(CallType::BeginLabel);
    CHECK(labels.size() == f.count(CallType::Dispatch) + 1);
    CHECK(labels.size() == f.count(CallType::EndLabel));
    CHECK(labels[0].name == "NRD");
    CHECK(labels.back().name.find("REBLUR_DIFFUSE_SPECULAR - ") == 0);
}

TEST_CASE("times are named by pass and belong to the frame that left its slot", "[unit]")
{
    RecordingFixture f;
    f.desc.framesInFlight = 2;
    f.desc.isGpuTimingEnabled = true;
    f.requireCreated();
    for (int frame = 1; frame <= 2; frame++)
    {
        f.beginFrame();
        require(f.denoise(), f.integration);
        CHECK(f.integration.GetTimings().frame == 0); // nobody waited for the GPU
    }
    f.beginFrame();
    CHECK(f.integration.GetTimings().frame == 1); // clears included
    f.beginFrame();
    const nrd::Timings timings = f.integration.GetTimings();
    CHECK(timings.frame == 2);
    REQUIRE(timings.passesNum == 2);
    CHECK(timings.passes[0].name == std::string("REFERENCE - Accumulate"));
    CHECK(timings.passes[1].name == std::string("REFERENCE - Copy"));
    CHECK(timings.passes[0].milliseconds == Approx(1e-6f)); // ticks of a nanosecond, one apart
    CHECK(timings.totalMilliseconds == Approx(2e-6f));
}

TEST_CASE("queries are reset before they are written, once per frame", "[unit]")
{
    RecordingFixture f({{7, Denoiser::REFERENCE}, {8, Denoiser::REFERENCE}});
    f.desc.isGpuTimingEnabled = true;
    f.requireCreated();
    f.beginFrame();
    require(f.denoise({7}), f.integration);
    require(f.denoise({8}), f.integration);
    std::set<uint32_t> reset;
    std::set<uint32_t> stamped;
    for (const rhi::RecordedCall& call : f.device->calls())
    {
        if (call.type == CallType::ResetQueries)
            for (uint32_t i = 0; i < call.size; i++) CHECK(reset.insert(call.index + i).second);
        if (call.type == CallType::WriteTimestamp)
        {
            CHECK(reset.count(call.index) == 1);
            CHECK(stamped.insert(call.index).second);
        }
    }
    CHECK(stamped.size() == f.count(CallType::Dispatch) + 2);
}

TEST_CASE("two calls in a frame denoise two identifiers with constants of their own", "[unit]")
{
    RecordingFixture f({{7, Denoiser::REFERENCE}, {8, Denoiser::REFERENCE}});
    f.requireCreated();
    nrd::ReferenceSettings settings;
    settings.maxAccumulatedFrameNum = 1;
    require(f.integration.SetDenoiserSettings(8, settings), f.integration);
    for (int frame = 0; frame < 4; frame++)
    {
        f.beginFrame();
        f.device->clearCalls();
        require(f.denoise({7}), f.integration);
        require(f.denoise({8}), f.integration);
    }
    std::vector<float> weights;
    for (const rhi::RecordedCall& bind : constantBindings(f))
        weights.push_back(constantsAt<nrd::shared::ReferenceConstants>(f, bind).weight);
    CHECK(weights == std::vector<float>{0.25f, 0.5f});
}
