// Views that few cameras have: along a surface, through a telescope or a fish's eye, at odd frame rates. Energy stays,
// and the picture is no worse than the mean of its frames would be.
#include "catch.h"
#include "figures.h"
#include "levels.h"
#include "runners.h"
#include "scenes.h"

using namespace stability;

namespace
{
constexpr int kFrames = 12;
constexpr double kEnergy = 2.0; // %, of a picture whose noise sums up to nothing
// % of the input's error: plain averaging of as many frames, without any filter.
const double kError = 100.0 / std::sqrt(double(kFrames));

struct View
{
    const char* name;
    void (*apply)(options::Setup& setup);
};

// A floor five metres away in the middle of the picture, whose angles are from half of that to one and a half.
template <int MilliDegrees> void graze(options::Setup& setup)
{
    constexpr float kDistance = 5.0f;
    const float angle = glm::radians(float(MilliDegrees) * 1e-3f);
    setup.fovY = angle;
    setup.camera = [angle](int) {
        return lookFrom({0.0f, kDistance * std::sin(angle), 0.0f}, {0.0f, -std::sin(angle), std::cos(angle)});
    };
    showBoards(setup, {Board{{0, 0, 0}, {0, 0, 900}, {900, 0, 0}}});
}

void moveOn(options::Setup& setup)
{
    if (setup.denoiser != nrd::Denoiser::REFERENCE) setup.speed = 0.01f; // another camera starts another mean there
}

// The edge of a shadow along the world's x = 0, as wide however it is seen.
void castShadow(options::Setup& setup)
{
    constexpr float kHalfWidth = 0.25f; // metres
    if (options::familyOf(setup.denoiser) != options::Family::Sigma) return;
    setup.hitDistAt = [](glm::vec3, glm::ivec2, int) { return kHalfWidth; };
    setup.meanAt = [](glm::vec3 p, glm::ivec2, int) { return glm::clamp(0.5f + 0.5f * p.x / kHalfWidth, 0.0f, 1.0f); };
}

template <int Degrees> void widen(options::Setup& setup)
{
    setup.fovY = glm::radians(float(Degrees));
    moveOn(setup);
}

template <int Milliseconds, int Odd = Milliseconds> void pace(options::Setup& setup)
{
    setup.changeCommon = [](nrd::CommonSettings& common, int frame)
    { common.timeDeltaBetweenFrames = float(frame % 2 == 0 ? Milliseconds : Odd); };
    moveOn(setup);
}

const View kViews[] = {
    {"floor at 45 degrees", graze<45000>},
    {"floor at 5 degrees", graze<5000>},
    {"floor at 1 degree", graze<1000>},
    {"floor at 0.2 degrees", graze<200>},
    {"field of view 1 degree", widen<1>},
    {"field of view 20 degrees", widen<20>},
    {"field of view 120 degrees", widen<120>},
    {"field of view 170 degrees", widen<170>},
    {"frames of 1 ms", pace<1>},
    {"frames of 500 ms", pace<500>},
    {"frames of 1 and 500 ms", pace<1, 500>},
};

Statistics measure(nrd::Denoiser denoiser, const View& view)
{
    options::Setup setup = makeSetup(denoiser);
    setup.isAntithetic = true;
    castShadow(setup);
    view.apply(setup);
    Statistician statistician;
    run(setup, kFrames,
        [&](int frame, const options::Result& result)
        {
            if (frame + 2 >= kFrames) statistician.add(levelsOf(result, denoiser)); // a frame and its opposite
        });
    return statistician.statistics();
}
} // namespace

TEST_CASE("whatever the view, energy stays and noise goes", "[gpu]")
{
    for (const View& view : kViews)
    {
        Figure energy(std::string(view.name) + ": error of the mean", "%", kEnergy);
        Figure error(std::string(view.name) + ": error", "% of the input's", kError);
        for (const nrd::Denoiser denoiser : someThat(isAny))
        {
            const Statistics s = measure(denoiser, view);
            CHECK(s.count > 1000);
            energy.add(denoiser, 100.0 * std::abs(s.denoised / s.truth - 1.0));
            error.add(denoiser, 100.0 * s.error / s.noisyError);
        }
    }
}
