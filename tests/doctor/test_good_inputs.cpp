// Good inputs raise no finding: every recorded sequence from its first frame to its last, with motion in the world and
// on screen.
#include "catch.h"
#include "inputs.h"
#include <cstdio>

namespace fs = std::filesystem;

TEST_CASE("the recorded sequences raise no finding", "[golden]")
{
    int count = 0;
    for (const char* name : {"cornell-pan", "roughness-ladder", "sun-shadow", "sun-shadow-soft", "ao-room"})
    {
        const fs::path folder = fs::path(NRD_SEQUENCES) / name;
        if (!fs::exists(folder / "capture.json")) continue;
        count++;
        for (size_t first = 0; first < 64; first += 16)
        {
            std::vector<test::FrameInputs> frames = test::readInputs(folder, first, 6);
            INFO(name << " from frame " << first);
            CHECK(test::diagnose(frames).text() == "");
            test::toScreenMotion(frames);
            for (test::FrameInputs& frame : frames) frame.common.motionVectorScale[2] = 1.0f;
            CHECK(test::diagnose(frames).text() == "");
        }
    }
    if (count == 0) std::printf("SKIPPED the doctor on the recorded sequences: they are not here\n");
}
