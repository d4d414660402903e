// NrdIntegration: the denoisers on native Vulkan handles. It owns pools, pipelines, descriptors, constants and
// barriers; the application hands in its device once, and every frame a command buffer and the images of its user pool.
//
// Threads: one at a time per object; objects are independent, also over one device.
// Frames: NewFrame() first, and not before the GPU has finished the frame `framesInFlight` frames ago. What Denoise()
// records must be submitted, once and in the order of recording, since images carry their state from call to call.
// Errors: nothing throws, nothing asserts. A refused call changes nothing and records nothing; GetLastMessage() has one
// sentence that names the slot or the field, and InstanceCreationDesc::messageSink gets the same.
// After Denoise() the command buffer has another compute pipeline and other compute descriptor sets bound (sets 0 and
// 1); graphics and ray-tracing state and push constants of other layouts are as before.
#pragma once
#include <cstdint>
#include <memory>
#include <nrd/doctor.h>
#include <nrd/nrd.h>
#include <vulkan/vulkan_core.h>

namespace nrd
{
/// What the application's device must have been created with. Can be asked before there is a device.
struct RequiredDeviceFeatures
{
    uint32_t apiVersion = 0;                // of instance and device, at least
    VkPhysicalDeviceFeatures features = {}; // the fields that are VK_TRUE must be enabled
    const char* const* deviceExtensions = nullptr;
    uint32_t deviceExtensionsNum = 0;
};
NRD_API RequiredDeviceFeatures GetRequiredDeviceFeatures();

/// Native objects of the application: borrowed, they must outlive the integration.
struct NativeDevice
{
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    uint32_t queueFamilyIndex = 0; // of the command buffers handed to Denoise(); must have compute
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr; // required: the loader is not linked
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr;     // null: taken from getInstanceProcAddr

