#include "inputs.h"
#include "signals.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace options
{
namespace
{
using Slot = nrd::ResourceType;

rhi::Format toRhi(nrd::Format format)
{
    switch (format)
    {
    case nrd::Format::R8_UNORM:
        return rhi::Format::R8_UNORM;
    case nrd::Format::RGBA8_UNORM:
        return rhi::Format::RGBA8_UNORM;
    case nrd::Format::RGBA8_SNORM:
        return rhi::Format::RGBA8_SNORM;
    case nrd::Format::R16_SFLOAT:
        return rhi::Format::R16_SFLOAT;
    case nrd::Format::RG16_SFLOAT:
        return rhi::Format::RG16_SFLOAT;
    case nrd::Format::RGBA16_UNORM:
        return rhi::Format::RGBA16_UNORM;
    case nrd::Format::RGBA16_SNORM:
        return rhi::Format::RGBA16_SNORM;
    case nrd::Format::A2B10G10R10_UNORM_PACK32:
        return rhi::Format::A2B10G10R10_UNORM_PACK32;
    default:
        return rhi::Format::RGBA16_SFLOAT;
    }
}

rhi::Format larger(rhi::Format format)
{
    switch (format)
    {
    case rhi::Format::R8_UNORM:
        return rhi::Format::R16_SFLOAT;
    case rhi::Format::RGBA8_SNORM:
        return rhi::Format::RGBA16_SFLOAT;
    case rhi::Format::RG16_SFLOAT:
        return rhi::Format::RGBA16_SFLOAT;
    default:
        return rhi::Format::RGBA32_SFLOAT;
    }
}

float encodeRoughness(float roughness, nrd::RoughnessEncoding encoding)
{
    if (encoding == nrd::RoughnessEncoding::SQ_LINEAR) return roughness * roughness;
    return encoding == nrd::RoughnessEncoding::SQRT_LINEAR ? std::sqrt(roughness) : roughness;
}

// As NRD_FrontEnd_PackNormalAndRoughness.
glm::vec4 packGuide(glm::vec3 n, float roughness, float materialID, const Setup& setup)
{
    const float r = encodeRoughness(roughness, setup.roughnessEncoding);
    if (setup.normalEncoding == nrd::NormalEncoding::R10_G10_B10_A2_UNORM)
    {
        n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
        const float signedRoughness = std::max(r, 1.5f / 512.0f) * (n.z < 0.0f ? -1.0f : 1.0f);
        return {0.5f * glm::vec3(n.x + n.y, n.y - n.x, signedRoughness) + 0.5f, materialID / 3.0f};
    }
    const glm::vec3 b = n / std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    const bool isSigned = setup.normalEncoding == nrd::NormalEncoding::RGBA8_SNORM ||
                          setup.normalEncoding == nrd::NormalEncoding::RGBA16_SNORM;
    return {isSigned ? b : 0.5f * b + 0.5f, r};
}

glm::vec2 projectToUv(const quality::Camera& camera, glm::vec3 world)
{
    const glm::vec4 clip = camera.viewToClip * camera.worldToView * glm::vec4(world, 1.0f);
    return glm::vec2(0.5f, -0.5f) * glm::vec2(clip) / clip.w + 0.5f;
}

// Builds the guide images of one frame; positions are those of the rectangle's pixels.
struct GuideMaker
{
    const Setup& setup;
    Frame& frame;
    View now, before;
    int frameIndex;

    float storedViewZ(float z) const
    {
        return z * setup.unitsPerMeter * setup.viewZFactor * (setup.isRightHanded ? -1.0f : 1.0f);
    }

    glm::vec4 storedMotion(glm::vec3 v) const { return {v * setup.unitsPerMeter * setup.motionFactor, 0.0f}; }

    glm::vec4 reflectionMotion(int x, int y) const
    {
        const glm::vec3 v = setup.reflectionMotionAt(worldPosition(frame, x, y), {x, y}, frameIndex);
        return {glm::vec3(storedMotion(v)), 1.0f}; // 1 = every pixel has a sample
    }

    // In front of the jitter: a static scene under a static camera does not move.
    glm::vec4 motion(int x, int y) const
    {
        const glm::vec3 world = worldPosition(frame, x, y);
        const glm::vec3 own = setup.motionAt ? setup.motionAt(world, {x, y}, frameIndex) : glm::vec3(0.0f);
        if (setup.motion == MotionKind::World) return storedMotion(own - setup.sceneVelocity);
        const glm::vec2 delta = projectToUv(before.camera, world + own) - projectToUv(now.camera, world);
        const float z = frame.guides.viewZ[frame.pixel(x, y)];
        const float zBefore = (before.camera.worldToView * glm::vec4(world + own, 1.0f)).z;
        const glm::vec2 pixels = delta * glm::vec2(setup.rect);
        return {pixels * setup.motionFactor, (storedViewZ(zBefore) - storedViewZ(z)) * setup.motionFactor, 0.0f};
    }

    glm::vec4 guide(int x, int y) const
    {
        const size_t i = frame.pixel(x, y);
        const bool isRight = setup.hasMaterials && worldPosition(frame, x, y).x > 0.0f;
        return packGuide(frame.guides.normals[i], frame.guides.roughness[i], isRight ? 1.0f : 0.0f, setup);
    }

    glm::vec4 texel(Slot slot, int x, int y) const
    {
        const bool isSky = !frame.isInRange(x, y);
        if (slot == Slot::IN_VIEWZ) return glm::vec4(storedViewZ(frame.guides.viewZ[frame.pixel(x, y)]), 0, 0, 0);
        if (slot == Slot::IN_NORMAL_ROUGHNESS) return guide(x, y);
        if (isSky) return glm::vec4(0.0f);
        return slot == Slot::IN_SPEC_MV ? reflectionMotion(x, y) : motion(x, y);
    }
};

bool isGuide(Slot slot)
{
    return slot == Slot::IN_VIEWZ || slot == Slot::IN_NORMAL_ROUGHNESS || slot == Slot::IN_MV ||
           slot == Slot::IN_SPEC_MV;
}

void addGuide(const GuideMaker& maker, Slot slot)
{
    Frame& frame = maker.frame;
    const glm::ivec2 origin = maker.setup.origin / static_cast<int>(guideDivisor(maker.setup));
    Plane& plane = frame.inputs[slot];
    plane.assign(static_cast<size_t>(frame.size.x * frame.size.y), poisonOf(frame.formats[slot]));
    for (int y = 0; y < frame.rect.y; y++)
        for (int x = 0; x < frame.rect.x; x++) plane[frame.texel(origin.x + x, origin.y + y)] = maker.texel(slot, x, y);
}

std::optional<float> findConstant(const Setup& setup, Slot slot)
{
    if (slot == Slot::IN_DIFF_CONFIDENCE || slot == Slot::IN_SPEC_CONFIDENCE) return setup.confidence;
    if (slot == Slot::IN_DISOCCLUSION_THRESHOLD_MIX) return setup.thresholdMix;
    return {};
}
} // namespace

glm::ivec2 Frame::sizeOf(Slot slot) const
{
    return {divideUp(size.x, strides.at(slot)), divideUp(size.y, strides.at(slot))};
}

Plane picked(const Frame& frame, Slot slot)
{
    const Plane& all = frame.inputs.at(slot);
    const int stride = static_cast<int>(frame.strides.at(slot));
    const glm::ivec2 size = frame.sizeOf(slot);
    Plane plane;
    for (int y = 0; y < size.y; y++)
        for (int x = 0; x < size.x; x++) plane.push_back(all[frame.texel(x * stride, y * stride)]);
    return plane;
}

glm::vec3 worldPosition(const Frame& frame, int x, int y)
{
    const quality::Camera& camera = frame.guides.camera; // jittered, as it was traced
    const glm::mat4& clip = camera.viewToClip;
    const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(frame.rect);
    const float z = frame.guides.viewZ[frame.pixel(x, y)];
    const glm::vec2 ndc(2.0f * uv.x - 1.0f, 1.0f - 2.0f * uv.y);
    const bool isOrthographic = clip[3][3] == 1.0f;
    const float w = isOrthographic ? 1.0f : z;
    const int column = isOrthographic ? 3 : 2;
    const glm::vec2 shift(clip[column][0], clip[column][1]);
    const glm::vec2 scale(clip[0][0], clip[1][1]);
    const glm::vec2 xy = (ndc - shift) * w / scale;
    return glm::vec3(glm::inverse(camera.worldToView) * glm::vec4(xy, z, 1.0f));
}

bool isOutput(Slot slot) { return slot >= Slot::OUT_DIFF_RADIANCE_HITDIST; }

glm::vec4 poisonOf(rhi::Format format)
{
    const std::string name = rhi::formatInfo(format).name;
    return glm::vec4(name.find("FLOAT") != std::string::npos ? std::numeric_limits<float>::quiet_NaN() : 1.0f);
}

rhi::Format formatOf(const nrd::ResourceRequirement& need, const Setup& setup)
{
    if (need.type == Slot::IN_VIEWZ) return setup.hasHalfViewZ ? rhi::Format::R16_SFLOAT : rhi::Format::R32_SFLOAT;
    // One channel of 8 bits serves REFERENCE, but not the radiance it is given here.
    const bool isAnySignal = need.type == Slot::IN_SIGNAL || need.type == Slot::OUT_SIGNAL;
    const rhi::Format least = isAnySignal ? rhi::Format::RGBA16_SFLOAT : toRhi(need.minFormat);
    // Floats may hold what the other encodings pack into bits, but an application that has floats takes this one.
    const bool isPacked =
        need.type == Slot::IN_NORMAL_ROUGHNESS && setup.normalEncoding != nrd::NormalEncoding::RGBA16_SNORM;
    return setup.hasLargeFormats && !isPacked ? larger(least) : least;
}

Frame makeFrame(const Setup& setup, const std::vector<nrd::ResourceRequirement>& needs, int frameIndex)
{
    Frame frame;
    frame.size = {divideUp(setup.size.x, guideDivisor(setup)), divideUp(setup.size.y, guideDivisor(setup))};
    frame.rect = pixelsOf(setup, frameIndex);
    frame.hasSky = std::any_of(needs.begin(), needs.end(),
                               [](const nrd::ResourceRequirement& need) { return need.type == Slot::IN_VIEWZ; });
    frame.denoisingRange = setup.denoisingRange;
    const View view = makeView(setup, frameIndex);
    frame.guides = renderView(setup, view, frameIndex);
    const GuideMaker maker = {setup, frame, view, makeView(setup, std::max(frameIndex - 1, 0)), frameIndex};
    for (const nrd::ResourceRequirement& need : needs)
    {
        if (!need.isRequired) continue;
        frame.formats[need.type] = formatOf(need, setup);
        frame.strides[need.type] = need.sizeDivisor / guideDivisor(setup);
        const std::optional<float> constant = findConstant(setup, need.type);
        if (isGuide(need.type))
            addGuide(maker, need.type);
        else if (constant)
            frame.inputs[need.type].assign(static_cast<size_t>(frame.size.x * frame.size.y), glm::vec4(*constant));
        else if (need.type == Slot::IN_PENUMBRA || need.type == Slot::IN_TRANSLUCENCY)
            addShadow(setup, frame, need.type, frameIndex);
        else if (!isOutput(need.type))
            addSignal(setup, frame, need.type, frameIndex);
    }
    if (setup.changeInputs) setup.changeInputs(frame, frameIndex);
    return frame;
}
} // namespace options
