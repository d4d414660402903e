// The viewer without a window, on the device, validation on: it follows every setting, view and denoiser.
#include "catch.h"
#include "engine/transfer.h"
#include "gltf_builder.h"
#include "long_form.h"
#include "sample_device.h"
#include "shaders/view_modes.h"
#include "viewer_fixture.h"
#include "window/recorder.h"
#include "window/views.h"

#include <cmath>
#include <set>

using namespace sample;
using test::kFrame;
using test::makeViewer;
using test::optionsFor;
using test::show;

namespace
{
std::string endOf(const SettingField& field, bool isHigh)
{
    const double step = 0.02 * ((std::isinf(field.range.high) ? 100.0 : field.range.high) - field.range.low);
    const double high = std::isinf(field.range.high) ? 100.0 : field.range.high;
    const double value = isHigh ? high : field.range.low + (field.range.isLowExcluded ? step : 0.0);
    return std::to_string(std::holds_alternative<float*>(field.target) ? value : std::round(value)).substr(0, 6);
}

std::vector<std::string> valuesOf(const SettingField& field)
{
    if (std::holds_alternative<bool*>(field.target)) return {"true", "false"};
    std::vector<std::string> values;
    for (const char* name : modeNames(field.target)) values.push_back(name);
    if (!values.empty()) return values;
    for (bool isHigh : {false, true})
    {
        std::string text = endOf(field, isHigh);
        if (!std::holds_alternative<float*>(field.target)) text = text.substr(0, text.find('.'));
        values.push_back(text);
    }
    return values;
}

// Every value either shows in the next frame's settings or is refused by name and undone.
size_t walkSettings(Viewer& viewer)
{
    ReplaySettings table;
    size_t count = 0;
    for (const SettingField& field : panelFields(table, viewer.state.sides[0].set))
        for (const std::string& value : valuesOf(field))
        {
            INFO(field.name << "=" << value);
            viewer.state.sides[0].settings.clear();
            viewer.set({field.name, value});
            REQUIRE(viewer.advance(kFrame));
            INFO(viewer.message());
            if (viewer.wasRefused())
            {
                CHECK(viewer.state.sides[0].settings != std::vector<Assignment>{{field.name, value}});
                CHECK_THAT(viewer.message(), containing("FrameNum")); // those that bound each other
            }
            ++count;
        }
    test::sampleDevice().waitIdle();
    return count;
}
} // namespace

TEST_CASE("all settings of the panel can be walked through while frames are rendered", "[gpu]")
{
    Viewer viewer = makeViewer("panes", "REBLUR_SPECULAR+SIGMA_SHADOW");
    viewer.state.animationSpeed = 0.0f;
    size_t count = walkSettings(viewer);
    viewer.state.hasConfidence = true;
    viewer.state.sides[0].resolution = {2, true};
    for (const char* name : {"RELAX_DIFFUSE+SIGMA_SHADOW", "REFERENCE+SIGMA_SHADOW"})
    {
        viewer.setDenoisers(name);
        count += walkSettings(viewer);
    }
    CHECK(count > 200);
    CHECK(test::sampleDevice().validationMessageCount() == 0);
}

TEST_CASE("a pair of settings that bound each other is refused and undone", "[gpu]")
{
    Viewer viewer = makeViewer("cornell", "REBLUR_DIFFUSE", GENERATE(FirstPicture::Denoised, FirstPicture::Noisy));
    viewer.advance(kFrame);
    viewer.set({"maxFastAccumulatedFrameNum", "2"}); // historyFixFrameNum is 3
    viewer.advance(kFrame);
    CHECK(viewer.wasRefused());
    CHECK_THAT(viewer.message(), containing("historyFixFrameNum"));
    CHECK(viewer.state.sides[0].settings.empty());
    CHECK_THROWS_WITH(viewer.set({"maxBlurRadius", "300"}), containing("[0; 256]"));
    CHECK_THROWS_WITH(viewer.set({"noSuchThing", "1"}), containing("noSuchThing"));
    viewer.set({"maxBlurRadius", "10"});
    viewer.advance(kFrame);
    CHECK_FALSE(viewer.wasRefused());
}

TEST_CASE("every view of every kind of denoiser is drawn", "[gpu]")
{
    Viewer viewer = makeViewer("panes", "REBLUR_DIFFUSE_SPECULAR+SIGMA_SHADOW_TRANSLUCENCY");
    viewer.state.hasReference = viewer.state.hasConfidence = true;
    viewer.state.animationSpeed = 0.0f;
    std::set<std::string> pictures;
    for (size_t i = 0; i < views().size(); ++i)
    {
        INFO(views()[i].name);
        viewer.state.view = i;
        viewer.advance(kFrame);
        CHECK(viewer.viewedImage());
        pictures.insert(show(viewer));
    }
    CHECK(pictures.size() > views().size() - 5); // hardly two look the same
    viewer.setDenoisers("RELAX_DIFFUSE,SIGMA_SHADOW");
    viewer.advance(kFrame);
    for (size_t i = 0; i < views().size(); ++i)
    {
        viewer.state.view = i;
        if (views()[i].mode == VIEW_OVERLAY) viewer.advance(kFrame);
        show(viewer);
    }
    CHECK_FALSE(viewer.wasRefused());
    CHECK(test::sampleDevice().validationMessageCount() == 0);
}