    const VkPhysicalDeviceFeatures* enabledFeatures = nullptr; // null: taken as everything that is required
    bool isSynchronization2Enabled = false; // the feature, through Vulkan 1.3 or VK_KHR_synchronization2
    bool isDebugUtilsEnabled = false;       // VK_EXT_debug_utils on the instance: passes are labelled, objects named
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;             // may be null
    const VkAllocationCallbacks* allocationCallbacks = nullptr; // may be null
};

enum class LayoutPolicy : uint8_t
{
    OPTIMAL, // SHADER_READ_ONLY_OPTIMAL while a pass only reads an image, GENERAL otherwise
    GENERAL, // GENERAL everywhere: the application never has to transition
    MAX_NUM
};

/// A part of a block of device memory.
struct NrdMemory
{
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;      // bytes
    VkDeviceSize size = 0;        // bytes from there on
    uint32_t memoryTypeIndex = 0; // that it was allocated from
};

/// How memory is used through whatever lies in it: what a memory barrier names on that side. By default in any way.
struct NrdMemoryUse
{
    VkAccessFlags access = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    VkPipelineStageFlags stages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT; // 0: not at all
};

/// The application's allocator of device memory for the texture pools; both functions or none. Called within Create()
/// and Resize(), and where the GPU is done with a pool: within NewFrame(), SetCommonSettings() and Destroy().
struct DeviceMemoryCallbacks
{
    /// Fills in a block that serves `needs`, or returns false: the call that needed it is refused with FAILURE. `name`
    /// is "NRD permanent" or "NRD transient" and not kept.
    bool (*allocate)(void* userArg, const VkMemoryRequirements& needs, const char* name, NrdMemory& memory) = nullptr;
    /// Takes back what allocate() gave.
    void (*free)(void* userArg, const NrdMemory& memory) = nullptr;
    void* userArg = nullptr;
};

/// Device memory of the two texture pools. A size of 0: the pool is empty. No memory type: each texture is allocated
/// by itself, and the pool cannot be lent.
struct PoolMemoryRequirements
{
    VkMemoryRequirements permanent = {}; // history
    VkMemoryRequirements transient = {}; // scratch
};

struct IntegrationCreationDesc
{
    const char* name = "NRD"; // prefix of debug names: pool textures are "NRD P(0)", "NRD T(0)"; copied
    NativeDevice native = {};
    uint16_t resourceWidth = 0;           // [1; 65535] pixels, size of all full-resolution images
    uint16_t resourceHeight = 0;          // [1; 65535] pixels
    uint32_t framesInFlight = 3;          // [1; 16] frames that the GPU may still work on when the next one begins
    uint32_t maxDenoiseCallsPerFrame = 4; // [1; 1024] calls that surely fit; more may if they name few denoisers
    LayoutPolicy layoutPolicy = LayoutPolicy::OPTIMAL;
    bool isGpuTimingEnabled = false;     // fills GetTimings()
    bool createDefaultPipelines = false; // those of the default settings in Create(), not at their first use
    bool isPassTracingEnabled = false;   // fills GetLastPass(); passes no longer overlap, so for finding faults only
    /// The application uses the memory of the transient pool between the calls: its own, or that of
    /// GetTransientMemory(). What either side leaves there is lost, see DenoiseOptions.
    bool isTransientMemoryShared = false;
    /// The transient pool's memory, lent by the application: what GetMemoryRequirements() asks for, in any number of
    /// integrations at once. It outlives the integration, and is taken as shared. Null: allocated.
    NrdMemory transientMemory = {};
    /// Where the pools' other memory comes from; null: vkAllocateMemory(). Buffers (constants, copies for the host) are
    /// small and the integration's own.
    DeviceMemoryCallbacks deviceMemory = {};
    /// For the development of shaders: a module in place of the library's for the permutation of that name (see
    /// PipelineDesc::shaderIdentifier), or none (null words). Asked whenever a pipeline is made, in Create() and
    /// Denoise(); the module is read before the next call, and has the same interface.
    SPIRV (*findShader)(void* userArg, const char* shaderIdentifier) = nullptr;
    void* findShaderArg = nullptr;
};

/// How an image was left, or must be found, between two uses: what an image barrier names on that side. States of
/// synchronisation 2 that have no bit here are given by their wider form, as SHADER_READ for SHADER_SAMPLED_READ.
struct NrdImageState
{
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED; // UNDEFINED: the contents may be lost
    VkAccessFlags access = 0;
    VkPipelineStageFlags stages = 0; // 0: nothing to wait for
};
inline bool operator==(const NrdImageState& a, const NrdImageState& b)
{
    return a.layout == b.layout && a.access == b.access && a.stages == b.stages;
}
inline bool operator!=(const NrdImageState& a, const NrdImageState& b) { return !(a == b); }

/// A 2D image of one layer and one mip, owned by `native.queueFamilyIndex` or shared with it.
struct NrdUserImage
{
    VkImage image = VK_NULL_HANDLE; // null: the slot is empty
    VkFormat format = VK_FORMAT_UNDEFINED;
    uint32_t width = 0;          // pixels; the resource size, but for confidences, the threshold mix, IN_STORED_...
    uint32_t height = 0;         // pixels
    VkImageUsageFlags usage = 0; // as created, 0 = unknown: taken as SAMPLED and STORAGE
    uint64_t generation = 0;     // another number for each image that may get the handle of a destroyed one
    NrdImageState state = {};    // in: how the application left it; out: how Denoise() left it
};

/// One entry per slot of the user pool. An image may be in several slots, in the same state in all of them.
class NrdUserPool
{
public:
    static constexpr uint32_t kSlotsNum = static_cast<uint32_t>(ResourceType::TRANSIENT_POOL);

