// Long sessions: whatever they do, memory is as it was once the same is alive again.
#include "allocations.h"
#include "catch.h"
#include "injection.h"
#include "long_form.h"
#include "recorded_life.h"
#include "session.h"
#include "validated_device.h"
#include <cstdio>
#include <fstream>
#include <optional>
#include <unistd.h>

using namespace faults;

namespace
{
uint64_t residentBytes()
{
    std::ifstream file("/proc/self/statm");
    uint64_t total = 0, resident = 0;
    file >> total >> resident;
    return resident * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

// Of everything that must not grow, the first reading, which all later ones must repeat.
template <class T> void requireAsAtFirst(std::optional<T>& first, const T& now)
{
    if (!first) first = now;
    CHECK(*first == now);
}
} // namespace

TEST_CASE("thousands of frames of anything leave memory flat and misuse nothing", "[unit]")
{
    const int frameNum = test::isLong() ? 20000 : 600;
    constexpr int kLookNum = 10;
    std::optional<RecordedLife::Holdings> holdings;
    std::optional<ptrdiff_t> blocks;
    uint64_t resident[kLookNum] = {};
    {
        const test::AllocationWatch watch;
        RecordedLife life(1);
        for (int frame = 0; frame < 1000; frame++) life.frame(); // what is kept for good comes with its first use
        for (int look = 0; look < kLookNum; look++)
        {
            for (int frame = 0; frame < frameNum / kLookNum; frame++) life.frame();
            life.settle();
            const RecordedLife::Holdings nowHeld = life.holdings();
            const ptrdiff_t nowBlocks = test::liveAllocations();
            resident[look] = residentBytes();
            requireAsAtFirst(holdings, nowHeld);
            requireAsAtFirst(blocks, nowBlocks);
        }
        life.destroy();
        CHECK(life.holdings() == RecordedLife::Holdings{});
        for (const std::string& misuse : life.misuses()) FAIL_CHECK(misuse);
    }
    std::printf("FIGURE Soak, recorded: %d frames, %u objects of %llu bytes and %td heap blocks at each of %d looks\n",
                frameNum, holdings->objects, static_cast<unsigned long long>(holdings->bytes), *blocks, kLookNum);
    if (!test::isLong()) return; // too few frames for the process to settle
    const double mebibytes = (double(resident[kLookNum - 1]) - double(resident[kLookNum / 2])) / double(1 << 20);
    CHECK(mebibytes < 2.0); // fragments of the heap
    std::printf("FIGURE Soak, recorded: resident memory grew by %.2f MiB in the second half (bound 2)\n", mebibytes);
}

TEST_CASE("a long session on the device leaves device memory flat, and validation has nothing to say", "[gpu]")
{
    const int frameNum = test::isLong() ? 1000 : 60;
    const int lookNum = test::isLong() ? 10 : 2;
    SessionDesc desc;
    desc.denoisers = {nrd::Denoiser::REBLUR_DIFFUSE, nrd::Denoiser::SIGMA_SHADOW, nrd::Denoiser::REFERENCE};
    desc.framesInFlight = 2;
    desc.isGpuTimingEnabled = true;
    Session session(desc);
    Dice dice(2);
    const auto change = [&]
    {
        for (size_t i = 0; i < desc.denoisers.size(); i++)
            if (dice.once(8))
                CHECK(changeSettings(dice, session.integration, session.identifier(i), session.denoiser(i)) ==
                      nrd::Result::SUCCESS);
    };
    session.create();
    session.changeSettings = change;
    std::optional<std::string> held;
    for (int frame = 0; frame < frameNum; frame++)
    {
        if (dice.once(20)) session.resize({1 + int(dice.below(60)), 1 + int(dice.below(60))});
        session.frame(frame, dice.once(15));
        if ((frame + 1) % (frameNum / lookNum) != 0) continue;
        session.destroy();
        session.create();
        session.changeSettings = nullptr;
        session.resize({48, 32});
        for (int i = 0; i < 16; i++) session.frame((1 << 20) + i);
        (void)session.finish();
        const std::string now = toString(census());
        requireAsAtFirst(held, now);
        session.changeSettings = change;
    }
    session.destroy();
    INFO(toString(census()));
    CHECK(census().alive.empty());
    CHECK(census().foreign == 0);
    test::failOnMessages();
    std::printf("FIGURE Soak, device: %d frames, at each of %d looks %s\n", frameNum, lookNum, held->c_str());
}
