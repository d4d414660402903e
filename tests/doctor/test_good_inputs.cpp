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

// A lens shift that is animated looks like jitter in any one step.
TEST_CASE("a projection that drifts raises no finding", "[unit]")
{
    std::vector<test::FrameInputs> frames = test::makeRoom(6, 64, 64);
    for (size_t i = 0; i < frames.size(); i++)
    {
        frames[i].common.viewToClipMatrix[8] += 0.01f * static_cast<float>(i);
        if (i > 0) frames[i].common.viewToClipMatrixPrev[8] += 0.01f * static_cast<float>(i - 1);
    }
    CHECK_FALSE(test::diagnose(frames).has(nrd::DoctorRule::JITTER_IN_MATRIX));
}

TEST_CASE("a part of a larger picture raises no finding, whatever is around it", "[unit]")
{
    std::vector<test::FrameInputs> frames = test::makeRoom(3, 160, 96);
    for (test::FrameInputs& frame : frames)
    {
        for (test::Texels* guide : {&frame.viewZ, &frame.motion, &frame.normalRoughness})
            *guide = test::enlarge(*guide, frame, 200, 120, 30, 20);
        for (test::Texels* signal :
             {&frame.diffuse, &frame.specular, &frame.diffuseFactor, &frame.specularFactor, &frame.specularDirection})
            *signal = test::enlarge(*signal, frame, 200, 120, 0, 0);
        frame.common.resourceSize[0] = frame.common.resourceSizePrev[0] = 200;
        frame.common.resourceSize[1] = frame.common.resourceSizePrev[1] = 120;
        frame.common.rectOrigin[0] = 30;
        frame.common.rectOrigin[1] = 20;
    }
    CHECK(test::diagnose(frames).text() == "");
}

TEST_CASE("an input that cannot be read is refused by name", "[unit]")
{
    nrd::InputDoctor doctor;
    CHECK(doctor.GetLastMessage() == std::string());
    nrd::DoctorFrame frame = test::makeRoom(1, 8, 8)[0].view();
    frame.viewZ = nullptr;
    CHECK(doctor.AddFrame(frame) == nrd::Result::INVALID_ARGUMENT);
    CHECK_THAT(doctor.GetLastMessage(), containing("viewZ is null"));
    const test::FrameInputs room = test::makeRoom(1, 8, 8)[0];
    frame = room.view();
    frame.common.rectOrigin[1] = 1;
    CHECK(doctor.AddFrame(frame) == nrd::Result::INVALID_ARGUMENT);
    CHECK_THAT(doctor.GetLastMessage(), containing("rectOrigin + rectSize is 9 in component 1"));
    frame = room.view();
    frame.common.rectSize[0] = 0;
    CHECK(doctor.AddFrame(frame) == nrd::Result::INVALID_ARGUMENT);
    CHECK_THAT(doctor.GetLastMessage(), containing("rectSize[0] is 0"));
    CHECK(doctor.GetFrameNum() == 0);
    // Matrices that the descriptor library would refuse do no harm.
    frame = room.view();
    frame.common = {};
    frame.common.rectSize[0] = frame.common.rectSize[1] = 8;
    frame.common.resourceSize[0] = frame.common.resourceSize[1] = 8;
    for (frame.common.frameIndex = 0; frame.common.frameIndex < 3; frame.common.frameIndex++)
        CHECK(doctor.AddFrame(frame) == nrd::Result::SUCCESS);
    const nrd::Finding* findings = nullptr;
    uint32_t count = 0;
    CHECK(doctor.GetFindings(findings, count) == nrd::Result::SUCCESS);
    CHECK(doctor.GetFrameNum() == 3);
    doctor.Reset();
    CHECK(doctor.GetFrameNum() == 0);
}

TEST_CASE("depth and motion in half floats raise no finding, large pictures included", "[unit]")
{
    for (const size_t scale : {1, 4})
    {
        std::vector<test::FrameInputs> frames = test::makeRoom(2, 320 * scale, 180 * scale);
        test::toScreenMotion(frames);
        for (test::FrameInputs& frame : frames)
            for (test::Texels* texels : {&frame.viewZ, &frame.motion}) test::roundToHalf(*texels);
        INFO(scale);
        CHECK(test::diagnose(frames).text() == "");
    }
}

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
