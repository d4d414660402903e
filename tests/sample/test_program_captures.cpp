// What nrd-sample records: shadows that are traced apart, and checkerboards.
#include "capture.h"
#include "catch.h"
#include "gltf_builder.h"
#include "program.h"

#include <cmath>

using test::Outcome;
using test::run;

TEST_CASE("a capture of a shadow that is traced apart adds up to its reference", "[program]")
{
    using sample::Channel;
    const test::TemporaryFolder folder;
    const Outcome outcome = run("--headless --validation --scene panes --size 64x36 --frames 2 --shadow-signal "
                                "--denoiser NONE --sun-radius 3 --reference-spp 64 --reference-frames 1 --capture " +
                                (folder / "capture").string());
    INFO(outcome.errors);
    REQUIRE(outcome.exitCode == 0);
    const sample::Capture capture = sample::Capture::open(folder / "capture");
    REQUIRE(capture.light(1));
    CHECK_FALSE(capture.info().frames[1].light); // it stands still
    CHECK_FALSE(capture.light(1)->isLocal);
    CHECK(capture.light(1)->tanAngularRadius == Approx(std::tan(3.0 * 3.14159265 / 180.0)));
    CHECK(capture.light(1)->direction[1] > 0.3);
    const sample::Planes frame = capture.readFrame(1), reference = capture.readReference(1);
    size_t penumbraCount = 0, wrongCount = 0;
    for (size_t i = 0; i < frame.pixelCount(); ++i)
    {
        const float v = reference[Channel::RefShadowV][i];
        penumbraCount += v > 0.1f && v < 0.9f;
        wrongCount += v > reference[Channel::RefShadowG][i] + 1e-5f; // what is lit lets everything through
        wrongCount += (frame[Channel::ShadowDist][i] == 0.0f) != (frame[Channel::SunG][i] == 0.0f);
        for (int c = 0; c < 3; ++c)
        {
            const auto at = [&](const sample::Planes& planes, Channel first) { return planes[next(first, c)][i]; };
            const float sum = at(frame, Channel::DirectR) +
                              at(frame, Channel::SunR) * at(reference, Channel::RefShadowR) +
                              at(frame, Channel::DiffuseFactorR) * at(reference, Channel::RefDiffuseR) +
                              at(frame, Channel::SpecularFactorR) * at(reference, Channel::RefSpecularR);
            wrongCount += std::abs(sum - at(reference, Channel::RefComposedR)) > 2e-3f * (1.0f + sum);
        }
    }
    CHECK(penumbraCount > 20);
    CHECK(wrongCount == 0);
}

TEST_CASE("a capture of a spot's shadow has its place and its size", "[program]")
{
    const test::TemporaryFolder folder;
    test::GltfFile file = test::makeTriangle();
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", nlohmann::json::object()}, {"extras", {{"radius", 0.25}}}}};
    file.json["nodes"].push_back(
        {{"translation", {0.25, 0.25, 2.0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    file.writeBinary(folder / "spot.glb");
    const std::string path = (folder / "capture").string();
    const Outcome outcome = run("--headless --validation --size 24x16 --frames 1 --shadow-signal --capture " + path +
                                " " + (folder / "spot.glb").string());
    INFO(outcome.errors);
    REQUIRE(outcome.exitCode == 0);
    const sample::Capture capture = sample::Capture::open(path);
    const sample::CaptureLight* light = capture.light(0);
    REQUIRE(light);
    CHECK(light->isLocal);
    CHECK(light->radius == 0.25);
    CHECK(light->position == std::array<double, 3>{0.25, 0.25, 2.0});
}

TEST_CASE("a capture of a checkerboard says so and has its holes", "[program]")
{
    const test::TemporaryFolder folder;
    const std::string path = (folder / "capture").string();
    REQUIRE(run("--headless --size 32x18 --frames 2 --denoiser NONE --checkerboard white --capture " + path).exitCode ==
            0);
    const sample::Capture capture = sample::Capture::open(path);
    CHECK(capture.info().checkerboard == sample::CaptureCheckerboard::White);
    for (uint32_t f = 0; f < 2; ++f)
    {
        const sample::Planes frame = capture.readFrame(f);
        size_t wrongCount = 0, diffuseCount = 0;
        for (uint32_t i = 0; i < frame.pixelCount(); ++i)
        {
            const bool isDiffuse = ((i % 32 + i / 32 + f) & 1u) == 1;
            const bool hasDiffuse = frame[sample::Channel::DiffuseHitDist][i] > 0.0f;
            const bool hasSpecular = frame[sample::Channel::SpecularHitDist][i] > 0.0f;
            wrongCount += hasSpecular == isDiffuse || (hasDiffuse && !isDiffuse);
            wrongCount += !hasDiffuse && frame[sample::Channel::DiffuseG][i] != 0.0f;
            diffuseCount += hasDiffuse;
        }
        CHECK(wrongCount == 0);
        CHECK(diffuseCount > 200);
    }
}