    /// `slot` is one of IN_... and OUT_...; any other value gives an entry that is never read.
    NrdUserImage& operator[](ResourceType slot) { return m_images[index(slot)]; }
    const NrdUserImage& operator[](ResourceType slot) const { return m_images[index(slot)]; }

private:
    static constexpr uint32_t index(ResourceType slot)
    {
        return static_cast<uint32_t>(slot) < kSlotsNum ? static_cast<uint32_t>(slot) : kSlotsNum;
    }
    NrdUserImage m_images[kSlotsNum + 1];
};

/// Images that no denoiser reads, for RecordDiagnosis(): float formats, resource size, state as in the user pool. Each
/// may be empty; the rules that need it rest.
struct NrdDiagnosisImages
{
    NrdUserImage diffuseFactor;     // .xyz what demodulation divided the diffuse signal by
    NrdUserImage specularFactor;    // the same for specular
    NrdUserImage specularDirection; // .xyz first direction of the specular path, world space, unit or 0
};

struct DenoiseOptions
{
    /// One more batch of barriers takes every image back to the state it came in; those that came in UNDEFINED stay
    /// where they are. Otherwise the entries tell the states, from which the application goes on.
    bool restoreInitialStates = false;
    /// Not 0: the application's number for what this call records, for Repeat(). What had the number before is
    /// forgotten.
    uint32_t recording = 0;
    /// With shared transient memory: the application's uses of it that came before, for which this call waits, ...
    NrdMemoryUse transientBefore = {};
    /// ... and those to come, which wait for this call. `stages` = 0 in `transientBefore` says that nobody else has
    /// used it since this integration did; with both 0 no barrier is recorded.
    NrdMemoryUse transientAfter = {};
};

/// Device memory as allocated, in bytes.
struct MemoryStatistics
{
    uint64_t permanent = 0; // history
    uint64_t transient = 0; // scratch; 0 if the application has lent it
    uint64_t total = 0;     // with constants, buffers, and what still waits for the GPU after a Resize()
};

struct PassTime
{
    const char* name = ""; // of the dispatch, "REBLUR_DIFFUSE_SPECULAR - Blur"
    float milliseconds = 0.0f;
};

/// GPU time of one frame: each pass with the barriers before it, in the order of recording.
struct Timings
{
    uint64_t frame = 0; // the NewFrame() it belongs to, counted from 1; 0 = nothing measured yet
    const PassTime* passes = nullptr;
    uint32_t passesNum = 0;
    float totalMilliseconds = 0.0f; // of all Denoise() calls of that frame
};

/// The last pass that the GPU began, as it wrote itself. After the loss of a device Vulkan calls the contents of mapped
/// memory undefined; drivers leave them as they were.
struct LastPass
{
    uint64_t frame = 0;      // the NewFrame() it belongs to, counted from 1; 0 = nothing known
    const char* name = "";   // of the dispatch, "REBLUR_DIFFUSE_SPECULAR - Blur"
    bool isFinished = false; // it and all others of its Denoise(): what came after them was running
};

/// Numbers for tests and overlays: what is alive now.
struct IntegrationStatistics
{
    uint32_t cachedUserImages = 0; // wrapped images of the application with their views
    uint32_t retiredObjects = 0;   // waiting for the GPU before they are destroyed
    uint32_t pipelines = 0;        // created so far
};

class NRD_API NrdIntegration
{
public:
    NrdIntegration();
    ~NrdIntegration(); // as Destroy()
    NrdIntegration(NrdIntegration&&) noexcept;
    NrdIntegration& operator=(NrdIntegration&&) noexcept;

    /// INVALID_ARGUMENT, UNSUPPORTED (a denoiser, a device feature, a format), NON_UNIQUE_IDENTIFIER, FAILURE. A second
    /// call needs a Destroy() in between. instanceDesc.messageSink receives the messages of both libraries.
    Result Create(const IntegrationCreationDesc& desc, const InstanceCreationDesc& instanceDesc);

