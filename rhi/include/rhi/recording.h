// A back end without a GPU: every call is kept as plain data, and creations can be made to fail. For tests.
#pragma once
#include <memory>
#include <rhi/device.h>
#include <string>
#include <vector>

namespace rhi
{
enum class CallType : uint8_t
{
    CreateTexture,
    CreateMemory,
    CreatePlacedTexture,
    CreateView,
    CreateBuffer,
    CreatePipeline,
    CreateDescriptorPool,
    CreateQueryPool,
    CreateCommandBuffer,
    CreateFence,
    WrapTexture,
    WrapBuffer,
    WrapMemory,
    WrapCommandBuffer,
    Destroy,
    AllocateSet,
    WriteSet,
    ResetPool,
    Begin,
    End,
    BindPipeline,
    BindSet,
    Dispatch,
    DispatchIndirect,
    Barriers,
    MemoryBarrier,
    CopyBufferToTexture,
    CopyTextureToBuffer,
    CopyTexture,
    CopyBuffer,
    FillBuffer,
    ClearTexture,
    ResetQueries,
    WriteTimestamp,
    BeginLabel,
    EndLabel,
    Submit,
    WaitIdle,
};
const char* toString(CallType type);

struct RecordedBarrier
{
    std::string name; // of the texture or buffer
    bool isTexture = false;
    TextureState before; // buffers: layout Undefined
    TextureState after;
    MipRange mips;
};

struct RecordedBinding
{
    uint32_t binding = 0;
    std::string name; // of the view's texture or of the buffer
    MipRange mips;    // of the view
    Layout layout = Layout::Undefined;
    uint64_t offset = 0; // bytes, of the buffer
    uint64_t size = 0;   // bytes, of the buffer
};

/// One call. Which fields have a meaning depends on the type; the others keep their defaults.
struct RecordedCall
{
    CallType type = CallType::WaitIdle;
    std::string name;        // of the object the call creates, uses or changes; the text of a label
    std::string other;       // second object: destination of a copy, pipeline of a set, memory of a placed texture
    uint32_t index = 0;      // set of a binding, first query, mip of a copy
    uint32_t groups[3] = {}; // workgroups of a dispatch
    uint64_t offset = 0;     // bytes
    uint64_t size = 0;       // bytes; number of queries; number of command buffers
    uint64_t handle = 0;     // of a wrapped object
    TextureDesc texture;     // its names are not kept
    ClearColor clear;
    uint32_t value = 0; // fillBuffer
    std::vector<uint32_t> dynamicOffsets;
    std::vector<SpecConstant> constants;
    std::vector<RecordedBarrier> barriers;
    MemoryBarrier memory;
    std::vector<RecordedBinding> bindings;
};

/// Buffers of Upload and Readback memory are real memory; nothing is ever executed, queries read as ticks that grow by
/// one, fences signal on submission. What can be checked without state is checked as on a real device.
class RecordingDevice : public Device
{
public:
    virtual const std::vector<RecordedCall>& calls() const = 0;
    virtual void clearCalls() = 0;
    /// The n-th creation from now on (1 = the next; allocations of sets count) throws `code`; 0 = none. Fires once.
    virtual void failCreation(uint32_t n, ErrorCode code = ErrorCode::OutOfDeviceMemory) = 0;
    /// Objects alive, descriptor sets not counted: 0 when everything was given back.
    virtual uint32_t objectCount() const = 0;
};

struct RecordingDeviceDesc
{
    DeviceLimits limits = {16384, {65535, 65535, 65535}, 128, 64, 256, 64, 65536, 8, 64, 1.0};
    FormatSupport defaultFormatSupport = FormatSupport::Sampled | FormatSupport::SampledLinear |
                                         FormatSupport::Storage | FormatSupport::TransferSrc |
                                         FormatSupport::TransferDst;
    std::vector<Format> unsupportedFormats = {}; // have no support at all
};

std::unique_ptr<RecordingDevice> makeRecordingDevice(const RecordingDeviceDesc& desc = {});
} // namespace rhi
