#include "capture_fixture.h"

#include <cmath>
#include <limits>

using namespace sample;
using namespace test;

TEST_CASE("what a capture writer writes, a reader reads", "[unit]")
{
    TempFolder folder;
    writeCapture(folder.path() / "new" / "nested");
    const Capture capture = Capture::open(folder.path() / "new" / "nested");
    const CaptureInfo& info = capture.info();
    CHECK(info.name == "test \"quoted\"");
    CHECK(info.width == kWidth);
    CHECK(info.height == kHeight);
    CHECK(info.hitDistanceParameters == makeInfo().hitDistanceParameters);
    REQUIRE(info.frames.size() == 3);
    CHECK(info.frames[0].isCut);
    CHECK_FALSE(info.frames[1].isCut);
    CHECK(info.frames[0].reference.empty());
    CHECK(info.frames[1].reference == "reference_0001.exr");
    CHECK(info.frames[2].jitter == std::array<double, 2>{0.25, -0.5});
    CHECK(info.frames[2].viewToClip[0] == 3.0);
    CHECK(info.frames[2].worldToView[15] == 1.0 / 3.0); // doubles survive: differences of matrices need them
    for (size_t f = 0; f < 3; f++)
    {
        const Planes read = capture.readFrame(f);
        const Planes written = makePlanes(false, static_cast<float>(f));
        CHECK(read.values == written.values);
    }
    CHECK(capture.readReference(2).values == makePlanes(true).values);
    CHECK(capture.has(Channel::ShadowDist));
    CHECK(capture.has(Channel::RefSpecularNormHitDist));
}

TEST_CASE("a layer that was not recorded is absent, and an optional channel may be", "[unit]")
{
    TempFolder folder;
    CaptureInfo info = makeInfo();
    info.light.reset();
    Planes frame(kWidth, kHeight);
    frame[Channel::ViewZ].assign(frame.pixelCount(), 2.0f);
    Planes reference = makePlanes(true);
    reference[Channel::RefSpecularNormHitDist].clear();
    CaptureWriter writer(folder.path(), info);
    writer.addFrame({}, frame);
    writer.addReference(0, reference);
    writer.finish();
    const Capture capture = Capture::open(folder.path());
    CHECK(capture.has(Channel::ViewZ));
    CHECK_FALSE(capture.has(Channel::NormalX));
    CHECK(capture.has(Channel::RefSpecularR));
    CHECK_FALSE(capture.has(Channel::RefSpecularNormHitDist));
    CHECK(capture.light(0) == nullptr);
}

TEST_CASE("a capture tells its checkerboard, and keys nobody knows are ignored", "[unit]")
{
    const TempFolder folder;
    writeCapture(folder.path());
    CHECK(Capture::open(folder.path()).info().checkerboard == CaptureCheckerboard::Off);
    editJson(folder.path(),
             [](nlohmann::json& json)
             {
                 json["checkerboard"] = "white";
                 json["someday"] = {1, 2, 3};
                 json["frames"][0]["someday"] = "yes";
             });
    CHECK(readingError(folder.path()).empty());
    CHECK(Capture::open(folder.path()).info().checkerboard == CaptureCheckerboard::White);
}

TEST_CASE("a light given per frame replaces the capture's", "[unit]")
{
    TempFolder folder;
    CaptureWriter writer(folder.path(), makeInfo());
    CaptureFrame frame;
    writer.addFrame(frame, makePlanes(false));
    frame.light = CaptureLight{true, {}, 0.0, {1.0, 2.0, 3.0}, 0.5};
    writer.addFrame(frame, makePlanes(false));
    writer.finish();
    const Capture capture = Capture::open(folder.path());
    REQUIRE(capture.light(0));
    CHECK_FALSE(capture.light(0)->isLocal);
    REQUIRE(capture.light(1));
    CHECK(capture.light(1)->isLocal);
    CHECK(capture.light(1)->position == std::array<double, 3>{1.0, 2.0, 3.0});
    CHECK(capture.light(1)->radius == 0.5);
}

TEST_CASE("noisy channels keep NaN and infinities, finite values stay finite in half", "[unit]")
{
    TempFolder folder;
    Planes frame = makePlanes(false);
    frame[Channel::DiffuseR][3] = std::numeric_limits<float>::quiet_NaN();
    frame[Channel::SpecularG][4] = std::numeric_limits<float>::infinity();
    frame[Channel::DiffuseB][5] = 1e30f;
    CaptureWriter writer(folder.path(), makeInfo());
    writer.addFrame({}, frame);
    writer.finish();
    const Planes read = Capture::open(folder.path()).readFrame(0);
    CHECK(std::isnan(read[Channel::DiffuseR][3]));
    CHECK(std::isinf(read[Channel::SpecularG][4]));
    CHECK(read[Channel::DiffuseB][5] == 65504.0f);
}

TEST_CASE("a picture's components go to consecutive channels", "[unit]")
{
    Image image(2, 1);
    image.rgba = {1, 2, 3, 4, 5, 6, 7, 8};
    Planes planes(2, 1);
    planes.set(Channel::NormalX, image, 3);
    planes.set(Channel::Roughness, image, 1, 3);
    CHECK(planes[Channel::NormalY] == std::vector<float>{2, 6});
    CHECK(planes[Channel::NormalZ] == std::vector<float>{3, 7});
    CHECK(planes[Channel::Roughness] == std::vector<float>{4, 8});
}

TEST_CASE("the writer refuses what a reader would refuse", "[unit]")
{
    TempFolder folder;
    CaptureWriter writer(folder.path(), makeInfo());
    Planes planes = makePlanes(false);
    planes[Channel::MotionY][8] = std::numeric_limits<float>::infinity();
    CHECK(errorOf([&] { writer.addFrame({}, planes); }) ==
          (folder.path() / "frame_0000.exr").string() + ", channel motion.Y is infinite at pixel (1, 1)");
    planes = makePlanes(false);
    planes[Channel::DiffuseG].clear();
    CHECK_THAT(errorOf([&] { writer.addFrame({}, planes); }), containing("no channel diffuse.G"));
    planes = makePlanes(false);
    planes[Channel::SunB].pop_back();
    CHECK_THAT(errorOf([&] { writer.addFrame({}, planes); }), containing("channel sun.B"));
    planes = makePlanes(false);
    planes.width = kWidth + 1;
    CHECK_THAT(errorOf([&] { writer.addFrame({}, planes); }), containing("8 x 5 pixels"));
    writer.addFrame({}, makePlanes(false));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "capture.json")); // not a capture before finish()
    writer.finish();
    CHECK(readingError(folder.path()).empty());
}