    /// What Create() with the same arguments would take for its pools, by the driver's word, before anything is there.
    /// The other size of a Resize() may need more. Errors as of Create(); their sentence goes to the message sink.
    static Result GetMemoryRequirements(const IntegrationCreationDesc& desc, const InstanceCreationDesc& instanceDesc,
                                        PoolMemoryRequirements& requirements);

    /// The GPU must have finished everything that Denoise() recorded. Also after a failed Create(), and twice.
    void Destroy();
    bool IsCreated() const;

    /// Pools for another size, without waiting: what the GPU still uses is destroyed `framesInFlight` frames later.
    /// Settings, pipelines and identifiers stay. The next Denoise() needs SetCommonSettings() again, and history goes
    /// on if these say so: `resourceSizePrev` and `rectSizePrev` are those of the last frame, of the old size. That
    /// Denoise() then moves the history first; a side that shrinks is resampled. Any other `resourceSizePrev` begins
    /// histories anew. REFERENCE begins anew when its rectangle changes, as ever.
    /// `transientMemory`: lent for the new size in place of the memory before, which must live until the old textures
    /// are gone; null: as before, which must then be large enough. On failure the old size stays in use.
    Result Resize(uint16_t resourceWidth, uint16_t resourceHeight, const NrdMemory& transientMemory = {});

    /// Once per frame, before all else; the GPU must have finished the frame `framesInFlight` calls ago.
    Result NewFrame();

    /// At least once between NewFrame() and Denoise(); with several views, before each one's Denoise(). Refuses a frame
    /// index that stands still since the last frame, and a resource size other than the one of Create() or Resize().
    Result SetCommonSettings(const CommonSettings& settings);

    /// Copied; kept until set again, also across Resize().
    Result SetDenoiserSettings(Identifier identifier, const ReblurSettings& settings);
    Result SetDenoiserSettings(Identifier identifier, const RelaxSettings& settings);
    Result SetDenoiserSettings(Identifier identifier, const SigmaSettings& settings);
    Result SetDenoiserSettings(Identifier identifier, const ReferenceSettings& settings);
    /// The same, of ComputeConfidence().
    Result SetConfidenceSettings(const ConfidenceSettings& settings);

    /// Records the named denoisers, in the order of the list, each at most once per frame. `commandBuffer` is in the
    /// recording state and outside a render pass, of a queue with compute. Refused, with the name of the slot: a slot
    /// that a denoiser needs is empty, its image lacks usage, channels or size, or has two states.
    Result Denoise(VkCommandBuffer commandBuffer, const Identifier* identifiers, uint32_t identifiersNum,
                   NrdUserPool& userPool, const DenoiseOptions& options = {});

    /// Records what makes IN_DIFF_CONFIDENCE and IN_SPEC_CONFIDENCE from IN_STORED_SAMPLE, IN_RETRACED_SAMPLE and
    /// IN_STORED_NORMAL_ROUGHNESS: Denoise() with kConfidenceIdentifier, which may as well stand first in the list of
    /// another call. Its five images have ceil(resource size / InstanceCreationDesc::confidenceTileSize) pixels a side.
    /// For a denoiser to read the result, CommonSettings::isHistoryConfidenceAvailable must be set, and may be in all
    /// frames: after a restart confidence is 1. Once per frame; errors as of Denoise().
    Result ComputeConfidence(VkCommandBuffer commandBuffer, NrdUserPool& userPool, const DenoiseOptions& options = {});

    /// For command buffers that are recorded once. In place of Denoise() with the same arguments: makes this frame's
    /// constants and history ready for what Denoise() recorded under `options.recording`, without recording.
    /// `isRecordingNeeded` is false: submit that command buffer once, as if it had been recorded now; the entries of
    /// `userPool` tell the states it leaves. True: this frame's dispatches, images, states or place in the ring are
    /// others, nothing has changed but that Denoise() must be called with the same arguments before the frame ends.
    /// Settings that change constants only never need recording. A frame's history lies in one of `historyPeriod`
    /// places (see DenoiserInfo) and its constants in one of `framesInFlight`, so an application keeps a command buffer
    /// for each frame modulo their least common multiple. Always true with isGpuTimingEnabled, isPassTracingEnabled and
    /// while DumpInputs() is at work. Errors as of Denoise().
    Result Repeat(const Identifier* identifiers, uint32_t identifiersNum, NrdUserPool& userPool,
                  const DenoiseOptions& options, bool& isRecordingNeeded);

