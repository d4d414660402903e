// The ends of what guides and hit distances can say, everywhere at once: energy is kept.
#include "catch.h"
#include "figures.h"
#include "levels.h"
#include "runners.h"
#include <algorithm>
#include <cmath>

using namespace stability;
using Slot = nrd::ResourceType;

namespace
{
constexpr int kFrames = 24;      // by then a fast history's seven frames weigh little
constexpr float kFar = 65504.0f; // the largest half float; of penumbrae the front end's flag for light

struct Extreme
{
    const char* name;
    void (*apply)(options::Setup& setup);
};

template <int Roughness> void setRoughness(options::Setup& setup)
{
    setup.scene = [](const quality::Camera& camera, glm::ivec2 size, int)
    {
        quality::Guides guides = quality::renderGuides(camera, size.x, size.y);
        std::fill(guides.roughness.begin(), guides.roughness.end(), float(Roughness));
        return guides;
    };
}

// Channel of the hit distance, -1 = none.
int hitDistChannel(Slot slot)
{
    switch (slot)
    {
    case Slot::IN_DIFF_HITDIST:
    case Slot::IN_SPEC_HITDIST:
    case Slot::IN_PENUMBRA:
        return 0;
    case Slot::IN_DIFF_RADIANCE_HITDIST:
    case Slot::IN_SPEC_RADIANCE_HITDIST:
    case Slot::IN_DIFF_DIRECTION_HITDIST:
    case Slot::IN_DIFF_SH0:
    case Slot::IN_SPEC_SH0:
        return 3;
    default:
        return -1;
    }
}

// Where hit distances, or what they say of light, are the output.
void setTruth(options::Frame& frame, float truth)
{
    for (auto& [slot, plane] : frame.means)
    {
        const bool isDirectional = slot == Slot::OUT_DIFF_DIRECTION_HITDIST;
        const bool isHitDist = slot == Slot::OUT_DIFF_HITDIST || slot == Slot::OUT_SPEC_HITDIST || isDirectional ||
                               slot == Slot::OUT_SHADOW_TRANSLUCENCY;
        if (!isHitDist) continue;
        for (glm::vec4& v : plane) v[isDirectional ? 3 : 0] = truth;
    }
}

template <int HitDist> void setHitDist(options::Setup& setup)
{
    setup.changeInputs = [](options::Frame& frame, int)
    {
        for (auto& [slot, plane] : frame.inputs)
        {
            const int channel = hitDistChannel(slot);
            if (channel >= 0)
                for (glm::vec4& v : plane) v[channel] = float(HitDist);
            if (slot == Slot::IN_TRANSLUCENCY) std::fill(plane.begin(), plane.end(), glm::vec4(HitDist > 0));
        }
        setTruth(frame, std::min(float(HitDist), 1.0f));
    };
}

const Extreme kExtremes[] = {
    {"roughness 0", setRoughness<0>},
    {"roughness 1", setRoughness<1>},
    {"hit distance 0 everywhere", setHitDist<0>},
    {"hit distance 65504 everywhere", setHitDist<int(kFar)>},
};

// Of the picture's mean, per cent of the light or, where there is none, of a mean of 1.
double energyError(nrd::Denoiser denoiser, const Extreme& extreme)
{
    options::Setup setup = makeSetup(denoiser);
    setup.isAntithetic = true; // after an even number of frames the noise's mean is the truth
    extreme.apply(setup);
    Statistician picture;
    picture.add(levelsOf(runToLast(setup, kFrames), denoiser));
    const Statistics s = picture.statistics();
    return 100.0 * std::abs(s.denoised - s.truth) / (s.truth > 0.0 ? s.truth : 1.0);
}
} // namespace

TEST_CASE("energy is kept at the ends of roughness and hit distance", "[gpu]")
{
    for (const Extreme& extreme : kExtremes)
    {
        // The picture's mean is known to 0.5 %: 3072 pixels of as much noise as light, through seven frames.
        Figure figure(std::string(extreme.name) + ": energy lost or gained", "%", 1.0);
        for (const nrd::Denoiser denoiser : denoisersThat(isLong() ? isAny : isWidest))
            figure.add(denoiser, energyError(denoiser, extreme));
    }
}
