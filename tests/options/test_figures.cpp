// What an option costs, or guarantees, in numbers.
#include "catch.h"
#include "measures.h"
#include "options.h"
#include <cmath>
#include <cstdio>

using namespace options;
using Slot = nrd::ResourceType;

namespace
{
constexpr glm::ivec2 kSize{96, 64};
constexpr int kFrames = 16;

bool isDirections(Slot output) { return output == Slot::OUT_DIFF_SH1 || output == Slot::OUT_SPEC_SH1; }
bool isHitDist(Slot output) { return output == Slot::OUT_DIFF_HITDIST || output == Slot::OUT_SPEC_HITDIST; }

Setup preciseSetup(nrd::Denoiser denoiser)
{
    Setup setup = makeSetup(denoiser, kSize);
    setup.hasLargeFormats = true;
    return setup;
}

// A wall across the whole picture.
quality::Guides renderWall(const quality::Camera& camera, glm::ivec2 size, int)
{
    const size_t count = static_cast<size_t>(size.x * size.y);
    return {camera, std::vector<float>(count, 5.0f), std::vector<glm::vec3>(count, glm::vec3(0, 0, -1)),
            std::vector<float>(count, 0.7f)};
}

quality::Camera standStill(int)
{
    quality::Camera camera;
    return camera; // at the origin, along +Z
}

double columnMean(const Result& result, Slot output, int firstColumn, int columnCount)
{
    double sum = 0.0;
    for (int y = 0; y < result.frame.rect.y; y++)
        for (int x = firstColumn; x < firstColumn + columnCount; x++)
            sum += static_cast<double>(result.outputs.at(output)[result.frame.texel(x, y)].x);
    return sum / (columnCount * result.frame.rect.y);
}

// Step of luma across the border between two materials, of one that is 2 high.
double borderStep(Runner& runner, nrd::Denoiser denoiser, uint32_t minMaterial)
{
    Setup setup = preciseSetup(denoiser);
    setup.camera = standStill;
    setup.scene = renderWall;
    setup.hasMaterials = true;
    setup.meanAt = [](glm::vec3, glm::ivec2 pixel, int) { return pixel.x < kSize.x / 2 ? 1.0f : 3.0f; };
    setup.changeSettings([=](auto& s) { s.minMaterialForDiffuse = s.minMaterialForSpecular = minMaterial; });
    const Result last = runFrames(runner, setup, kFrames);
    double least = 1e30;
    for (const auto& [slot, plane] : last.outputs)
    {
        if (isDirections(slot)) continue;
        const int middle = kSize.x / 2;
        least = std::min(least, columnMean(last, slot, middle, 2) - columnMean(last, slot, middle - 2, 2));
    }
    return least;
}

struct Incomplete
{
    const char* name;
    nrd::CheckerboardMode checkerboard;
    bool isHalfMissing;
};

Setup incompleteSetup(nrd::Denoiser denoiser, const Incomplete& kind)
{
    Setup setup = preciseSetup(denoiser);
    setup.isHalfMissing = kind.isHalfMissing;
    setCheckerboard(setup, kind.checkerboard);
    if (kind.isHalfMissing)
        setup.changeSettings([](auto& s)
                             { s.hitDistanceReconstructionMode = nrd::HitDistanceReconstructionMode::AREA_5X5; });
    return setup;
}

void checkIncomplete(const Result& full, const Result& part, const Incomplete& kind, nrd::Denoiser denoiser)
{
    for (const auto& [slot, plane] : full.outputs)
    {
        const double mean = signalMean(part, slot) / signalMean(full, slot);
        const double error = signalError(part, slot) / signalError(full, slot);
        const bool hasHitDist = familyOf(denoiser) == Family::Reblur && !isDirections(slot) && !isHitDist(slot);
        const double hitDist = hasHitDist ? hitDistError(part, slot) / hitDistError(full, slot) : 0.0;
        std::printf("FIGURE %s, %s, %s: mean %.4f, error %.3f, hit distance error %.3f of the complete input's\n",
                    nrd::toString(denoiser), nrd::toString(slot), kind.name, mean, error, hitDist);
        INFO(nrd::toString(denoiser) << ", " << nrd::toString(slot) << ", " << kind.name);
        if (!isDirections(slot)) CHECK(std::abs(mean - 1.0) < 0.02);
        if (!kind.isHalfMissing || isHitDist(slot)) CHECK(error < (kind.isHalfMissing ? 2.0 : 1.6));
        if (kind.isHalfMissing && hasHitDist) CHECK(hitDist < 2.0);
    }
}
} // namespace

