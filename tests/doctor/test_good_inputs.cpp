// Good inputs raise no finding: every recorded sequence from its first frame to its last, with motion in the world and
// on screen.
#include "catch.h"
#include "inputs.h"
#include "room.h"
#include <cstdio>

namespace fs = std::filesystem;

namespace
{
void checkGood(std::vector<test::FrameInputs> frames)
{
    CHECK(test::diagnose(frames).text() == "");
    test::toScreenMotion(frames);
    for (test::FrameInputs& frame : frames) frame.common.motionVectorScale[2] = 1.0f;
    CHECK(test::diagnose(frames).text() == "");
}
} // namespace

TEST_CASE("a good input raises no finding", "[unit]") { checkGood(test::makeRoom(4, 320, 180)); }

TEST_CASE("one frame alone raises no finding, nor does a frame of one pixel", "[unit]")
{
    checkGood(test::makeRoom(1, 320, 180));
    checkGood(test::makeRoom(3, 1, 1));
}

TEST_CASE("the recorded sequences raise no finding", "[golden]")
{
    int count = 0;
    for (const char* name : {"cornell-pan", "roughness-ladder", "sun-shadow", "sun-shadow-soft", "ao-room"})
    {
        const fs::path folder = fs::path(NRD_SEQUENCES) / name;
        if (!fs::exists(folder / "capture.json")) continue;
        count++;
        for (const size_t first : {size_t(0), size_t(40)})
        {
            INFO(name << " from frame " << first);
            checkGood(test::readInputs(folder, first, 5));
        }
    }
    if (count == 0) std::printf("SKIPPED the doctor on the recorded sequences: they are not here\n");
}
