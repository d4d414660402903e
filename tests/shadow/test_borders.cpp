// Tiles of 16 pixels say where there is something to filter. Where their borders lie must not be seen.
#include "catch.h"
#include "pictures.h"
#include <cstdio>
#include <runner.h>

using namespace shadow;
using options::LightRay;
using options::Result;
using options::Runner;

namespace
{
constexpr int kTile = 16;
constexpr glm::ivec2 kSize{128, 64};

// A soft shadow whose rays are tied to a place that lies `shift` pixels further right and down.
Result runShifted(Runner& runner, nrd::Denoiser denoiser, glm::ivec2 shift, bool isFlat)
{
    const float pixel = pixelSizeOf(kSize);
    const Light sun = makeSun(isFlat ? 25.0f : 90.0f, 0.0f, isFlat ? 0.05f : 0.15f);
    const float height = 2.0f, edge = 2.0f * sun.direction.x / sun.direction.y;
    const Occluder occluder = makeEdge(height, edge);
    options::Setup setup = makeSetup(denoiser, kSize, sun, occluder);
    setup.rayAt = [=](glm::vec3 P, glm::ivec2 at, int frame)
    {
        P.x -= static_cast<float>(shift.x) * pixel;
        return castRay(sun, occluder, P, at - shift + 64, frame);
    };
    return options::runFrames(runner, setup, 3);
}

// Largest difference of visibility, away from the picture's border.
double worstDifference(const Result& a, const Result& b, glm::ivec2 shift)
{
    constexpr int kMargin = 20;
    double worst = 0.0;
    for (int y = kMargin; y < kSize.y - kMargin - shift.y; y++)
    {
        for (int x = kMargin; x < kSize.x - kMargin - shift.x; x++)
        {
            const glm::vec4 d = shadowOf(a, a.frame.texel(x, y)) - shadowOf(b, b.frame.texel(x + shift.x, y + shift.y));
            worst = std::max(worst, static_cast<double>(std::abs(d.x)));
        }
    }
    return worst;
}

// In every third tile each way one ray of its own meets something; all others are free.
constexpr int kCell = 3 * kTile, kCells = 8;

glm::ivec2 probeOf(glm::ivec2 cell) { return kTile + glm::ivec2(2 * cell.x + (cell.y & 1), 2 * cell.y + (cell.x & 1)); }

bool isProbe(glm::ivec2 pixel) { return pixel % kCell == probeOf(pixel / kCell); }
} // namespace

TEST_CASE("a shadow looks the same wherever the tiles' borders cross it", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        for (const bool isFlat : {false, true})
        {
            const Result still = runShifted(runner, denoiser, {0, 0}, isFlat);
            double worst = 0.0;
            for (int shift = 1; shift < kTile; shift++)
            {
                const glm::ivec2 by(shift, (5 * shift) % kTile);
                worst = std::max(worst, worstDifference(still, runShifted(runner, denoiser, by, isFlat), by));
            }
            std::printf("FIGURE %s, %s sun, 15 places of the tiles: largest difference %.5f\n", nrd::toString(denoiser),
                        isFlat ? "flat" : "steep", worst);
            CHECK(worst < 1e-4);
        }
    }
}

TEST_CASE("one ray that meets something is found wherever in its tile it is", "[gpu]")
{
    constexpr glm::ivec2 kGrid{kCell * kCells, kCell * kCells};
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        options::Setup setup = makeSetup(denoiser, kGrid, {}, {});
        setup.hasHistory = false;
        const float penumbra = 10.0f * pixelSizeOf(kGrid);
        setup.rayAt = [=](glm::vec3, glm::ivec2 pixel, int) {
            return isProbe(pixel) ? LightRay{penumbra, glm::vec4(0.0f)} : LightRay{};
        };
        const Result result = options::runFrames(runner, setup, 1);
        for (int i = 0; i < kCells * kCells; i++)
        {
            const glm::ivec2 cell(i % kCells, i / kCells), pixel = cell * kCell + probeOf(cell);
            const float own = shadowOf(result, result.frame.texel(pixel.x, pixel.y)).x;
            const float beside = shadowOf(result, result.frame.texel(pixel.x + 1, pixel.y)).x;
            INFO(nrd::toString(denoiser) << ", " << pixel.x % kTile << ", " << pixel.y % kTile);
            CHECK(own > 0.5f); // one of many in a wide penumbra; left alone it would be 0, and its neighbours 1
            CHECK(beside < 1.0f);
        }
    }
}
