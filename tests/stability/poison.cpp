#include "poison.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace stability
{
namespace
{
using Slot = nrd::ResourceType;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

constexpr Poison kPoisons[] = {
    {"NaN", kNan},         {"infinity", kInfinity},    {"-infinity", -kInfinity}, {"-1", -1.0f},
    {"-65504", -65504.0f}, {"a denormal half", 6e-8f}, {"a denormal", 1e-40f},    {"65504", 65504.0f},
};

bool isFinite(glm::vec4 v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

bool hasHitDist(Slot slot)
{
    return slot == Slot::IN_DIFF_RADIANCE_HITDIST || slot == Slot::IN_SPEC_RADIANCE_HITDIST ||
           slot == Slot::IN_DIFF_SH0 || slot == Slot::IN_SPEC_SH0 || slot == Slot::IN_DIFF_DIRECTION_HITDIST;
}

bool isSound(const options::Plane& plane) { return std::all_of(plane.begin(), plane.end(), isFinite); }
} // namespace

std::span<const Poison> poisons() { return kPoisons; }

std::string nameOf(const Target& target)
{
    return std::string(nrd::toString(target.slot)) + (target.isHitDistOnly ? ", hit distance" : "");
}

std::vector<Target> targetsOf(const options::Frame& frame)
{
    std::vector<Target> targets;
    for (const auto& [slot, plane] : frame.inputs)
    {
        targets.push_back({slot, false});
        if (hasHitDist(slot)) targets.push_back({slot, true});
    }
    return targets;
}

options::Setup makeOpenSetup(nrd::Denoiser denoiser, glm::ivec2 size)
{
    options::Setup setup = options::makeSetup(denoiser, size);
    setup.normalEncoding = nrd::NormalEncoding::RGBA16_SNORM; // of those that floats are allowed for
    setup.hasLargeFormats = true;
    setup.confidence = 1.0f;
    setup.thresholdMix = 0.0f;
    setup.reflectionMotionAt = [](glm::vec3, glm::ivec2, int) { return glm::vec3(0.0f); };
    return setup;
}

std::unique_ptr<options::Runner> makeOpenRunner(nrd::Denoiser denoiser)
{
    return std::make_unique<options::Runner>(denoiser, nrd::NormalEncoding::RGBA16_SNORM);
}

void poisonTexel(options::Frame& frame, const Target& target, glm::ivec2 pixel, float value)
{
    glm::vec4& texel = frame.inputs.at(target.slot)[frame.texel(pixel.x, pixel.y)];
    texel = target.isHitDistOnly ? glm::vec4(glm::vec3(texel), value) : glm::vec4(value);
}

std::string findUnsound(const options::Result& result, std::span<const options::Runner::History> histories)
{
    for (const auto& [slot, plane] : result.outputs)
        if (!isSound(plane)) return nrd::toString(slot);
    for (const options::Runner::History& history : histories)
        if (!isSound(history.texels)) return history.name;
    return "";
}
} // namespace stability
