// Signals of fewer pixels than the picture: chosen for each side, traced where they are read.
#include "catch.h"
#include "engine/transfer.h"
#include "sample_device.h"
#include "viewer_fixture.h"

#include <array>
#include <set>

using namespace sample;
using test::kFrame;
using test::optionsFor;
using test::show;

namespace
{
constexpr const char* kPanes = "REBLUR_DIFFUSE_SPECULAR+SIGMA_SHADOW";

Viewer makeHalf(const char* denoisers, const Resolution& resolution)
{
    Options options = optionsFor("panes", denoisers);
    options.resolution = resolution;
    return Viewer(test::sampleDevice(), loadStage(options), options, 2);
}

std::string showFrames(Viewer& viewer, int count)
{
    viewer.state.animationSpeed = 0.0f;
    for (int k = 0; k < count; ++k) REQUIRE(viewer.advance(kFrame));
    CHECK_FALSE(viewer.wasRefused());
    return show(viewer);
}

// Of the specular signal, which every surface has: pixels with a path in every second column of every second row, and
// the others.
std::array<int, 2> tracedPixels(Viewer& viewer)
{
    const auto texels = engine::readBackAs<float>(test::sampleDevice(), viewer.renderer().tracer().images().specular);
    std::array<int, 2> counts = {};
    for (size_t i = 0; i < texels.size() / 4; ++i)
        counts[(i % 32) % 2 + (i / 32) % 2 > 0] += texels[i * 4 + 3] > 0.0f; // the hit distance
    return counts;
}
} // namespace

TEST_CASE("sparse tracing has paths in a quarter of the pixels, and the same picture as if all had them", "[gpu]")
{
    Viewer full = makeHalf(kPanes, {}), sparse = makeHalf(kPanes, {2, true}), whole = makeHalf(kPanes, {2, true});
    whole.traceAllPixels(true);
    const std::string picture = showFrames(sparse, 4);
    CHECK(showFrames(whole, 4) == picture);
    CHECK(showFrames(full, 4) != picture);
    CHECK(sparse.stride() == 2);
    CHECK(whole.stride() == 1);
    CHECK(tracedPixels(full) == std::array{16 * 10, 48 * 10});
    CHECK(tracedPixels(sparse) == std::array{16 * 10, 0});
    CHECK(tracedPixels(whole) == std::array{16 * 10, 48 * 10});
    CHECK(test::sampleDevice().validationMessageCount() == 0);
}

TEST_CASE("half resolution is switched while frames are rendered, for each side alone", "[gpu]")
{
    Viewer viewer = makeHalf("REBLUR_DIFFUSE_SPECULAR+SIGMA_SHADOW,RELAX_DIFFUSE_SPECULAR+SIGMA_SHADOW", {});
    viewer.state.hasConfidence = viewer.state.hasReference = true;
    viewer.state.split = 1.0f;
    std::set<std::string> pictures;
    for (const Resolution& resolution : {Resolution(), Resolution{2, false}, Resolution{2, true}})
    {
        viewer.state.sides[0].resolution = resolution;
        viewer.state.isRestarted = true;
        pictures.insert(showFrames(viewer, 3));
        CHECK(viewer.stride() == 1); // B reads them all
    }
    CHECK(pictures.size() == 3);
    viewer.state.sides[1].resolution = viewer.state.sides[0].resolution;
    viewer.state.picked = glm::ivec2(17, 11); // between those that have paths
    showFrames(viewer, 12);
    CHECK(viewer.stride() == 2);
    CHECK(viewer.readPicked().historyLength[0].value_or(0.0f) > 8.0f);
    CHECK(viewer.reference().sampleCount() > 8);
    viewer.state.lobes = Lobes::Probabilistic;
    showFrames(viewer, 1);
    CHECK(viewer.state.lobes == Lobes::Both);
    CHECK_THAT(viewer.message(), containing("sparse tracing leaves out"));
    viewer.state.checkerboard = nrd::CheckerboardMode::WHITE;
    showFrames(viewer, 1);
    CHECK(viewer.state.checkerboard == nrd::CheckerboardMode::OFF);
    CHECK_THAT(viewer.message(), containing("without a checkerboard"));
    CHECK(test::sampleDevice().validationMessageCount() == 0);
}
