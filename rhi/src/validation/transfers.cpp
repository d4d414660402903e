// Barriers, copies, clears and fills of the validating command buffer.
#include "../checks.h"
#include "commands.h"
#include <algorithm>

namespace rhi::validation
{
namespace
{
struct NeedRow
{
    Access access;
    TextureUsage usage;
    const char* name;
};
constexpr NeedRow kNeeds[] = {
    {Access::SampledRead, TextureUsage::Sampled, "sampled"},
    {Access::StorageRead, TextureUsage::Storage, "storage"},
    {Access::StorageWrite, TextureUsage::Storage, "storage"},
    {Access::TransferRead, TextureUsage::TransferSrc, "transfer source"},
    {Access::TransferWrite, TextureUsage::TransferDst, "transfer destination"},
};

bool hasRange(MipRange mips, uint32_t mipCount)
{
    return mips.count > 0 && mips.first < mipCount && mips.count <= mipCount - mips.first;
}

unsigned long long number(uint64_t value) { return value; }
} // namespace

bool ValidCommandBuffer::checkBarrier(const TextureBarrier& barrier, size_t index, Span<const TextureBarrier> all) const
{
    const std::shared_ptr<TextureFacts> texture = find(barrier.texture);
    if (!texture) return false;
    const MipRange mips = resolveMips(barrier.mips, texture->desc.mipCount);
    if (!hasRange(mips, texture->desc.mipCount))
        return fail(sentence("mips [%u; %u + %u) of %s do not exist, it has %u", mips.first, mips.first, mips.count,
                             texture->text().c_str(), texture->desc.mipCount));
    if (barrier.after.layout == Layout::Undefined)
        return fail(texture->text() + " is to go to layout Undefined, which can only be a before");
    if (barrier.after.layout != Layout::Native)
        for (const NeedRow& need : kNeeds)
            if (hasAny(barrier.after.access, need.access) && !hasAny(texture->desc.usage, need.usage))
                return fail(texture->text() + " is to be used as " + need.name + " but was created without that usage");
    for (size_t i = 0; i < index; i++)
    {
        const MipRange other = resolveMips(all[i].mips, texture->desc.mipCount);
        if (all[i].texture == barrier.texture && other.first < mips.first + mips.count &&
            mips.first < other.first + other.count)
            return fail(texture->text() + " is in the batch twice");
    }
    for (uint32_t mip = mips.first; mip < mips.first + mips.count; mip++)
    {
        const std::string error = texture->mips.at(mip).findError(barrier.before, now());
        if (!error.empty())
            return fail("the barrier of " + texture->text() + " mip " + std::to_string(mip) + " " + error);
    }
    return checkAliases(barrier, *texture);
}

// A texture that takes its turn in shared memory has to wait for whoever had it before.
bool ValidCommandBuffer::checkAliases(const TextureBarrier& barrier, const TextureFacts& facts) const
{
    if (barrier.before.layout != Layout::Undefined) return true;
    for (const TextureFacts* other : facts.aliases())
        for (const MipTracker& mip : other->mips)
        {
            const Stage used = mip.usedStages(now());
            if (hasAny(barrier.before.stages, Stage::AllCommands) || hasAll(barrier.before.stages, used)) continue;
            return fail("the barrier of " + facts.text() + " does not wait for " + other->text() +
                        ", which shares its memory and was used at " + describe(used));
        }
    return true;
}

bool ValidCommandBuffer::checkBarrier(const BufferBarrier& barrier) const
{
    const std::shared_ptr<BufferFacts> buffer = find(barrier.buffer);
    if (!buffer) return false;
    const std::string error = buffer->tracker.findError(barrier.before, now());
    return error.empty() || fail("the barrier of " + buffer->text() + " " + error);
}

void ValidCommandBuffer::applyBarrier(const TextureBarrier& barrier)
{
    const std::shared_ptr<TextureFacts>& texture = static_cast<const ValidTexture*>(barrier.texture)->facts();
    const MipRange mips = resolveMips(barrier.mips, texture->desc.mipCount);
    if (barrier.before.layout == Layout::Undefined)
        for (TextureFacts* other : texture->aliases())
            for (MipTracker& mip : other->mips) mip.discard();
    for (uint32_t mip = mips.first; mip < mips.first + mips.count; mip++) texture->mips.at(mip).apply(barrier.after);
    touch(texture);
}

void ValidCommandBuffer::barriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers)
{
    if (!isReady("barriers")) return;
    for (size_t i = 0; i < textures.size(); i++)
        if (!checkBarrier(textures[i], i, textures)) return;
    for (const BufferBarrier& barrier : buffers)
        if (!checkBarrier(barrier)) return;

    std::vector<TextureBarrier> innerTextures(textures.begin(), textures.end());
    std::vector<BufferBarrier> innerBuffers(buffers.begin(), buffers.end());
    for (TextureBarrier& barrier : innerTextures)
    {
        applyBarrier(barrier);
        barrier.texture = &static_cast<const ValidTexture*>(barrier.texture)->inner();
    }
    for (BufferBarrier& barrier : innerBuffers)
    {
        const auto* valid = static_cast<const ValidBuffer*>(barrier.buffer);
        valid->facts()->tracker.apply(barrier.after);
        touch(valid->facts());
        barrier.buffer = &valid->inner();
    }
    m_inner->barriers(innerTextures, innerBuffers);
}

