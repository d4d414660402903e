#include "expand.h"
#include "denoisers/families.h"
#include "resampling.h"
#include <algorithm>

namespace nrd
{
namespace
{
bool usesTexture(const BoundSlot& slot, size_t texture)
{
    return std::any_of(slot.choices.begin(), slot.choices.end(),
                       [texture](const BoundChoice& choice)
                       { return choice.binding.isTexture() && choice.binding.texture == texture; });
}

Format formatOf(const TextureFormat& format, const Variant& variant, size_t signal, NormalEncoding encoding)
{
    switch (format.rule)
    {
    case FormatRule::Fixed:
        return format.first;
    case FormatRule::PerLobes:
        return variant.lobes == kBoth ? format.second : format.first;
    case FormatRule::Luma:
        if (has(variant, kColor)) return variant.lobes == kBoth ? Format::RG16_SFLOAT : Format::R16_SFLOAT;
        return variant.lobes == kBoth ? Format::RG8_UNORM : Format::R8_UNORM;
    case FormatRule::PerSignal:
        return variant.signals[signal].format;
    case FormatRule::PerOutput:
        return outputFormat(variant);
    case FormatRule::PrevGuide:
        return variant.lobes == kDiffuse ? Format::RG8_UNORM : guideFormat(encoding);
    }
    return Format::MAX_NUM;
}

bool isInOutput(const TextureRow& row, const SignalRow& signal)
{
    return row.lifetime == Lifetime::Lent && signal.lendsOutput;
}

bool isPerSignal(FormatRule rule) { return rule == FormatRule::PerSignal || rule == FormatRule::PerOutput; }

void addTexture(Program& program, const TextureRow& row, NormalEncoding encoding)
{
    if (!has(*program.variant, row.having)) return;
    const size_t num = isPerSignal(row.format.rule) ? program.variant->signals.size() : 1;
    for (size_t signal = 0; signal < num; signal++)
    {
        if (isInOutput(row, program.variant->signals[signal])) continue;
        program.textures.push(
            {&row, static_cast<uint8_t>(signal), formatOf(row.format, *program.variant, signal, encoding)});
    }
}

uint8_t findTexture(const Program& program, uint8_t key, size_t signal)
{
    for (size_t i = 0; i < program.textures.size(); i++)
    {
        const Texture& texture = program.textures[i];
        if (texture.row->key == key && texture.signal == signal) return static_cast<uint8_t>(i);
    }
    return 0; // a table that names a texture its variant lacks is caught by the unit tests
}

// Where a signal's result goes: to the user, or first to what is upsampled.
Binding bindOutput(const Program& program, size_t signal)
{
    if (!program.isUpsampled()) return {program.variant->signals[signal].output, 0, false};
    return {ResourceType::MAX_NUM, findTexture(program, kSmallOutput.key, signal), false};
}

// Where a noisy signal comes from, likewise.
Binding bindInput(const Program& program, size_t signal)
{
    if (!program.isDownsampled()) return {program.variant->signals[signal].input, 0, false};
    return {ResourceType::MAX_NUM, findTexture(program, kSmallInput.key, signal), false};
}

// Tables name signals as such, or as the user's slots.
Binding bindUser(const Program& program, ResourceType type)
{
    const auto& signals = program.variant->signals;
    for (size_t i = 0; i < signals.size(); i++)
    {
        if (signals[i].input == type) return bindInput(program, i);
        if (signals[i].output == type) return bindOutput(program, i);
    }
    return {type, 0, false};
}

Binding bind(const Program& program, const Place& place, size_t signal)
{
    const SignalRow& row = program.variant->signals[signal];
    switch (place.source)
    {
    case Source::User:
        return bindUser(program, static_cast<ResourceType>(place.index));
    case Source::SignalInput:
        return bindInput(program, signal);
    case Source::SignalOutput:
        return bindOutput(program, signal);
    case Source::UserInput:
        return {row.input, 0, false};
    case Source::UserOutput:
        return {row.output, 0, false};
    case Source::Table:
        if (place.index < program.family->textures.size() && isInOutput(program.family->textures[place.index], row))
            return bindOutput(program, signal);
        break;
    }
    return {ResourceType::MAX_NUM, findTexture(program, place.index, place.isEach ? signal : 0), place.isPrevious};
}

template <size_t SlotNum, size_t BoundNum>
void addSlots(const Program& program, const FixedList<Slot, SlotNum>& slots, FixedList<BoundSlot, BoundNum>& bound)
{
    for (const Slot& slot : slots)
    {
        if (!has(*program.variant, slot.having)) continue;
        const size_t num = slot.choices[0].place.isEach ? program.variant->signals.size() : 1;
        for (size_t signal = 0; signal < num; signal++)
        {
            BoundSlot& result = (bound.push({}), bound[bound.size() - 1]);
            for (const Choice& choice : slot.choices)
                result.choices.push({bind(program, choice.place, signal), choice.isUsed});
        }
    }
}
} // namespace

Format guideFormat(NormalEncoding encoding)
{
    switch (encoding)
    {
    case NormalEncoding::RGBA8_UNORM:
        return Format::RGBA8_UNORM;
    case NormalEncoding::RGBA8_SNORM:
        return Format::RGBA8_SNORM;
    case NormalEncoding::R10_G10_B10_A2_UNORM:
        return Format::A2B10G10R10_UNORM_PACK32;
    case NormalEncoding::RGBA16_UNORM:
        return Format::RGBA16_UNORM;
    case NormalEncoding::RGBA16_SNORM:
        return Format::RGBA16_SNORM;
    case NormalEncoding::MAX_NUM:
        break;
    }
    return Format::MAX_NUM;
}

const char* nameOf(const Variant& variant)
{
    return variant.key == Denoiser::MAX_NUM ? "CONFIDENCE" : toString(variant.key);
}

VariantOfFamily findVariant(Denoiser denoiser, Keeps keeps)
{
    for (const Family* family : kFamilies)
    {
        for (size_t i = 0; i < family->variants.size(); i++)
        {
            if (family->variants[i].key == denoiser && family->variants[i].keeps == keeps) return {family, i};
        }
    }
    return {};
}

namespace
{
Shader shaderOf(const PassRow& row, const VariantOfFamily& which)
{
    size_t index = 0;
    for (size_t i = 0; i < which.variant; i++) index += has(which.family->variants[i], row.having) ? 1 : 0;
    return row.shaders[index];
}

void addPass(Program& program, const PassRow& row, Shader shader)
{
    Pass pass;
    pass.row = &row;
    pass.shader = shader;
    addSlots(program, row.reads, pass.reads);
    addSlots(program, row.writes, pass.writes);
    for (const SwitchRow& toggle : row.switches)
        if (has(*program.variant, toggle.having)) pass.switches.push(toggle);
    program.passes.push(pass);
}
} // namespace

Program expand(const VariantOfFamily& which, NormalEncoding encoding, FullSize fullSize)
{
    Program program;
    program.family = which.family;
    program.variant = &which.family->variants[which.variant];
    program.fullSize = fullSize;
    for (const TextureRow& row : which.family->textures) addTexture(program, row, encoding);
    if (program.isDownsampled()) addTexture(program, kSmallInput, encoding);
    if (program.isUpsampled()) addTexture(program, kSmallOutput, encoding);
    if (program.isDownsampled()) addPass(program, kDownsample, downsampler(*program.variant));
    for (const PassRow& row : which.family->passes)
        if (has(*program.variant, row.having)) addPass(program, row, shaderOf(row, which));
    if (program.isUpsampled()) addPass(program, kUpsample, upsampler(*program.variant));
    return program;
}

Life lifeOf(const Program& program, size_t texture)
{
    Life life;
    for (uint32_t i = 0; i < program.passes.size(); i++)
    {
        const Pass& pass = program.passes[i];
        bool isBound = false;
        for (const BoundSlot& slot : pass.reads) isBound = isBound || usesTexture(slot, texture);
        for (const BoundSlot& slot : pass.writes) isBound = isBound || usesTexture(slot, texture);
        if (!isBound) continue;
        if (!life.isBound) life.first = i;
        life.last = i;
        life.isBound = true;
    }
    return life;
}
} // namespace nrd
