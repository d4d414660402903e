// Pictures of any shape, with next to nothing in them, and rectangles that change.
#include "catch.h"
#include "figures.h"
#include "levels.h"
#include "poison.h"
#include "runners.h"
#include <cmath>

using namespace stability;

namespace
{
struct Shape
{
    const char* name;
    glm::ivec2 size;
    glm::ivec2 rect;
    bool isRectVarying = false; // in size; the origin stays
};

const Shape kSmallShapes[] = {
    {"1x1", {1, 1}, {1, 1}},
    {"2x1", {2, 1}, {2, 1}},
    {"1x2", {1, 2}, {1, 2}},
    {"37x23", {37, 23}, {37, 23}},
    {"1x1 of 37x23", {37, 23}, {1, 1}},
    {"30x17 of 37x23", {37, 23}, {30, 17}},
    {"37x23, another rectangle each frame", {37, 23}, {37, 23}, true},
    {"30x17 of 37x23, another rectangle each frame", {37, 23}, {30, 17}, true},
};

const Shape kWideShapes[] = {
    {"8192x1", {8192, 1}, {8192, 1}},
    {"1x8192", {1, 8192}, {1, 8192}},
    {"8192x8", {8192, 8}, {8192, 8}},
    {"5000x5 of 8192x8", {8192, 8}, {5000, 5}},
};

// Texels that are wrong in any of the frames.
struct Findings
{
    size_t stray = 0;   // written where nothing is to be written
    size_t unsound = 0; // outputs and histories that hold what is no number
};

Findings runFrames(const options::Setup& setup, int frameCount)
{
    options::Runner& runner = runnerOf(setup.denoiser);
    runner.start(setup);
    Findings findings;
    for (int frame = 0; frame < frameCount; frame++)
    {
        const options::Result result = runner.denoise(frame);
        const std::string unsound = findUnsound(result, runner.histories());
        INFO(nrd::toString(setup.denoiser) << ", frame " << frame);
        CHECK(unsound == "");
        findings.unsound += !unsound.empty();
        if (frame > 0) findings.stray += options::countStray(result); // the first use clears the outputs
    }
    return findings;
}

Findings runShape(nrd::Denoiser denoiser, const Shape& shape, int frameCount)
{
    options::Setup setup = makeSetup(denoiser);
    setup.size = shape.size;
    setup.rect = shape.rect;
    setup.origin = shape.size - shape.rect; // of guides; outputs lie at the top left
    setup.isRectVarying = shape.isRectVarying;
    return runFrames(setup, frameCount);
}

void checkShapes(std::span<const Shape> shapes, const Filter& filter, int frameCount)
{
    for (const Shape& shape : shapes)
    {
        Figure stray(std::string(shape.name) + ": texels written outside", "texels", 0.0);
        Figure unsound(std::string(shape.name) + ": outputs or histories that hold no numbers", "images", 0.0);
        for (const nrd::Denoiser denoiser : denoisersThat(filter))
        {
            const Findings findings = runShape(denoiser, shape, frameCount);
            stray.add(denoiser, double(findings.stray));
            unsound.add(denoiser, double(findings.unsound));
        }
    }
}

constexpr glm::ivec2 kOnly{17, 11};

// Sky, but for one pixel or none.
void emptyScene(options::Setup& setup, bool hasOne)
{
    setup.scene = [hasOne](const quality::Camera& camera, glm::ivec2 size, int)
    {
        quality::Guides guides = quality::renderGuides(camera, size.x, size.y);
        const size_t only = size_t(kOnly.y * size.x + kOnly.x);
        for (size_t i = 0; i < guides.viewZ.size(); i++)
            if (!hasOne || i != only) guides.viewZ[i] = 2.0f * quality::kDenoisingRange;
        if (hasOne) guides.viewZ[only] = 3.0f;
        return guides;
    };
}
} // namespace

TEST_CASE("pictures of any small shape are denoised, and nothing outside is touched", "[gpu]")
{
    checkShapes(kSmallShapes, isLong() ? isAny : isWidest, 4);
}

TEST_CASE("pictures 8192 pixels wide or high are denoised, and nothing outside is touched", "[gpu]")
{
    checkShapes(kWideShapes, isLong() ? isAny : isWidest, 2);
}

TEST_CASE("nothing is written to a sky", "[gpu]")
{
    Figure stray("all sky: texels written", "texels", 0.0);
    for (const nrd::Denoiser denoiser : denoisersThat(isDenoiser)) // REFERENCE knows no sky
    {
        options::Setup setup = makeSetup(denoiser);
        emptyScene(setup, false);
        const Findings findings = runFrames(setup, 3);
        stray.add(denoiser, double(findings.stray + findings.unsound));
    }
}

TEST_CASE("a pixel alone in the sky is the mean of its own samples", "[gpu]")
{
    Figure stray("one pixel in the sky: texels written elsewhere", "texels", 0.0);
    // Opposite frames, 24 of them: an exponential mean of n + 1 keeps 1 / (2 n + 1) of the last one, with SIGMA's n
    // = 8.
    Figure error("one pixel in the sky: its distance from its mean", "%", 6.0);
    for (const nrd::Denoiser denoiser : denoisersThat(isDenoiser))
    {
        options::Setup setup = makeSetup(denoiser);
        emptyScene(setup, true);
        setup.isAntithetic = true;
        const Findings findings = runFrames(setup, 3);
        stray.add(denoiser, double(findings.stray + findings.unsound));
        const std::vector<Level> levels = levelsOf(runToLast(setup, 24), denoiser);
        for (const Level& level : levels) error.add(denoiser, 100.0 * std::abs(level.denoised / level.truth - 1.0));
    }
}
