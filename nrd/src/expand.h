// Table x variant -> concrete textures and passes. Pure.
#pragma once
#include "pass_table.h"
#include <nrd/descs.h>

namespace nrd
{
struct Texture
{
    const TextureRow* row = nullptr;
    uint8_t signal = 0; // index in Variant::signals, for textures that exist once per signal
    Format format = Format::MAX_NUM;

    bool isTransient() const { return row->lifetime == Lifetime::Transient || row->lifetime == Lifetime::Lent; }
};

// A user slot, or a texture of Program::textures.
struct Binding
{
    ResourceType type = ResourceType::MAX_NUM; // MAX_NUM = texture
    uint8_t texture = 0;
    bool isPrevious = false;

    bool isTexture() const { return type == ResourceType::MAX_NUM; }
    bool operator==(const Binding&) const = default;
};

struct BoundChoice
{
    Binding binding;
    Predicate isUsed = nullptr; // null = always
};

struct BoundSlot
{
    const Binding& pick(const Conditions& conditions) const
    {
        size_t i = 0;
        while (choices[i].isUsed && !choices[i].isUsed(conditions)) i++;
        return choices[i].binding;
    }

    FixedList<BoundChoice, 3> choices; // the last one is always used
};

struct Pass
{
    const PassRow* row = nullptr;
    Shader shader = Shader::Count;
    FixedList<BoundSlot, 32> reads;
    FixedList<BoundSlot, 20> writes;
    FixedList<SwitchRow, 5> switches;
};

struct Program
{
    const Family* family = nullptr;
    const Variant* variant = nullptr;
    FullSize fullSize = FullSize::NOTHING;
    FixedList<Texture, 32> textures;
    FixedList<Pass, 20> passes;

    bool isUpsampled() const { return fullSize != FullSize::NOTHING; }
    bool isDownsampled() const { return fullSize == FullSize::EVERYTHING; }
};

struct VariantOfFamily
{
    const Family* family = nullptr; // null = the denoiser is not offered
    size_t variant = 0;
};

VariantOfFamily findVariant(Denoiser denoiser, Keeps keeps = Keeps::History);
inline FullSize fullSizeOf(const DenoiserDesc& desc)
{
    return desc.resolutionDivisor > 1 ? desc.fullSize : FullSize::NOTHING;
}
const char* nameOf(const Variant& variant); // of the denoiser, or of what is none
inline Keeps keptBy(const DenoiserDesc& desc) { return desc.hasHistory ? Keeps::History : Keeps::Nothing; }
Program expand(const VariantOfFamily& which, NormalEncoding encoding, FullSize fullSize = FullSize::NOTHING);
Format guideFormat(NormalEncoding encoding);

// First and last pass in which the texture is bound, whatever the settings.
struct Life
{
    uint32_t first = 0;
    uint32_t last = 0;
    bool isBound = false;
};
Life lifeOf(const Program& program, size_t texture);
} // namespace nrd