TEST_CASE("a checkerboard and a chosen lobe keep the mean, at a bounded cost", "[gpu]")
{
    const Incomplete kinds[] = {{"checkerboard", nrd::CheckerboardMode::BLACK, false},
                                {"one lobe a pixel", nrd::CheckerboardMode::OFF, true}};
    for (const nrd::Denoiser denoiser : testedDenoisers())
    {
        if (!isRepresentative(denoiser) || denoiser == nrd::Denoiser::REFERENCE) continue;
        Runner runner(denoiser);
        const Result full = runFrames(runner, preciseSetup(denoiser), kFrames);
        for (const Incomplete& kind : kinds)
            if (!kind.isHalfMissing || familyOf(denoiser) != Family::Sigma)
                checkIncomplete(full, runFrames(runner, incompleteSetup(denoiser, kind), kFrames), kind, denoiser);
    }
}

TEST_CASE("reference accumulation is the running mean of a static view", "[gpu]")
{
    for (const nrd::Denoiser denoiser : testedDenoisers())
    {
        if (familyOf(denoiser) != Family::Reblur) continue; // the others have none
        Runner runner(denoiser);
        Setup setup = preciseSetup(denoiser);
        setup.settings.enableReferenceAccumulation = true;
        setup.speed = 0.0f;
        runner.start(setup);
        std::map<Slot, Plane> sums;
        Result last;
        for (int frame = 0; frame < kFrames; frame++)
        {
            last = runner.denoise(frame);
            for (const auto& [slot, plane] : last.frame.noisy)
            {
                sums[slot].resize(plane.size(), glm::vec4(0.0f));
                for (size_t i = 0; i < plane.size(); i++) sums[slot][i] += plane[i];
            }
        }
        for (const auto& [slot, plane] : last.outputs)
        {
            double worst = 0.0;
            forEachPixel(last.frame,
                         [&, &slot = slot, &plane = plane](size_t pixel, size_t texel)
                         {
                             const glm::vec4 d = plane[texel] - sums[slot][pixel] / float(kFrames);
                             worst = std::max(worst, static_cast<double>(std::abs(d.x)));
                         });
            std::printf("FIGURE %s, %s, reference accumulation: %.5f from the running mean at worst\n",
                        nrd::toString(denoiser), nrd::toString(slot), worst);
            INFO(nrd::toString(denoiser) << ", " << nrd::toString(slot));
            // Two steps of a half float at the largest means; ten bits with dither for directions.
            CHECK(worst < (isDirections(slot) ? 0.01 : 0.002));
        }
    }
}

TEST_CASE("a confidence of 0 leaves no history", "[gpu]")
{
    for (const nrd::Denoiser denoiser :
         {nrd::Denoiser::REBLUR_DIFFUSE, nrd::Denoiser::REBLUR_SPECULAR, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR_SH,
          nrd::Denoiser::RELAX_DIFFUSE, nrd::Denoiser::RELAX_SPECULAR, nrd::Denoiser::RELAX_DIFFUSE_SPECULAR_SH})
    {
        Runner runner(denoiser);
        Setup setup = makeSetup(denoiser, kSize);
        setup.settings.returnHistoryLengthInsteadOfOcclusion = true;
        setup.speed = 0.0f;
        const auto longest = [&]
        {
            const Result last = runFrames(runner, setup, 8);
            float length = 0.0f;
            for (const auto& [slot, plane] : last.outputs)
                if (!isDirections(slot))
                    forEachPixel(last.frame,
                                 [&, &plane = plane](size_t, size_t i) { length = std::max(length, plane[i].w); });
            return length;
        };
        CHECK(longest() == 7.0f);
        setup.confidence = 0.0f;
        CHECK(longest() == 0.0f);
    }
}

TEST_CASE("a border between materials is sharp with the test on, and bleeds with it off", "[gpu]")
{
    for (const nrd::Denoiser denoiser :
         {nrd::Denoiser::REBLUR_DIFFUSE, nrd::Denoiser::REBLUR_SPECULAR, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR_SH,
          nrd::Denoiser::RELAX_DIFFUSE, nrd::Denoiser::RELAX_SPECULAR, nrd::Denoiser::RELAX_DIFFUSE_SPECULAR_SH})
    {
        Runner runner(denoiser);
        const double on = borderStep(runner, denoiser, 0), off = borderStep(runner, denoiser, 4);
        std::printf("FIGURE %s: step of 2 between materials: %.3f with the test, %.3f without\n",
                    nrd::toString(denoiser), on, off);
        CHECK(on > 1.8);
        CHECK(off < 1.5);
    }
}