TEST_CASE("the first picture may be noisy, so that it comes soon; settings wait for the denoiser", "[gpu]")
{
    Viewer noisy = makeViewer("cornell", "NONE");
    Viewer viewer = makeViewer("cornell", "REBLUR_DIFFUSE_SPECULAR", FirstPicture::Noisy);
    viewer.set({"maxAccumulatedFrameNum", "7"});
    CHECK_FALSE(viewer.awaitsDenoisers());
    noisy.advance(kFrame);
    viewer.advance(kFrame);
    CHECK(viewer.awaitsDenoisers());
    CHECK(show(viewer) == show(noisy));
    noisy.advance(kFrame);
    viewer.advance(kFrame);
    CHECK_FALSE(viewer.awaitsDenoisers());
    CHECK(show(viewer) != show(noisy));
    CHECK(viewer.settingsOf(viewer.state.sides[0]).reblur.maxAccumulatedFrameNum == 7);
    CHECK_FALSE(viewer.wasRefused());
}

TEST_CASE("left of the split is A, right of it B", "[gpu]")
{
    Viewer viewer = makeViewer("cornell", "REBLUR_DIFFUSE_SPECULAR,NONE");
    for (int k = 0; k < 4; ++k) viewer.advance(kFrame);
    const auto at = [&](float split)
    {
        viewer.state.split = split;
        return show(viewer);
    };
    const std::string denoised = at(1.0f), noisy = at(-1.0f), both = at(0.5f);
    REQUIRE(denoised != noisy);
    bool isRight = true;
    for (size_t y = 0; y < 20; ++y)
        for (size_t x = 0; x < 32; ++x)
            for (size_t c = 0; c < 3 && x != 16; ++c)
            {
                const size_t i = (y * 32 + x) * 4 + c;
                isRight &= both[i] == (x < 16 ? denoised[i] : noisy[i]);
            }
    CHECK(isRight);
}

TEST_CASE("tracing and denoising are timed pass by pass", "[gpu]")
{
    Viewer viewer = makeViewer("cornell", "REBLUR_DIFFUSE");
    viewer.state.hasConfidence = true;
    for (int k = 0; k < 5; ++k) viewer.advance(kFrame);
    const std::vector<nrd::PassTime>& times = viewer.renderer().tracingTimes();
    REQUIRE(times.size() == 2);
    CHECK(std::string(times[0].name) == "re-traced samples");
    CHECK(std::string(times[1].name) == "paths");
    CHECK(times[1].milliseconds > times[0].milliseconds); // one path in 25
    CHECK(viewer.side(0).timings().passesNum > 5);
    viewer.state.hasConfidence = false;
    for (int k = 0; k < 5; ++k) viewer.advance(kFrame);
    CHECK(viewer.renderer().tracingTimes().size() == 1);
}

TEST_CASE("settings of the history confidence reach it", "[gpu]")
{
    Viewer viewer = makeViewer("panes", "REBLUR_DIFFUSE_SPECULAR"); // one sphere moves
    viewer.state.hasConfidence = true;
    const auto meanOf = [&](const char* sensitivity)
    {
        viewer.set({"confidence.sensitivity", sensitivity});
        viewer.set({"confidence.tolerance", "0"});
        for (int k = 0; k < 3; ++k) viewer.advance(kFrame);
        double sum = 0.0;
        for (uint8_t x : engine::readBackAs<uint8_t>(test::sampleDevice(), *viewer.side(0).confidence(Lobe::Diffuse)))
            sum += double(x);
        return sum;
    };
    const double trusting = meanOf("0.01");
    CHECK(meanOf("100") < 0.98 * trusting);
    CHECK_THROWS_WITH(viewer.set({"confidence.sensitivity", "101"}), containing("(0; 100]"));
}

TEST_CASE("a reference gathers while the camera rests and starts anew when it moves", "[gpu]")
{
    Viewer viewer = makeViewer("cornell", "REBLUR_DIFFUSE_SPECULAR,NONE");
    viewer.state.animationSpeed = 0.0f;
    viewer.state.hasReference = true;
    viewer.state.referenceSamples = 8;
    for (int k = 0; k < 24; ++k) viewer.advance(kFrame);
    CHECK(viewer.reference().sampleCount() >= 180);
    REQUIRE(viewer.errors()[0]);
    REQUIRE(viewer.errors()[1]);
    CHECK(*viewer.errors()[0] > *viewer.errors()[1] + 3.0); // denoised is nearer to it than noisy
    viewer.startCamera(CameraMode::Orbit);
    CameraInput input;
    input.turn.x = 0.1f;
    viewer.state.camera.apply(CameraMode::Orbit, input);
    viewer.advance(kFrame);
    CHECK(viewer.reference().sampleCount() == 8);
}

