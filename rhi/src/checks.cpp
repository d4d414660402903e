#include "checks.h"
#include "spirv.h"
#include <algorithm>
#include <array>
#include <bit>
#include <cstdarg>
#include <cstdio>

namespace rhi
{
const char* safeName(const char* name) { return name ? name : ""; }

std::string sentence(const char* format, ...)
{
    std::array<char, 1024> text = {}; // longer sentences are cut: nobody reads them
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text.data(), text.size(), format, arguments);
    va_end(arguments);
    return text.data();
}

void throwInvalid(const std::string& text) { throw Error(ErrorCode::InvalidArgument, text); }

MipRange resolveMips(MipRange mips, uint32_t mipCount)
{
    if (mips.count == kAllMips && mips.first < mipCount) mips.count = mipCount - mips.first;
    return mips;
}

namespace
{
void checkFormatSupport(const TextureDesc& desc, FormatSupport support)
{
    struct Row
    {
        TextureUsage usage;
        FormatSupport support;
        const char* text;
    };
    static constexpr Row kRows[] = {
        {TextureUsage::Sampled, FormatSupport::Sampled, "sampled"},
        {TextureUsage::Storage, FormatSupport::Storage, "storage"},
        {TextureUsage::TransferSrc, FormatSupport::TransferSrc, "transfer source"},
        {TextureUsage::TransferDst, FormatSupport::TransferDst, "transfer destination"},
    };
    for (const Row& row : kRows)
    {
        if (hasAny(desc.usage, row.usage) && !hasAny(support, row.support))
            throw Error(ErrorCode::Unsupported, sentence("texture '%s': the device has no %s access to format %s",
                                                         safeName(desc.name), row.text, formatInfo(desc.format).name));
    }
}
} // namespace

void checkTexture(const TextureDesc& desc, const DeviceLimits& limits, FormatSupport support)
{
    const char* name = safeName(desc.name);
    if (formatInfo(desc.format).texelSize == 0) throwInvalid(sentence("texture '%s': format is Unknown", name));
    if (desc.width == 0 || desc.width > limits.maxTextureSize || desc.height == 0 ||
        desc.height > limits.maxTextureSize)
        throwInvalid(sentence("texture '%s': size is %u x %u, expected [1; %u] in both dimensions", name, desc.width,
                              desc.height, limits.maxTextureSize));
    const uint32_t maxMips = static_cast<uint32_t>(std::bit_width(std::max(desc.width, desc.height)));
    if (desc.mipCount == 0 || desc.mipCount > maxMips)
        throwInvalid(sentence("texture '%s': mipCount is %u, expected [1; %u] for %u x %u", name, desc.mipCount,
                              maxMips, desc.width, desc.height));
    if (desc.usage == TextureUsage::None) throwInvalid(sentence("texture '%s': usage is None", name));
    checkFormatSupport(desc, support);
}

TextureViewDesc checkView(const TextureDesc& texture, const TextureViewDesc& view)
{
    const bool isStorage = view.type == ViewType::Storage;
    const char* typeName = isStorage ? "storage" : "sampled";
    if (!hasAny(texture.usage, isStorage ? TextureUsage::Storage : TextureUsage::Sampled))
        throwInvalid(sentence("%s view of texture '%s': the texture was created without %s usage", typeName,
                              texture.name, typeName));
    const MipRange mips = resolveMips(view.mips, texture.mipCount);
    if (mips.count == 0 || mips.first >= texture.mipCount || mips.count > texture.mipCount - mips.first)
        throwInvalid(sentence("%s view of texture '%s': mips [%u; %u + %u) do not exist, the texture has %u", typeName,
                              texture.name, mips.first, mips.first, mips.count, texture.mipCount));
    if (isStorage && mips.count != 1)
        throwInvalid(
            sentence("storage view of texture '%s': it has %u mips, expected exactly 1", texture.name, mips.count));
    return {view.type, mips};
}

void checkBuffer(const BufferDesc& desc)
{
    if (desc.size == 0) throwInvalid(sentence("buffer '%s': size is 0", safeName(desc.name)));
    if (desc.usage == BufferUsage::None) throwInvalid(sentence("buffer '%s': usage is None", safeName(desc.name)));
}

void checkMemory(const MemoryDesc& desc)
{
    if (desc.size == 0) throwInvalid(sentence("memory '%s': size is 0", safeName(desc.name)));
    if (desc.memoryTypeBits == 0)
        throwInvalid(sentence("memory '%s': memoryTypeBits is 0, the textures have no memory type in common",
                              safeName(desc.name)));
}

