#include "catch.h"
#include "injection.h"
#include "sweep.h"
#include "validated_device.h"
#include <cstdio>

using namespace faults;

namespace
{
constexpr uint64_t kFramesBefore = 4; // that passesOf() begins

std::vector<std::string> passesOf(Session& session)
{
    session.frame(0);
    session.frame(1); // whatever only the first frame has is behind
    (void)session.finish();
    session.frame(2);
    (void)session.finish();
    REQUIRE(session.integration.NewFrame() == nrd::Result::SUCCESS);
    const nrd::Timings timings = session.integration.GetTimings();
    std::vector<std::string> names;
    for (uint32_t i = 0; i < timings.passesNum; i++) names.push_back(timings.passes[i].name);
    return names;
}

// A frame in which the GPU hangs in a dispatch, after which the device is found to be lost.
std::string lossIn(Session& session, int frame, size_t dispatch)
{
    hangAfter(dispatch);
    session.frame(frame);
    unhang();
    (void)session.finish();
    failCallsOf("vkGetQueryPoolResults", VK_ERROR_DEVICE_LOST);
    CHECK(session.integration.NewFrame() == nrd::Result::FAILURE);
    stop();
    return session.integration.GetLastMessage();
}
} // namespace

TEST_CASE("a lost device is reported with the last pass that began", "[gpu]")
{
    Session session(smallSet());
    session.create();
    const std::vector<std::string> passes = passesOf(session);
    REQUIRE(passes.size() > 8);
    for (size_t i = 0; i <= passes.size(); i++)
    {
        INFO("hung in dispatch " << i);
        const std::string message = lossIn(session, 3 + static_cast<int>(i), i);
        const nrd::LastPass last = session.integration.GetLastPass();
        const bool isBehind = i == passes.size(); // what hangs is not ours
        CHECK(last.name == passes[isBehind ? i - 1 : i]);
        CHECK(last.isFinished == isBehind);
        CHECK(last.frame == kFramesBefore + 1 + i); // a NewFrame() that failed does not count
        CHECK_THAT(message, containing("device lost"));
        CHECK_THAT(message, containing(std::string("'") + last.name + "'"));
        CHECK_THAT(message, containing(isBehind ? ", finished" : ", not finished"));
    }
    session.destroy();
    test::failOnMessages();
    std::printf("FIGURE Device losses: %zu, each reported with its pass\n", passes.size() + 1);
}

TEST_CASE("a pass that began before a resize keeps its name", "[gpu]")
{
    SessionDesc desc = smallSet();
    desc.hasOldBarriers = GENERATE(false, true);
    desc.framesInFlight = 2;
    Session session(desc);
    session.create();
    session.frame(0);
    session.resize({33, 25});
    const nrd::LastPass last = session.integration.GetLastPass();
    CHECK(last.frame == 1);
    CHECK(last.isFinished);
    CHECK_THAT(last.name, containing("REFERENCE"));
    test::failOnMessages();
}

TEST_CASE("without tracing nothing is known of passes, and the message says how to know", "[gpu]")
{
    SessionDesc desc = smallSet();
    desc.isPassTracingEnabled = false;
    Session session(desc);
    session.create();
    CHECK_THAT(lossIn(session, 0, 0), containing("isPassTracingEnabled"));
    CHECK(session.integration.GetLastPass().frame == 0);
}