// What it orders is not tracked: only an engine's resources can need it, of which nothing is known here.
void ValidCommandBuffer::barrier(const MemoryBarrier& memory)
{
    if (isReady("barrier")) m_inner->barrier(memory);
}

bool ValidCommandBuffer::checkRange(const BufferFacts& buffer, uint64_t offset, uint64_t size, BufferUsage usage) const
{
    static constexpr std::pair<BufferUsage, const char*> kNames[] = {
        {BufferUsage::Indirect, "indirect"},
        {BufferUsage::TransferSrc, "transfer source"},
        {BufferUsage::TransferDst, "transfer destination"}};
    for (const auto& [bit, usageName] : kNames)
        if (bit == usage && !hasAny(buffer.desc.usage, usage))
            return fail(buffer.text() + " was created without " + usageName + " usage");
    if (size == 0) return fail("0 bytes of " + buffer.text());
    if (offset > buffer.desc.size || size > buffer.desc.size - offset)
        return fail(sentence("bytes [%llu; %llu + %llu) of %s do not exist, it has %llu", number(offset),
                             number(offset), number(size), buffer.text().c_str(), number(buffer.desc.size)));
    return true;
}

bool ValidCommandBuffer::checkCopy(const TextureCopy& copy, TextureUsage textureUsage, BufferUsage bufferUsage)
{
    const std::shared_ptr<TextureFacts> texture = find(copy.texture);
    const std::shared_ptr<BufferFacts> buffer = texture ? find(copy.buffer) : nullptr;
    if (!buffer) return false;
    if (!hasAny(texture->desc.usage, textureUsage))
        return fail(texture->text() + " was created without transfer " +
                    (textureUsage == TextureUsage::TransferSrc ? "source" : "destination") + " usage");
    if (copy.mip >= texture->desc.mipCount)
        return fail(sentence("%s has no mip %u", texture->text().c_str(), copy.mip));
    const uint32_t texelSize = formatInfo(texture->desc.format).texelSize;
    if (copy.bufferOffset % 4 != 0 || copy.bufferOffset % texelSize != 0)
        return fail(sentence("offset %llu into %s is not a multiple of 4 and of the texel size %u",
                             number(copy.bufferOffset), buffer->text().c_str(), texelSize));
    const uint64_t size = copy.texture->mipByteSize(copy.mip);
    if (!checkRange(*buffer, copy.bufferOffset, size, bufferUsage)) return false;
    const bool isSrc = bufferUsage == BufferUsage::TransferSrc;
    const Use use = {isSrc ? Access::TransferRead : Access::TransferWrite, Stage::Transfer, Layout::General, !isSrc};
    return useBuffer(buffer, {copy.bufferOffset, copy.bufferOffset + size}, use, "");
}

void ValidCommandBuffer::copyBufferToTexture(const TextureCopy& copy, Layout layout)
{
    if (!isReady("copyBufferToTexture")) return;
    if (!checkCopy(copy, TextureUsage::TransferDst, BufferUsage::TransferSrc)) return;
    const auto* texture = static_cast<const ValidTexture*>(copy.texture);
    const Use use = {Access::TransferWrite, Stage::Transfer, layout, true};
    if (!useTexture(texture->facts(), {copy.mip, 1}, use, "")) return;
    commitUses();
    const auto* buffer = static_cast<const ValidBuffer*>(copy.buffer);
    m_inner->copyBufferToTexture({&texture->inner(), copy.mip, &buffer->inner(), copy.bufferOffset}, layout);
}

void ValidCommandBuffer::copyTextureToBuffer(const TextureCopy& copy, Layout layout)
{
    if (!isReady("copyTextureToBuffer")) return;
    if (!checkCopy(copy, TextureUsage::TransferSrc, BufferUsage::TransferDst)) return;
    const auto* texture = static_cast<const ValidTexture*>(copy.texture);
    const Use use = {Access::TransferRead, Stage::Transfer, layout, false};
    if (!useTexture(texture->facts(), {copy.mip, 1}, use, "")) return;
    commitUses();
    const auto* buffer = static_cast<const ValidBuffer*>(copy.buffer);
    m_inner->copyTextureToBuffer({&texture->inner(), copy.mip, &buffer->inner(), copy.bufferOffset}, layout);
}

