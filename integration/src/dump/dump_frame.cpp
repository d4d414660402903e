#include "dump_frame.h"
#include "../doctor/camera.h"
#include "../doctor/decode.h"
#include "../refusal.h"
#include <algorithm>

namespace nrd::dump
{
namespace
{
using doctor::Vec3;

constexpr float kMiss = 65504.0f; // the format's distance of a ray that hit nothing, and SIGMA's flag of the same

// What the functions of the table below read and write.
struct Unpacking
{
    Unpacking(const FrameContext& f, const std::vector<SlotTexels>& s, std::vector<std::string>& n)
        : frame(f), slots(s), notes(n), width(f.common.rectSize[0]), height(f.common.rectSize[1]),
          now(f.common.viewToClipMatrix, f.common.worldToViewMatrix, {})
    {
    }

    const FrameContext& frame;
    const std::vector<SlotTexels>& slots;
    std::vector<std::string>& notes;
    uint32_t width, height;
    doctor::Camera now; // at the world's origin
    Channels channels;

    std::vector<float>& operator[](const std::string& name)
    {
        std::vector<float>& values = channels[name];
        values.resize(size_t{width} * height);
        return values;
    }
    bool isLarge(const SlotTexels& slot) const // as the rectangle, wherever it lies
    {
        const uint16_t* const origin = frame.common.rectOrigin;
        return slot.context.width >= width + origin[0] && slot.context.height >= height + origin[1];
    }
    /// Null: not handed in, or too small.
    const SlotTexels* find(ResourceType type) const
    {
        for (const SlotTexels& slot : slots)
            if (slot.context.type == type && isLarge(slot)) return &slot;
        return nullptr;
    }
    /// Of a pixel of the rectangle. Guides lie at rectOrigin.
    const float* texelAt(const SlotTexels& slot, bool isGuide, uint32_t x, uint32_t y) const
    {
        const uint16_t* const origin = frame.common.rectOrigin;
        const size_t column = x + (isGuide ? origin[0] : 0u), row = y + (isGuide ? origin[1] : 0u);
        return slot.texels + 4 * (row * slot.context.width + column);
    }
    /// Calls look(i, x, y, texel) for every pixel of the rectangle.
    template <class Look> void forPixels(const SlotTexels& slot, bool isGuide, Look&& look) const
    {
        for (uint32_t y = 0, i = 0; y < height; y++)
            for (uint32_t x = 0; x < width; x++, i++) look(i, x, y, texelAt(slot, isGuide, x, y));
    }
    /// Guides must be finite to be read back: others become `replacement`, and a note.
    void requireFinite(const char* channel, float replacement)
    {
        std::vector<float>& values = (*this)[channel];
        const auto isBad = [](float v) { return !std::isfinite(v); };
        const auto first = std::find_if(values.begin(), values.end(), isBad);
        if (first == values.end()) return;
        const size_t index = static_cast<size_t>(first - values.begin());
        notes.push_back(sentence("%s is not finite in %zu pixels, first (%zu; %zu); written as %g", channel,
                                 static_cast<size_t>(std::count_if(values.begin(), values.end(), isBad)), index % width,
                                 index / width, double(replacement)));
        std::replace_if(values.begin(), values.end(), isBad, replacement);
    }
};

bool isReblur(Denoiser denoiser) { return denoiser <= Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION; }

struct Row
{
    ResourceType type;
    const char* layer;
    void (*unpack)(Unpacking& u, const SlotTexels& slot, const std::string& layer);
};

void unpackViewZ(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    const CommonSettings& common = u.frame.common;
    std::vector<float>& viewZ = u[layer];
    const float sign = static_cast<float>(u.now.zSign());
    u.forPixels(slot, true,
                [&](size_t i, uint32_t, uint32_t, const float* texel)
                { viewZ[i] = sign * std::abs(texel[0] * common.viewZScale); });
    u.requireFinite("viewZ", sign * 2.0f * common.denoisingRange);
}

void unpackGuides(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    std::vector<float>&x = u[layer + ".X"], &y = u[layer + ".Y"], &z = u[layer + ".Z"];
    std::vector<float>&roughness = u["roughness"], &material = u["materialID"];
    const bool hasMaterial = u.frame.normalEncoding == NormalEncoding::R10_G10_B10_A2_UNORM;
    u.forPixels(slot, true,
                [&](size_t i, uint32_t, uint32_t, const float* texel)
                {
                    const Vec3 normal = normalize(doctor::decodeNormal(texel, u.frame.normalEncoding));
                    x[i] = static_cast<float>(normal.x);
                    y[i] = static_cast<float>(normal.y);
                    z[i] = static_cast<float>(normal.z);
                    roughness[i] = static_cast<float>(
                        doctor::decodeRoughness(texel, u.frame.normalEncoding, u.frame.roughnessEncoding));
                    material[i] = hasMaterial ? std::round(texel[3] * 3.0f) : 0.0f;
                });
    for (const char* const channel : {"normal.X", "normal.Y", "normal.Z", "roughness"}) u.requireFinite(channel, 0.0f);
}

// A vector on the screen, with or without a change of depth, as one of the world.
struct ScreenMotion
{
    explicit ScreenMotion(const Unpacking& unpacking) : u(unpacking), common(u.frame.common)
    {
        Vec3 delta =
            doctor::cameraPosition(common.worldToViewMatrixPrev) - doctor::cameraPosition(common.worldToViewMatrix);
        if (common.isCameraDeltaAvailable)
            delta = {common.cameraDelta[0], common.cameraDelta[1], common.cameraDelta[2]};
        before = doctor::Camera(common.viewToClipMatrixPrev, common.worldToViewMatrixPrev, delta);
    }
    /// `storedZ` as in IN_VIEWZ, whose sign the difference of depths has.
    Vec3 toWorld(uint32_t x, uint32_t y, double storedZ, const float* mv) const
    {
        const double viewZ = storedZ * double(common.viewZScale), z = std::abs(viewZ);
        const double scaleZ = double(common.motionVectorScale[2]) * double(common.viewZScale);
        const double left = (x + 0.5) / u.width, top = (y + 0.5) / u.height;
        const Vec3 position = u.now.unproject(left, top, z);
        const double zBefore = scaleZ != 0.0 ? std::abs(viewZ + double(mv[2]) * scaleZ) : before.project(position).z;
        return before.unproject(left + double(mv[0]) * double(common.motionVectorScale[0]),
                                top + double(mv[1]) * double(common.motionVectorScale[1]), zBefore) -
               position;
    }
    const Unpacking& u;
    const CommonSettings& common;
    doctor::Camera before; // in the world of the camera now
};

Vec3 worldMotion(const CommonSettings& common, const float* mv)
{
    const float* const scale = common.motionVectorScale; // as the settings say, z = 0 is taken as x
    return Vec3{double(mv[0] * scale[0]), double(mv[1] * scale[1]),
                double(mv[2] * (scale[2] != 0.0f ? scale[2] : scale[0]))};
}

void unpackMotion(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    std::vector<float>&mx = u[layer + ".X"], &my = u[layer + ".Y"], &mz = u[layer + ".Z"];
    const std::vector<float>& viewZ = u["viewZ"];
    const SlotTexels* const depth = u.find(ResourceType::IN_VIEWZ);
    const ScreenMotion screen(u);
    const CommonSettings& common = u.frame.common;
    if (!depth) return; // nothing can be said of motion then
    u.forPixels(slot, true,
                [&](size_t i, uint32_t x, uint32_t y, const float* texel)
                {
                    if (std::abs(viewZ[i]) > common.denoisingRange) return; // sky: no denoiser looks
                    const Vec3 motion = common.isMotionVectorInWorldSpace
                                            ? worldMotion(common, texel)
                                            : screen.toWorld(x, y, double(*u.texelAt(*depth, true, x, y)), texel);
                    mx[i] = static_cast<float>(motion.x);
                    my[i] = static_cast<float>(motion.y);
                    mz[i] = static_cast<float>(motion.z);
                });
    for (const char* const axis : {".X", ".Y", ".Z"}) u.requireFinite((layer + axis).c_str(), 0.0f);
}

// Components of the texels as they are, from `first` on.
void copyComponents(Unpacking& u, const SlotTexels& slot, const std::string& layer, size_t first,
                    std::initializer_list<const char*> suffixes)
{
    for (const char* const suffix : suffixes)
    {
        std::vector<float>& values = u[layer + suffix];
        u.forPixels(slot, false, [&](size_t i, uint32_t, uint32_t, const float* texel) { values[i] = texel[first]; });
        first++;
    }
}

void unpackSpecularMotion(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    copyComponents(u, slot, layer, 0, {".MX", ".MY", ".MZ"});
}

// From the fraction that REBLUR keeps, or from RELAX's units.
float hitDistance(Unpacking& u, const SlotTexels& slot, size_t i, float stored, bool isSpecular)
{
    if (!isReblur(slot.context.denoiser)) return stored;
    if (stored >= 1.0f) return kMiss;
    HitDistanceParameters parameters = slot.context.hitDistanceParameters;
    parameters.A *= u.frame.common.metersToUnits;
    const double roughness = isSpecular ? double(u["roughness"][i]) : 1.0;
    return static_cast<float>(double(stored) *
                              doctor::hitDistanceRange(std::abs(double(u["viewZ"][i])), parameters, roughness));
}

void unpackHitDistance(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    std::vector<float>& distance = u[layer + ".hitDist"];
    const bool isSpecular = layer == "specular";
    u.forPixels(slot, false,
                [&](size_t i, uint32_t, uint32_t, const float* texel)
                { distance[i] = hitDistance(u, slot, i, texel[0], isSpecular); });
}

// Radiance and hit distance; both families' first SH texture has the same.
void unpackRadiance(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    std::vector<float>&r = u[layer + ".R"], &g = u[layer + ".G"], &b = u[layer + ".B"];
    std::vector<float>& distance = u[layer + ".hitDist"];
    const bool isSpecular = layer == "specular", isYCoCg = isReblur(slot.context.denoiser);
    u.forPixels(slot, false,
                [&](size_t i, uint32_t, uint32_t, const float* texel)
                {
                    const float t = texel[0] - texel[2];
                    r[i] = isYCoCg ? t + texel[1] : texel[0];
                    g[i] = isYCoCg ? texel[0] + texel[2] : texel[1];
                    b[i] = isYCoCg ? t - texel[1] : texel[2];
                    distance[i] = hitDistance(u, slot, i, texel[3], isSpecular);
                });
}

// A direction that was stored times what `scaleOf` gives for the pixel.
template <class Scale>
void unpackDirection(Unpacking& u, const SlotTexels& slot, const std::string& layer, Scale&& scaleOf)
{
    std::vector<float>&x = u[layer + ".DX"], &y = u[layer + ".DY"], &z = u[layer + ".DZ"];
    u.forPixels(slot, false,
                [&](size_t i, uint32_t, uint32_t, const float* texel)
                {
                    const float scale = scaleOf(i, texel);
                    const float inverse = scale > 0.0f ? 1.0f / scale : 0.0f;
                    x[i] = texel[0] * inverse;
                    y[i] = texel[1] * inverse;
                    z[i] = texel[2] * inverse;
                });
}

void unpackSh1(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    const std::vector<float>&r = u[layer + ".R"], &g = u[layer + ".G"], &b = u[layer + ".B"];
    unpackDirection(u, slot, layer,
                    [&](size_t i, const float*)
                    {
                        const float rgb[3] = {r[i], g[i], b[i]};
                        return static_cast<float>(doctor::lumaOfRgb(rgb));
                    });
}

void unpackDirectionalOcclusion(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    unpackDirection(u, slot, layer, [](size_t, const float* texel) { return texel[3]; });
    std::vector<float>& distance = u[layer + ".hitDist"];
    u.forPixels(slot, false,
                [&](size_t i, uint32_t, uint32_t, const float* texel)
                { distance[i] = hitDistance(u, slot, i, texel[3], false); });
}

// capture.json says of the light that its tangent is 1, so that the half-width is the distance.
void unpackPenumbra(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    std::vector<float>&distance = u[layer + ".dist"], &r = u[layer + ".R"], &g = u[layer + ".G"], &b = u[layer + ".B"];
    u.forPixels(slot, false,
                [&](size_t i, uint32_t, uint32_t, const float* texel)
                {
                    distance[i] = texel[0];
                    r[i] = g[i] = b[i] = texel[0] >= kMiss ? 1.0f : 0.0f;
                });
}

void unpackTranslucency(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    copyComponents(u, slot, layer, 1, {".R", ".G", ".B"});
}

void unpackSignal(Unpacking& u, const SlotTexels& slot, const std::string& layer)
{
    copyComponents(u, slot, layer, 0, {".R", ".G", ".B", ".hitDist"});
}

// In an order in which each finds what it needs of the others.
constexpr Row kRows[] = {
    {ResourceType::IN_VIEWZ, "viewZ", unpackViewZ},
    {ResourceType::IN_NORMAL_ROUGHNESS, "normal", unpackGuides},
    {ResourceType::IN_MV, "motion", unpackMotion},
    {ResourceType::IN_SPEC_MV, "specular", unpackSpecularMotion},
    {ResourceType::IN_DIFF_HITDIST, "diffuse", unpackHitDistance},
    {ResourceType::IN_SPEC_HITDIST, "specular", unpackHitDistance},
    {ResourceType::IN_DIFF_DIRECTION_HITDIST, "diffuse", unpackDirectionalOcclusion},
    {ResourceType::IN_DIFF_RADIANCE_HITDIST, "diffuse", unpackRadiance},
    {ResourceType::IN_SPEC_RADIANCE_HITDIST, "specular", unpackRadiance},
    {ResourceType::IN_DIFF_SH0, "diffuse", unpackRadiance},
    {ResourceType::IN_SPEC_SH0, "specular", unpackRadiance},
    {ResourceType::IN_DIFF_SH1, "diffuse", unpackSh1},
    {ResourceType::IN_SPEC_SH1, "specular", unpackSh1},
    {ResourceType::IN_PENUMBRA, "shadow", unpackPenumbra},
    {ResourceType::IN_TRANSLUCENCY, "shadow", unpackTranslucency},
    {ResourceType::IN_SIGNAL, "diffuse", unpackSignal},
};

// Channels of a layer come together; what no denoiser was handed is 0.
constexpr const char* kLayers[][8] = {
    {"diffuse", ".R", ".G", ".B", ".hitDist", ".DX", ".DY", ".DZ"},
    {"specular", ".R", ".G", ".B", ".hitDist", ".DX", ".DY", ".DZ"},
    {"shadow", ".dist", ".R", ".G", ".B"},
};

void completeLayers(Unpacking& u)
{
    for (const auto& layer : kLayers)
    {
        const std::string prefix = std::string(layer[0]) + ".";
        const auto found = u.channels.lower_bound(prefix);
        if (found == u.channels.end() || found->first.compare(0, prefix.size(), prefix) != 0) continue;
        for (size_t i = 1; i < std::size(layer) && layer[i]; i++) (void)u[std::string(layer[0]) + layer[i]];
    }
    if (u.channels.count("viewZ")) return;
    u.notes.push_back("no denoiser was handed IN_VIEWZ; written as 1");
    for (float& viewZ : u["viewZ"]) viewZ = static_cast<float>(u.now.zSign());
}
} // namespace

bool isRecorded(ResourceType type)
{
    return std::any_of(std::begin(kRows), std::end(kRows), [&](const Row& row) { return row.type == type; });
}

Channels unpackFrame(const FrameContext& frame, const std::vector<SlotTexels>& slots, std::vector<std::string>& notes)
{
    Unpacking u(frame, slots, notes);
    for (const SlotTexels& slot : slots)
        if (!u.isLarge(slot))
            notes.push_back(sentence("%s is left out: %u x %u texels are less than the rectangle",
                                     toString(slot.context.type), slot.context.width, slot.context.height));
    for (const Row& row : kRows)
        if (const SlotTexels* const slot = u.find(row.type)) row.unpack(u, *slot, row.layer);
    completeLayers(u);
    return std::move(u.channels);
}
} // namespace nrd::dump
