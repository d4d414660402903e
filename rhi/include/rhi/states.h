// The state of a resource between two uses: which access, at which stages, in which layout. Barriers go from one to
// another, and the caller says both: the RHI tracks nothing (the validating decorator does, to check).
#pragma once
#include <cstdint>
#include <rhi/span.h>

namespace rhi
{
enum class Access : uint32_t
{
    None = 0,
    UniformRead = 1u << 0,
    SampledRead = 1u << 1,
    StorageRead = 1u << 2,
    StorageWrite = 1u << 3,
    IndirectRead = 1u << 4,
    TransferRead = 1u << 5,
    TransferWrite = 1u << 6,
    HostRead = 1u << 7,
    HostWrite = 1u << 8,
    MemoryRead = 1u << 9,   // any read
    MemoryWrite = 1u << 10, // any write
};
template <> struct IsFlags<Access> : std::true_type
{
};

enum class Stage : uint32_t
{
    None = 0,
    Compute = 1u << 0,
    Transfer = 1u << 1, // copies, clears and fills
    Indirect = 1u << 2, // reads the arguments of dispatchIndirect()
    Host = 1u << 3,
    AllCommands = 1u << 4,
};
template <> struct IsFlags<Stage> : std::true_type
{
};

enum class Layout : uint8_t
{
    Undefined, // as `before`: the contents may be lost
    General,
    ShaderReadOnly,
    TransferSrc,
    TransferDst,
    Native, // the state is in TextureState::native
};

/// A state that only the engine knows, in the API's own numbers (VkPipelineStageFlags2, VkAccessFlags2, VkImageLayout).
struct NativeState
{
    uint64_t stages = 0;
    uint64_t access = 0;
    uint32_t layout = 0;
};

struct TextureState
{
    Access access = Access::None;
    Layout layout = Layout::Undefined;
    Stage stages = Stage::None;
    NativeState native = {}; // read if layout is Native; access and stages are then ignored
};

struct BufferState
{
    Access access = Access::None;
    Stage stages = Stage::None;
};

/// A use of memory through whatever resources lie in it, also the engine's: TextureState less the layout.
struct MemoryState
{
    Access access = Access::None;
    Stage stages = Stage::None;
    bool isNative = false; // the state is in `native`; access and stages are then ignored
    NativeState native = {};
};
bool operator==(const MemoryState& a, const MemoryState& b);

bool operator==(const TextureState& a, const TextureState& b);
inline bool operator!=(const TextureState& a, const TextureState& b) { return !(a == b); }

/// The states in which compute passes leave and find their textures.
namespace states
{
inline constexpr TextureState kUndefined = {};
inline constexpr TextureState kSampled = {Access::SampledRead, Layout::ShaderReadOnly, Stage::Compute};
inline constexpr TextureState kSampledGeneral = {Access::SampledRead, Layout::General, Stage::Compute};
inline constexpr TextureState kStorageWrite = {Access::StorageWrite, Layout::General, Stage::Compute};
inline constexpr TextureState kStorageReadWrite = {Access::StorageRead | Access::StorageWrite, Layout::General,
                                                   Stage::Compute};
inline constexpr TextureState kTransferSrc = {Access::TransferRead, Layout::TransferSrc, Stage::Transfer};
inline constexpr TextureState kTransferDst = {Access::TransferWrite, Layout::TransferDst, Stage::Transfer};
/// As `before` of a placed texture: waits for whatever used the memory last, and drops what it held.
inline constexpr TextureState kAliased = {Access::MemoryRead | Access::MemoryWrite, Layout::Undefined,
                                          Stage::AllCommands};
} // namespace states
} // namespace rhi