void checkWrappedMemory(uint64_t handle, const MemoryDesc& desc)
{
    if (handle == 0) throwInvalid(sentence("memory '%s': the memory to wrap is null", safeName(desc.name)));
    checkMemory(desc);
    if ((desc.memoryTypeBits & (desc.memoryTypeBits - 1)) != 0)
        throwInvalid(sentence("memory '%s': memoryTypeBits is 0x%x, must be the one bit of its type",
                              safeName(desc.name), desc.memoryTypeBits));
}

void checkPlacement(const TextureDesc& desc, const MemoryRequirements& needs, const Memory& memory, uint64_t offset)
{
    const char* name = safeName(desc.name);
    if (offset % needs.alignment != 0)
        throwInvalid(sentence("texture '%s': offset %llu in memory '%s' is not a multiple of %llu", name,
                              static_cast<unsigned long long>(offset), memory.name(),
                              static_cast<unsigned long long>(needs.alignment)));
    if (offset > memory.size() || needs.size > memory.size() - offset)
        throwInvalid(sentence("texture '%s': %llu bytes at offset %llu do not fit memory '%s' of %llu bytes", name,
                              static_cast<unsigned long long>(needs.size), static_cast<unsigned long long>(offset),
                              memory.name(), static_cast<unsigned long long>(memory.size())));
}

namespace
{
void checkBindings(const PipelineDesc& desc, const DeviceLimits& limits)
{
    const char* name = safeName(desc.name);
    uint32_t sampledCount = 0;
    uint32_t storageCount = 0;
    std::array<uint32_t, kMaxSets> dynamicCounts = {};
    for (size_t i = 0; i < desc.bindings.size(); i++)
    {
        const BindingDesc& a = desc.bindings[i];
        if (a.set >= kMaxSets) throwInvalid(sentence("pipeline '%s': set %u, expected [0; %u)", name, a.set, kMaxSets));
        for (size_t j = 0; j < i; j++)
            if (desc.bindings[j].set == a.set && desc.bindings[j].binding == a.binding)
                throwInvalid(sentence("pipeline '%s': set %u binding %u is listed twice", name, a.set, a.binding));
        sampledCount += a.type == BindingType::SampledTexture;
        storageCount += a.type == BindingType::StorageTexture;
        if (a.type == BindingType::UniformBufferDynamic && ++dynamicCounts[a.set] > kMaxDynamicOffsets)
            throwInvalid(sentence("pipeline '%s': set %u has more than %u dynamic uniform buffers", name, a.set,
                                  kMaxDynamicOffsets));
    }
    if (sampledCount > limits.maxSampledTextures || storageCount > limits.maxStorageTextures)
        throw Error(ErrorCode::Unsupported,
                    sentence("pipeline '%s': %u sampled and %u storage textures, the device has room for %u and %u",
                             name, sampledCount, storageCount, limits.maxSampledTextures, limits.maxStorageTextures));
}
} // namespace

void checkPipeline(const PipelineDesc& desc, const DeviceLimits& limits)
{
    const char* name = safeName(desc.name);
    const SpirvInfo spirv = inspectSpirv(desc.spirv);
    if (spirv.error) throw Error(ErrorCode::InvalidShader, sentence("pipeline '%s': %s", name, spirv.error));
    checkBindings(desc, limits);
    for (const SpirvBinding& used : spirv.bindings)
    {
        const auto isSame = [&](const BindingDesc& b) { return b.set == used.set && b.binding == used.binding; };
        if (std::none_of(desc.bindings.begin(), desc.bindings.end(), isSame))
            throwInvalid(sentence("pipeline '%s': the shader declares set %u binding %u, which the bindings lack", name,
                                  used.set, used.binding));
    }
    for (size_t i = 0; i < desc.constants.size(); i++)
        for (size_t j = 0; j < i; j++)
            if (desc.constants[i].id == desc.constants[j].id)
                throwInvalid(
                    sentence("pipeline '%s': specialisation constant %u is listed twice", name, desc.constants[i].id));
}

void checkDescriptorPool(const DescriptorPoolDesc& desc)
{
    if (desc.sets == 0) throwInvalid(sentence("descriptor pool '%s': sets is 0", safeName(desc.name)));
}

void checkQueryPool(const QueryPoolDesc& desc, const DeviceLimits& limits)
{
    if (desc.count == 0) throwInvalid(sentence("query pool '%s': count is 0", safeName(desc.name)));
    if (limits.timestampValidBits == 0)
        throw Error(ErrorCode::Unsupported,
                    sentence("query pool '%s': the device has no timestamps on this queue", safeName(desc.name)));
}
} // namespace rhi