void ValidCommandBuffer::copyTexture(const Texture& src, const Texture& dst)
{
    if (!isReady("copyTexture")) return;
    const std::shared_ptr<TextureFacts> from = find(&src);
    const std::shared_ptr<TextureFacts> to = from ? find(&dst) : nullptr;
    if (!to) return;
    if (from == to) return static_cast<void>(fail(from->text() + " is both source and destination"));
    if (!hasAny(from->desc.usage, TextureUsage::TransferSrc))
        return static_cast<void>(fail(from->text() + " was created without transfer source usage"));
    if (!hasAny(to->desc.usage, TextureUsage::TransferDst))
        return static_cast<void>(fail(to->text() + " was created without transfer destination usage"));
    if (from->desc.width != to->desc.width || from->desc.height != to->desc.height ||
        formatInfo(from->desc.format).texelSize != formatInfo(to->desc.format).texelSize)
        return static_cast<void>(fail(from->text() + " and " + to->text() + " differ in size or texel size"));
    if (!useTexture(from, {0, 1}, {Access::TransferRead, Stage::Transfer, Layout::TransferSrc, false}, "")) return;
    if (!useTexture(to, {0, 1}, {Access::TransferWrite, Stage::Transfer, Layout::TransferDst, true}, "")) return;
    commitUses();
    m_inner->copyTexture(static_cast<const ValidTexture&>(src).inner(), static_cast<const ValidTexture&>(dst).inner());
}

void ValidCommandBuffer::copyBuffer(const BufferCopy& copy)
{
    if (!isReady("copyBuffer")) return;
    const std::shared_ptr<BufferFacts> src = find(copy.src);
    const std::shared_ptr<BufferFacts> dst = src ? find(copy.dst) : nullptr;
    if (!dst || !checkRange(*src, copy.srcOffset, copy.size, BufferUsage::TransferSrc) ||
        !checkRange(*dst, copy.dstOffset, copy.size, BufferUsage::TransferDst))
        return;
    const ByteRange from = {copy.srcOffset, copy.srcOffset + copy.size};
    const ByteRange to = {copy.dstOffset, copy.dstOffset + copy.size};
    if (src == dst && from.begin < to.end && to.begin < from.end)
        return static_cast<void>(fail("the ranges of " + src->text() + " overlap"));
    if (!useBuffer(src, from, {Access::TransferRead, Stage::Transfer, Layout::General, false}, "")) return;
    if (!useBuffer(dst, to, {Access::TransferWrite, Stage::Transfer, Layout::General, true}, "")) return;
    commitUses();
    m_inner->copyBuffer({&static_cast<const ValidBuffer*>(copy.src)->inner(), copy.srcOffset,
                         &static_cast<const ValidBuffer*>(copy.dst)->inner(), copy.dstOffset, copy.size});
}

void ValidCommandBuffer::fillBuffer(const Buffer& buffer, uint64_t offset, uint64_t size, uint32_t value)
{
    if (!isReady("fillBuffer")) return;
    const std::shared_ptr<BufferFacts> facts = find(&buffer);
    if (!facts || !checkRange(*facts, offset, size, BufferUsage::TransferDst)) return;
    if (offset % 4 != 0 || size % 4 != 0)
        return static_cast<void>(fail(sentence("offset %llu and size %llu of %s are not multiples of 4", number(offset),
                                               number(size), facts->text().c_str())));
    const Use use = {Access::TransferWrite, Stage::Transfer, Layout::General, true};
    if (!useBuffer(facts, {offset, offset + size}, use, "")) return;
    commitUses();
    m_inner->fillBuffer(static_cast<const ValidBuffer&>(buffer).inner(), offset, size, value);
}

void ValidCommandBuffer::clearTexture(const Texture& texture, MipRange mips, const ClearColor& color, Layout layout)
{
    if (!isReady("clearTexture")) return;
    const std::shared_ptr<TextureFacts> facts = find(&texture);
    if (!facts) return;
    const MipRange range = resolveMips(mips, facts->desc.mipCount);
    if (!hasRange(range, facts->desc.mipCount))
        return static_cast<void>(fail(sentence("mips [%u; %u + %u) of %s do not exist, it has %u", range.first,
                                               range.first, range.count, facts->text().c_str(), facts->desc.mipCount)));
    if (!hasAny(facts->desc.usage, TextureUsage::TransferDst))
        return static_cast<void>(fail(facts->text() + " was created without transfer destination usage"));
    const FormatClass formatClass = formatInfo(facts->desc.format).formatClass;
    if (formatClass == FormatClass::Depth) return static_cast<void>(fail(facts->text() + " is a depth texture"));
    if (color.isUint != (formatClass != FormatClass::Float))
        return static_cast<void>(fail(facts->text() + " has format " + formatInfo(facts->desc.format).name +
                                      ", which the clear colour does not fit"));
    if (!useTexture(facts, range, {Access::TransferWrite, Stage::Transfer, layout, true}, "")) return;
    commitUses();
    m_inner->clearTexture(static_cast<const ValidTexture&>(texture).inner(), range, color, layout);
}
} // namespace rhi::validation