    /// Writes the inputs of Denoise() in the next `framesNum` [1; 10000] frames to a folder, which is made, as a
    /// capture: what nrd-replay takes and a bug report needs. Denoise() records copies; the files are written by
    /// NewFrame() when the GPU has certainly finished a frame, and by Destroy(). Signals are unpacked to radiance,
    /// distances and directions; those in checkerboard, confidences, the disocclusion threshold mix and denoisers of a
    /// lower resolution are left out, and of a local light the position is not kept. 100 bytes of disk and 16 of
    /// host memory per image and frame in flight, both per pixel. Where it ends early, capture.json has a note; a file
    /// that cannot be written is told to the message sink. INVALID_ARGUMENT, also while IsDumping(); FAILURE.
    Result DumpInputs(const char* folder, uint32_t framesNum);
    bool IsDumping() const; // frames are still to come or to be written

    /// For bring-up: records copies of the inputs, for Diagnose() to find what is wrong with them. Once per frame,
    /// after SetCommonSettings(), in place of Denoise() or before it; slots that are empty or that no denoiser of the
    /// instance reads are left out, IN_VIEWZ is needed. The images need no usage beyond SAMPLED; their entries tell the
    /// state they are left in. 16 bytes of host memory per pixel, image and frame in flight, from the first call on.
    /// Looks at frames that are done first, see InputDoctor::AddFrame().
    Result RecordDiagnosis(VkCommandBuffer commandBuffer, NrdUserPool& userPool, NrdDiagnosisImages* images = nullptr);

    /// What the recorded frames show, see nrd/doctor.h: those that the GPU has certainly finished, `framesInFlight`
    /// calls of NewFrame() later, or all of them if the application knows that it is done (`isGpuIdle`). Valid until
    /// the next call of this, RecordDiagnosis(), EndDiagnosis(), Resize() or Destroy().
    Result Diagnose(const Finding*& findings, uint32_t& findingsNum, bool isGpuIdle = false);

    /// Forgets what was recorded and found, as Resize() does, and gives the memory back when the GPU is done.
    Result EndDiagnosis();

    /// Drops the cached views of an image that is about to be destroyed, once the GPU is done with them. Not needed if
    /// `generation` is kept: unused views go by themselves after some frames.
    Result Forget(VkImage image);

    /// Valid until the next NewFrame() or Destroy(). Never waits: of the frame `framesInFlight` frames ago.
    Timings GetTimings() const;

    /// For the report of a lost device, at any time: of the last `framesInFlight` frames. The name is valid until the
    /// next NewFrame() or Destroy(). Messages of calls that find the device lost have it too.
    LastPass GetLastPass() const;
    MemoryStatistics GetMemoryStatistics() const;
    /// The transient pool's, for the application's own images and buffers between the calls. Null unless it is shared,
    /// and where there is no one block. Another one after Resize(), when the old one lives as long as its textures.
    NrdMemory GetTransientMemory() const;
    IntegrationStatistics GetStatistics() const;

    /// The descriptor library underneath, for GetInstanceDesc() and GetRequiredResources(); null before Create().
    const Instance* GetInstance() const;

    /// The sentence of the last refusal; empty if there was none. Valid until the next call that can refuse.
    const char* GetLastMessage() const;

private:
    friend struct IntegrationAccess; // creation over a given rhi::Device, see src/integration_access.h
    struct Impl;
    std::unique_ptr<Impl> m_impl; // null until the first Create()
};
} // namespace nrd
