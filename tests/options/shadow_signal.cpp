// SIGMA's samples: rays that pass, meet something opaque, or a pane of glass.
#include "signals.h"
#include <random>

namespace options
{
namespace
{
using Slot = nrd::ResourceType;

constexpr float kHalfWidth = 0.25f;       // of the penumbra, metres
constexpr float kLit = 65504.0f;          // the front end's flag
const glm::vec3 kGlass(0.8f, 0.4f, 0.1f); // of half of the occluders

float visibleFraction(const Setup& setup, const Frame& frame, glm::ivec2 pixel, int frameIndex)
{
    if (setup.meanAt) return glm::clamp(meanOf(setup, frame, pixel, frameIndex), 0.0f, 1.0f);
    const float u = (static_cast<float>(pixel.x) + 0.5f) / static_cast<float>(frame.rect.x);
    return glm::clamp(setup.mean * (1.5f - 2.0f * u), 0.0f, 1.0f);
}

glm::vec4 meanTranslucency(float visible) { return {visible, glm::vec3(visible) + 0.5f * (1.0f - visible) * kGlass}; }

// Half of its width, units.
float penumbraOf(const Setup& setup, const Frame& frame, glm::ivec2 pixel, int frameIndex)
{
    if (!setup.hitDistAt) return kHalfWidth * setup.unitsPerMeter;
    return setup.hitDistAt(worldPosition(frame, pixel.x, pixel.y), pixel, frameIndex) * setup.unitsPerMeter;
}

// Opposite rays meet what the others pass.
LightRay castRay(const Setup& setup, const Frame& frame, glm::ivec2 pixel, int frameIndex, std::mt19937& rng)
{
    const bool isOpposite = noiseOf(setup, frameIndex).isOpposite;
    const float visible = visibleFraction(setup, frame, pixel, frameIndex);
    const float random = static_cast<float>(rng() >> 8) * (1.0f / 16777216.0f);
    const bool isThroughGlass = ((rng() >> 31) != 0) != isOpposite;
    if ((isOpposite ? 1.0f - random : random) < visible) return {};
    return {penumbraOf(setup, frame, pixel, frameIndex), {0.0f, isThroughGlass ? kGlass : glm::vec3(0.0f)}};
}

// The same rays whichever slot is asked for.
std::vector<LightRay> castRays(const Setup& setup, const Frame& frame, int frameIndex)
{
    std::mt19937 rng(noiseOf(setup, frameIndex).seed);
    std::vector<LightRay> rays;
    for (int y = 0; y < frame.rect.y; y++)
        for (int x = 0; x < frame.rect.x; x++)
            rays.push_back(setup.rayAt ? setup.rayAt(worldPosition(frame, x, y), {x, y}, frameIndex)
                                       : castRay(setup, frame, {x, y}, frameIndex, rng));
    return rays;
}

// Outputs are square roots; the channels that SIGMA_SHADOW lacks are read as 0.
glm::vec4 asOutput(const Setup& setup, glm::vec4 v)
{
    const bool hasColor = setup.denoiser == nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY;
    return glm::sqrt(hasColor ? v : glm::vec4(v.x, 0.0f, 0.0f, 0.0f));
}
} // namespace

void addShadow(const Setup& setup, Frame& frame, Slot slot, int frameIndex)
{
    const bool isPenumbra = slot == Slot::IN_PENUMBRA;
    Plane samples, noisy, means;
    for (const LightRay& ray : castRays(setup, frame, frameIndex))
    {
        const glm::vec4 sample = isPenumbra ? glm::vec4(ray.penumbra, 0.0f, 0.0f, 0.0f) : ray.translucency;
        const int i = static_cast<int>(samples.size());
        const glm::ivec2 pixel(i % frame.rect.x, i / frame.rect.x);
        samples.push_back(asStored(frame.formats.at(slot), sample));
        noisy.push_back(asOutput(setup, ray.translucency));
        if (!setup.rayAt)
            means.push_back(asOutput(setup, meanTranslucency(visibleFraction(setup, frame, pixel, frameIndex))));
    }
    frame.inputs[slot] = packSamples(setup, frame, slot, frameIndex, false, samples);
    frame.noisy[Slot::OUT_SHADOW_TRANSLUCENCY] = noisy;
    frame.means[Slot::OUT_SHADOW_TRANSLUCENCY] = means;
}
} // namespace options