TEST_CASE("pausing renders nothing, stepping one frame", "[gpu]")
{
    Viewer viewer = makeViewer("cornell", "REBLUR_DIFFUSE");
    CHECK(viewer.advance(kFrame));
    viewer.state.isPaused = true;
    CHECK_FALSE(viewer.advance(kFrame));
    viewer.state.steps = 1;
    CHECK(viewer.advance(kFrame));
    CHECK_FALSE(viewer.advance(kFrame));
    CHECK(viewer.renderer().frameIndex() == 1);
}

TEST_CASE("the picked pixel tells its history, which a restart takes away", "[gpu]")
{
    Viewer viewer = makeViewer("cornell", "REBLUR_DIFFUSE_SPECULAR");
    viewer.state.animationSpeed = 0.0f;
    viewer.state.picked = glm::ivec2(16, 10);
    for (int k = 0; k < 12; ++k) viewer.advance(kFrame);
    const std::optional<float> before = viewer.readPicked().historyLength[0];
    viewer.state.isRestarted = true;
    viewer.advance(kFrame);
    const PickedPixel after = viewer.readPicked();
    REQUIRE(before);
    REQUIRE(after.historyLength[0]);
    CHECK(*before > 8.0f);
    CHECK(*after.historyLength[0] < 3.0f);
    CHECK(after.viewZ < 0.0f);
}

TEST_CASE("tracing, lights and size can be changed between frames", "[gpu]")
{
    Viewer viewer = makeViewer("panes", "REBLUR_DIFFUSE_SPECULAR");
    viewer.state.animationSpeed = 0.0f;
    viewer.state.lobes = Lobes::Both;
    for (int k = 0; k < 3; ++k) viewer.advance(kFrame);
    const std::string before = show(viewer);
    viewer.state.sun.azimuth += 60.0f;
    for (int k = 0; k < 3; ++k) viewer.advance(kFrame);
    CHECK(show(viewer) != before);
    viewer.state.lobes = Lobes::Probabilistic;
    CHECK(viewer.advance(kFrame));
    viewer.state.lobes = Lobes::Both;
    viewer.state.checkerboard = nrd::CheckerboardMode::BLACK;
    viewer.state.bounces = 2;
    CHECK(viewer.advance(kFrame));
    viewer.resize(48, 33);
    CHECK(viewer.advance(kFrame));
    CHECK(show(viewer).size() == 48 * 33 * 4);
    viewer.state.lobes = Lobes::Merged; // which leaves nothing to a specular denoiser
    CHECK(viewer.advance(kFrame));
    CHECK(viewer.state.lobes == Lobes::Both);
    CHECK_FALSE(viewer.message().empty());
    CHECK(test::sampleDevice().validationMessageCount() == 0);
}

TEST_CASE("mirrors are followed and edges smoothed as soon as that is asked for", "[gpu]")
{
    Viewer viewer = makeViewer("mirror", "REBLUR_DIFFUSE_SPECULAR");
    viewer.state.animationSpeed = 0.0f;
    CHECK(viewer.advance(kFrame));
    viewer.state.picked = glm::ivec2(16, 8); // in the mirror
    const float mirror = viewer.readPicked().viewZ;
    viewer.state.hasPsr = true;
    CHECK(viewer.advance(kFrame));
    CHECK(viewer.readPicked().viewZ < mirror - 1.0f); // what it shows lies behind it
    const std::string aliased = show(viewer);
    viewer.state.hasTemporalAa = true;
    for (int k = 0; k < 6; ++k) viewer.advance(kFrame);
    CHECK(show(viewer) != aliased);
    CHECK(&viewer.side(0).shown() != &viewer.side(0).composed());
    viewer.state.hasPsr = viewer.state.hasTemporalAa = false;
    CHECK(viewer.advance(kFrame));
    CHECK(viewer.readPicked().viewZ == Approx(mirror));
    CHECK(test::sampleDevice().validationMessageCount() == 0);
}

TEST_CASE("what the viewer records is a capture", "[gpu]")
{
    const test::TemporaryFolder folder;
    Viewer viewer = makeViewer("panes", "REBLUR_DIFFUSE_SPECULAR+SIGMA_SHADOW");
    Recorder recorder(test::sampleDevice());
    viewer.advance(kFrame);
    recorder.startCapture(viewer, folder / "capture");
    recorder.startSequence(folder / "sequence");
    for (int k = 0; k < 3; ++k)
    {
        viewer.advance(kFrame);
        show(viewer);
        recorder.addFrame(viewer);
    }
    recorder.stopCapture();
    const Capture capture = Capture::open(folder / "capture");
    CHECK(capture.info().frames.size() == 3);
    CHECK(capture.info().frames[0].isCut);
    CHECK_FALSE(capture.info().frames[1].isCut);
    CHECK(capture.readFrame(2).has(Channel::ShadowDist));
    CHECK(std::filesystem::exists(folder / "sequence" / "frame_00002.png"));
    recorder.saveBuffer(viewer, folder / "a.exr");
    CHECK(readImage(folder / "a.exr").width == 32);
    CHECK_THROWS_WITH(recorder.savePicture(viewer, folder / "a.jpg"), containing(".png or .exr"));
}
