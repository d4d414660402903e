// Cuts, announced or not: no frame may show what was there before, and no ordinary motion may be taken for one.
#include "catch.h"
#include "measures.h"
#include "options.h"
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <string_view>

using namespace options;

namespace
{
constexpr glm::ivec2 kSize{64, 48};
constexpr int kCutFrame = 4, kFramesAfter = 3;
constexpr float kBrightBefore = 50.0f; // so that a leak is seen

quality::Camera lookFrom(glm::vec3 position, float degrees)
{
    const float angle = glm::radians(degrees);
    quality::Camera camera;
    camera.position = position;
    camera.worldToView =
        glm::lookAtLH(position, position + glm::vec3(std::sin(angle), -0.1f, std::cos(angle)), {0, 1, 0});
    return camera;
}

// Texels of the frames from the cut on that are not those of a fresh instance.
size_t countLeaks(Runner& runner, Setup setup)
{
    setup.mean = kBrightBefore;
    runner.start(setup);
    for (int frame = 0; frame < kCutFrame; frame++) (void)runner.denoise(frame);
    setup.mean = 1.0f;
    runner.change(setup);
    std::vector<Result> used, fresh;
    for (int frame = kCutFrame; frame < kCutFrame + kFramesAfter; frame++) used.push_back(runner.denoise(frame));
    runner.start(setup);
    for (int frame = kCutFrame; frame < kCutFrame + kFramesAfter; frame++) fresh.push_back(runner.denoise(frame));
    size_t leaks = 0;
    for (size_t i = 0; i < used.size(); i++)
    {
        size_t seen = 0;
        forEachPixel(used[i].frame, [&](size_t, size_t) { seen++; });
        CHECK(seen > 100);
        leaks += countDifferent(used[i], fresh[i]);
    }
    return leaks;
}

Setup announced(nrd::Denoiser denoiser, nrd::AccumulationMode mode)
{
    Setup setup = makeSetup(denoiser, kSize);
    setup.changeCommon = [mode](nrd::CommonSettings& common, int frame)
    { common.accumulationMode = frame == kCutFrame ? mode : nrd::AccumulationMode::CONTINUE; };
    return setup;
}

// The view turns by 120 degrees, with the last frame's matrices as the previous ones.
Setup turned(nrd::Denoiser denoiser)
{
    Setup setup = makeSetup(denoiser, kSize);
    setup.camera = [](int frame) { return lookFrom({0.0f, 1.5f, 3.0f}, frame < kCutFrame ? 0.0f : 120.0f); };
    return setup;
}

// The same orientation somewhere else.
Setup teleported(nrd::Denoiser denoiser)
{
    Setup setup = makeSetup(denoiser, kSize);
    setup.camera = [](int frame)
    { return lookFrom(frame < kCutFrame ? glm::vec3(0.0f, 1.5f, -1.0f) : glm::vec3(200.0f, 1.5f, -30.0f), 0.0f); };
    return setup;
}

// The camera stays, the world is exchanged but for a strip at the left: only depths tell, and there they do not.
Setup exchanged(nrd::Denoiser denoiser)
{
    Setup setup = makeSetup(denoiser, kSize);
    setup.speed = 0.0f;
    setup.scene = [](const quality::Camera& camera, glm::ivec2 size, int frame)
    {
        quality::Guides guides = quality::renderGuides(camera, size.x, size.y);
        for (size_t i = 0; i < guides.viewZ.size(); i++)
            if (frame >= kCutFrame && i % static_cast<size_t>(size.x) >= 3) guides.viewZ[i] *= 2.0f;
        return guides;
    };
    return setup;
}

// Where the input holds no number, and no pre-pass has replaced it, history stands in.
Setup broken(nrd::Denoiser denoiser)
{
    Setup setup = announced(denoiser, nrd::AccumulationMode::RESTART);
    setup.changeSettings([](auto& s) { s.diffusePrepassBlurRadius = s.specularPrepassBlurRadius = 0.0f; });
    setup.isBroken = true;
    return setup;
}

struct Lengths
{
    double share = 1.0; // of in-range pixels with more than a frame of history
    double mean = 0.0;
};

Lengths measureLengths(const Result& result)
{
    size_t longer = 0, count = 0;
    double sum = 0.0;
    for (const auto& [slot, plane] : result.outputs)
    {
        if (slot == nrd::ResourceType::OUT_DIFF_SH1 || slot == nrd::ResourceType::OUT_SPEC_SH1) continue;
        forEachPixel(result.frame,
                     [&, &plane = plane](size_t, size_t texel)
                     {
                         longer += plane[texel].w > 1.0f;
                         sum += static_cast<double>(plane[texel].w);
                         count++;
                     });
    }
    return {static_cast<double>(longer) / static_cast<double>(count), sum / static_cast<double>(count)};
}

// SIGMA tests each pixel's own depth, and has no pass that counts how many fail; REFERENCE sees the camera only, and
// keeps what is no number.
bool isSeen(nrd::Denoiser denoiser, std::string_view cut)
{
    if (familyOf(denoiser) == Family::Sigma) return cut != "another world";
    return denoiser != nrd::Denoiser::REFERENCE || (cut != "another world" && cut != "RESTART with broken input");
}

// Occlusion and shadows cannot tell their history length, but cuts are found by passes that all denoisers share.
bool tellsLength(nrd::Denoiser denoiser)
{
    return denoiser != nrd::Denoiser::REBLUR_DIFFUSE_OCCLUSION &&
           denoiser != nrd::Denoiser::REBLUR_SPECULAR_OCCLUSION &&
           denoiser != nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR_OCCLUSION &&
           denoiser != nrd::Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION &&
           (familyOf(denoiser) == Family::Reblur || isRelax(denoiser));
}
} // namespace

