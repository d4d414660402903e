// SIGMA's samples: rays that pass, meet something opaque, or a pane of glass.
#include "signals.h"
#include <cmath>
#include <random>

namespace options
{
namespace
{
using Slot = nrd::ResourceType;

constexpr float kHalfWidth = 0.25f;       // of the penumbra, metres
constexpr float kLit = 65504.0f;          // the front end's flag
const glm::vec3 kGlass(0.8f, 0.4f, 0.1f); // of half of the occluders

struct Ray
{
    bool isLit;
    bool isThroughGlass;
};

float visibleFraction(const Setup& setup, int x, int width)
{
    if (setup.meanAt) return setup.meanAt(x, width);
    const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
    return glm::clamp(setup.mean * (1.5f - 2.0f * u), 0.0f, 1.0f);
}

// As SIGMA_FrontEnd_PackTranslucency().
glm::vec4 translucency(Ray ray)
{
    if (ray.isLit) return glm::vec4(1.0f);
    return {0.0f, ray.isThroughGlass ? kGlass : glm::vec3(0.0f)};
}

glm::vec4 meanTranslucency(float visible) { return {visible, glm::vec3(visible) + 0.5f * (1.0f - visible) * kGlass}; }

// Of the same rays whichever slot is asked for.
std::vector<Ray> castRays(const Setup& setup, glm::ivec2 rect, int frameIndex)
{
    std::mt19937 rng(static_cast<unsigned>(frameIndex));
    std::vector<Ray> rays;
    for (int y = 0; y < rect.y; y++)
    {
        for (int x = 0; x < rect.x; x++)
        {
            const float random = static_cast<float>(rng() >> 8) * (1.0f / 16777216.0f);
            rays.push_back({random < visibleFraction(setup, x, rect.x), (rng() >> 31) != 0});
        }
    }
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
    const std::vector<Ray> rays = castRays(setup, frame.rect, frameIndex);
    Plane samples, noisy, means;
    for (size_t i = 0; i < rays.size(); i++)
    {
        const float penumbra = rays[i].isLit ? kLit : kHalfWidth * setup.unitsPerMeter;
        const glm::vec4 sample = isPenumbra ? glm::vec4(penumbra, 0.0f, 0.0f, 0.0f) : translucency(rays[i]);
        samples.push_back(asStored(frame.formats.at(slot), sample));
        noisy.push_back(asOutput(setup, translucency(rays[i])));
        const int x = static_cast<int>(i) % frame.rect.x;
        means.push_back(asOutput(setup, meanTranslucency(visibleFraction(setup, x, frame.rect.x))));
    }
    frame.inputs[slot] = packSamples(setup, frame, slot, frameIndex, false, samples);
    frame.noisy[Slot::OUT_SHADOW_TRANSLUCENCY] = noisy;
    frame.means[Slot::OUT_SHADOW_TRANSLUCENCY] = means;
}
} // namespace options
