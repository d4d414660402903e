// Textures, views, buffers and memory. Each object is owned by the std::unique_ptr its factory returned, and must be
// destroyed before its device, a view before its texture, a placed texture before its memory; none while the GPU uses
// it.
#pragma once
#include <cstdint>
#include <rhi/format.h>
#include <string>

namespace rhi
{
enum class TextureUsage : uint32_t
{
    None = 0,
    Sampled = 1u << 0,
    Storage = 1u << 1,
    TransferSrc = 1u << 2,
    TransferDst = 1u << 3, // also what clearTexture() needs
};
template <> struct IsFlags<TextureUsage> : std::true_type
{
};

inline constexpr uint32_t kAllMips = ~0u;

/// A 2D texture of one layer. Names and tags are copied.
struct TextureDesc
{
    Format format = Format::Unknown;
    uint32_t width = 1;    // [1; limits().maxTextureSize] texels
    uint32_t height = 1;   // [1; limits().maxTextureSize] texels
    uint32_t mipCount = 1; // [1; 1 + floor(log2(max(width, height)))]
    TextureUsage usage = TextureUsage::None;
    const char* name = "texture";
    const char* memoryTag = "textures"; // the line of the memory report; not read for placed and wrapped textures
};

/// Consecutive mips; kAllMips counts to the last one.
struct MipRange
{
    uint32_t first = 0;
    uint32_t count = kAllMips;
};

/// What every object has in common: a name for messages and debuggers, and the native object underneath.
class Object
{
public:
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    virtual ~Object() = default;

    const char* name() const { return m_name.c_str(); }
    /// The native handle (VkImage, VkBuffer, ...); 0 where the back end has none.
    virtual uint64_t nativeHandle() const = 0;

protected:
    explicit Object(const char* name) : m_name(name ? name : "") {}

private:
    std::string m_name;
};

class Texture : public Object
{
public:
    const TextureDesc& desc() const { return m_desc; }
    uint32_t mipWidth(uint32_t mip) const { return mip < 32 && m_desc.width >> mip ? m_desc.width >> mip : 1; }
    uint32_t mipHeight(uint32_t mip) const { return mip < 32 && m_desc.height >> mip ? m_desc.height >> mip : 1; }
    /// Bytes of a mip, rows tightly packed: what the copies from and to buffers expect.
    uint64_t mipByteSize(uint32_t mip) const
    {
        return uint64_t(mipWidth(mip)) * mipHeight(mip) * formatInfo(m_desc.format).texelSize;
    }

protected:
    explicit Texture(const TextureDesc& desc) : Object(desc.name), m_desc(desc)
    {
        m_desc.name = name();
        m_desc.memoryTag = ""; // may not outlive the call; the device's report keeps it
    }

private:
    TextureDesc m_desc;
};

enum class ViewType : uint8_t
{
    Sampled,
    Storage, // exactly one mip
};

struct TextureViewDesc
{
    ViewType type = ViewType::Sampled;
    MipRange mips = {};
};

class TextureView : public Object
{
public:
    const TextureViewDesc& desc() const { return m_desc; } // the count of mips is resolved, never kAllMips

protected:
    TextureView(const char* name, const TextureViewDesc& desc) : Object(name), m_desc(desc) {}

private:
    TextureViewDesc m_desc;
};

enum class BufferUsage : uint32_t
{
    None = 0,
    Uniform = 1u << 0,
    Storage = 1u << 1,
    Indirect = 1u << 2,
    TransferSrc = 1u << 3,
    TransferDst = 1u << 4,
};
template <> struct IsFlags<BufferUsage> : std::true_type
{
};

enum class BufferMemory : uint8_t
{
    Device,
    Upload,   // mapped, coherent: the host writes, the GPU reads
    Readback, // mapped, coherent, cached where there is such memory: the GPU writes, the host reads
};

struct BufferDesc
{
    uint64_t size = 0; // bytes, > 0
    BufferUsage usage = BufferUsage::None;
    BufferMemory memory = BufferMemory::Device;
    const char* name = "buffer";
    const char* memoryTag = "buffers"; // the line of the memory report
};

class Buffer : public Object
{
public:
    const BufferDesc& desc() const { return m_desc; }
    /// The bytes of an Upload or Readback buffer for as long as it lives; null for Device and wrapped buffers.
    virtual void* mapped() const = 0;

protected:
    explicit Buffer(const BufferDesc& desc) : Object(desc.name), m_desc(desc)
    {
        m_desc.name = name();
        m_desc.memoryTag = "";
    }

private:
    BufferDesc m_desc;
};

struct MemoryRequirements
{
    uint64_t size = 0;           // bytes
    uint64_t alignment = 1;      // bytes, a power of two
    uint32_t memoryTypeBits = 0; // one memory serves several textures if the bits they have in common are not 0
};

struct MemoryDesc
{
    uint64_t size = 0;             // bytes, > 0
    uint32_t memoryTypeBits = ~0u; // intersection of the textures' requirements
    const char* name = "memory";
    const char* memoryTag = "memory"; // the line of the memory report
};

/// A block of device memory in which textures are placed; textures that share bytes share lives in turn, and each
/// begins its turn with a barrier from states::kAliased.
class Memory : public Object
{
public:
    uint64_t size() const { return m_size; }
    /// One bit: the type it was allocated from.
    virtual uint32_t memoryTypeBits() const = 0;

protected:
    explicit Memory(const MemoryDesc& desc) : Object(desc.name), m_size(desc.size) {}

private:
    uint64_t m_size;
};
} // namespace rhi
