// Compute pipelines, and the descriptor sets they read. Pipelines whose bindings of a set are equal share that set's
// layout, so that one set serves them all.
#pragma once
#include <cstdint>
#include <rhi/resources.h>
#include <rhi/span.h>
#include <rhi/states.h>

namespace rhi
{
inline constexpr uint32_t kMaxSets = 4;
inline constexpr uint32_t kMaxDynamicOffsets = 8; // per set

enum class BindingType : uint8_t
{
    UniformBufferDynamic, // its offset is given when the set is bound
    Sampler,              // immutable, never written
    SampledTexture,
    StorageTexture,
    StorageBuffer,
};

/// Filter and addressing in both directions; mips are chosen with the same filter.
enum class SamplerKind : uint8_t
{
    NearestClamp,
    LinearClamp,
    NearestMirroredRepeat,
    LinearMirroredRepeat,
};

struct BindingDesc
{
    uint32_t set = 0; // [0; kMaxSets)
    uint32_t binding = 0;
    BindingType type = BindingType::SampledTexture;
    SamplerKind sampler = SamplerKind::NearestClamp; // read if type is Sampler
};

/// A 32-bit specialisation constant: bool as 0 or 1, int and float as their bits.
struct SpecConstant
{
    uint32_t id = 0;
    uint32_t value = 0;
};

struct PipelineDesc
{
    Span<const uint32_t> spirv;         // the words of a module with the compute entry point "main"
    Span<const BindingDesc> bindings;   // every binding the shader declares, each (set, binding) once
    Span<const SpecConstant> constants; // each id once; ids the module lacks are ignored
    const char* name = "pipeline";
};

class Pipeline : public Object
{
protected:
    using Object::Object;
};

/// Room of a pool. Immutable samplers take room as well.
struct DescriptorPoolDesc
{
    uint32_t sets = 0; // > 0
    uint32_t uniformBuffersDynamic = 0;
    uint32_t samplers = 0;
    uint32_t sampledTextures = 0;
    uint32_t storageTextures = 0;
    uint32_t storageBuffers = 0;
    const char* name = "descriptor pool";
};

/// What a binding points at: a view for textures, a buffer with offset and size for buffers.
struct DescriptorWrite
{
    uint32_t binding = 0;
    const TextureView* view = nullptr;
    /// Sampled textures: the layout they are in when the set is used, ShaderReadOnly or General. Storage: General.
    Layout layout = Layout::ShaderReadOnly;
    const Buffer* buffer = nullptr;
    uint64_t offset = 0; // bytes; a dynamic offset is added to it
    uint64_t size = 0;   // bytes the shader sees, > 0
};

/// Owned by its pool; gone when the pool is reset or destroyed.
class DescriptorSet : public Object
{
public:
    /// Fills every binding but the samplers, in any order. Once per allocation, and before the set is bound.
    virtual void write(Span<const DescriptorWrite> writes) = 0;

protected:
    using Object::Object;
};

class DescriptorPool : public Object
{
public:
    /// A set for set `set` of `pipeline` and of all pipelines with the same bindings in it. Allocates no host memory
    /// after the pool was filled once. Throws PoolExhausted, which leaves the pool as it was.
    virtual DescriptorSet& allocate(const Pipeline& pipeline, uint32_t set) = 0;
    /// Takes all sets back; none may be in use by the GPU.
    virtual void reset() = 0;

protected:
    using Object::Object;
};
} // namespace rhi