TEST_CASE("from a cut on every denoiser's frames are those of a fresh instance", "[gpu]")
{
    std::map<std::string, size_t> leaksOf; // by cut
    for (const nrd::Denoiser denoiser : testedDenoisers())
    {
        Runner runner(denoiser);
        const struct
        {
            const char* name;
            Setup setup;
        } cuts[] = {{"RESTART", announced(denoiser, nrd::AccumulationMode::RESTART)},
                    {"CLEAR_AND_RESTART", announced(denoiser, nrd::AccumulationMode::CLEAR_AND_RESTART)},
                    {"a turn", turned(denoiser)},
                    {"a teleport", teleported(denoiser)},
                    {"another world", exchanged(denoiser)},
                    {"RESTART with broken input", broken(denoiser)}};
        for (const auto& cut : cuts)
        {
            if (!isSeen(denoiser, cut.name)) continue;
            INFO(nrd::toString(denoiser) << ", " << cut.name);
            const size_t leaks = countLeaks(runner, cut.setup);
            CHECK(leaks == 0);
            leaksOf[cut.name] += leaks;
        }
    }
    for (const auto& [cut, leaks] : leaksOf)
        std::printf("FIGURE cut by %s: %zu texels unlike a fresh instance's (bound 0)\n", cut.c_str(), leaks);
}

TEST_CASE("without detection a cut that nobody announced leaks", "[gpu]")
{
    Runner runner(nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR);
    Setup setup = exchanged(nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR);
    setup.changeCommon = [](nrd::CommonSettings& common, int) { common.enableCutDetection = false; };
    CHECK(countLeaks(runner, setup) > 0);
}

TEST_CASE("a pan and an ordinary camera are no cuts", "[gpu]")
{
    for (const nrd::Denoiser denoiser : testedDenoisers())
    {
        if (!tellsLength(denoiser)) continue;
        Runner runner(denoiser);
        for (const bool isPan : {true, false})
        {
            Setup setup = makeSetup(denoiser, kSize);
            setup.settings.returnHistoryLengthInsteadOfOcclusion = true;
            if (isPan) setup.camera = [](int frame) { return lookFrom({0.0f, 1.5f, -1.0f}, 1.5f * float(frame)); };
            runner.start(setup);
            Lengths worst;
            for (int frame = 0; frame < 8; frame++)
            {
                const Lengths lengths = measureLengths(runner.denoise(frame));
                if (frame >= 2 && lengths.share < worst.share) worst = lengths;
            }
            INFO(nrd::toString(denoiser) << (isPan ? ", pan" : ", moving camera"));
            std::printf("FIGURE %s, %s: history in %.3f of the pixels\n", nrd::toString(denoiser),
                        isPan ? "90 degrees a second" : "moving camera", worst.share);
            CHECK(worst.share > 0.5);
        }
    }
}
