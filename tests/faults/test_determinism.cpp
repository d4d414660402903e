// The same inputs give the same bits: in a second run, and however many frames are in flight.
#include "catch.h"
#include "long_form.h"
#include "session.h"
#include "validated_device.h"
#include <cstdio>

using namespace faults;

namespace
{
constexpr int kFrameNum = 5;

SessionDesc allDenoisers(uint32_t framesInFlight)
{
    SessionDesc desc;
    desc.denoisers.assign(options::allDenoisers().begin(), options::allDenoisers().end());
    desc.framesInFlight = framesInFlight;
    return desc;
}

std::vector<Outputs> run(Session& session)
{
    for (int frame = 0; frame < kFrameNum; frame++) session.frame(frame);
    return session.finish();
}

void requireSame(const std::vector<Outputs>& a, const std::vector<Outputs>& b)
{
    REQUIRE(a.size() == kFrameNum);
    REQUIRE(b.size() == kFrameNum);
    for (size_t frame = 0; frame < a.size(); frame++)
        for (size_t output = 0; output < a[frame].size(); output++)
        {
            INFO("frame " << frame << ", output " << output);
            CHECK(isSame({a[frame][output]}, {b[frame][output]}));
        }
}
} // namespace

TEST_CASE("the same inputs give the same bits twice and with any number of frames in flight", "[gpu]")
{
    Session session(allDenoisers(1));
    session.create();
    const std::vector<Outputs> first = run(session);
    CHECK_FALSE(isSame(first[kFrameNum - 2], first[kFrameNum - 1])); // pictures that move
    session.resize({33, 25});
    session.resize({40, 24});
    requireSame(first, run(session));
    session.destroy();
    // Pipelines cost far more than frames, and 2 stands between 1 and 3: in the long form only.
    for (uint32_t framesInFlight = test::isLong() ? 2 : 3; framesInFlight <= 3; framesInFlight++)
    {
        INFO(framesInFlight << " frames in flight");
        Session other(allDenoisers(framesInFlight));
        other.create();
        requireSame(first, run(other));
        other.destroy();
    }
    test::failOnMessages();
    std::printf("FIGURE Determinism: %zu outputs of %zu denoisers, %d frames, the same bits in %d runs\n",
                first[0].size(), options::allDenoisers().size(), kFrameNum, test::isLong() ? 4 : 3);
}
