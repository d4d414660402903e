// What comes out: pools, pipelines and the dispatches of a frame, for any graphics API to execute.
#pragma once
#include <cstddef>
#include <nrd/types.h>

namespace nrd
{
constexpr uint32_t kVersionMajor = 0;
constexpr uint32_t kVersionMinor = 1;
constexpr uint32_t kVersionBuild = 0;
// Grows whenever a struct of these headers does, so that the library knows the sizes it is handed.
constexpr uint32_t kHeaderVersion = 1;

// All three or none; memory must be aligned as asked. Null means out of memory and is handled.
struct AllocationCallbacks
{
    void* (*allocate)(void* userArg, size_t byteSize, size_t alignment) = nullptr;
    void* (*reallocate)(void* userArg, void* memory, size_t byteSize, size_t alignment) = nullptr;
    void (*free)(void* userArg, void* memory) = nullptr;
    void* userArg = nullptr;
};

// Receives one sentence per refused call: the field, its value and what was expected.
struct MessageSink
{
    void (*report)(void* userArg, Result result, const char* text) = nullptr;
    void* userArg = nullptr;
};

// What keeps the full size, although a denoiser's resolutionDivisor is above 1 and its history small.
enum class FullSize : uint32_t
{
    NOTHING,
    // Of all but REFERENCE: only the noisy signals and IN_SPEC_MV are small. Pixel p of a signal was traced from pixel
    // p * resolutionDivisor, counted from rectOrigin; results are upsampled along the guides.
    GUIDES_AND_OUTPUTS,
    // Of REBLUR and RELAX, without checkerboard: the noisy signals, too. Those of resolutionDivisor * resolutionDivisor
    // pixels are averaged along the guides before they are denoised.
    EVERYTHING,
    MAX_NUM
};

// In a list of identifiers: history confidence from samples of the last frame that were traced again. It reads
// IN_STORED_... and IN_RETRACED_SAMPLE, and writes IN_DIFF_CONFIDENCE and IN_SPEC_CONFIDENCE, all of a size of
// ceil(resourceSize / confidenceTileSize), for the denoisers that come after it. Keeps nothing from frame to frame.
constexpr Identifier kConfidenceIdentifier = 0xFFFFFFFF;

struct DenoiserDesc
{
    Identifier identifier = 0; // not kConfidenceIdentifier
    Denoiser denoiser = Denoiser::MAX_NUM;
    // [1; 8]. Inputs, outputs and history of this denoiser have ceil(size / resolutionDivisor) pixels a side; the
    // common settings stay those of the full resolution.
    uint32_t resolutionDivisor = 1;
    // false, SIGMA only: no temporal stabilisation whatever the settings say, and so no history memory. One such
    // denoiser serves any number of lights, one after another.
    bool hasHistory = true;
    FullSize fullSize = FullSize::NOTHING; // of no effect with a resolutionDivisor of 1
};

struct InstanceCreationDesc
{
    uint32_t headerVersion = kHeaderVersion; // leave it: says which headers the caller was compiled with
    AllocationCallbacks allocationCallbacks = {};
    MessageSink messageSink = {};
    const DenoiserDesc* denoisers = nullptr;
    uint32_t denoisersNum = 0; // 0 is allowed: an instance that can do nothing
    NormalEncoding normalEncoding = NormalEncoding::R10_G10_B10_A2_UNORM;
    RoughnessEncoding roughnessEncoding = RoughnessEncoding::LINEAR;
    // [1; 8] pixels, side of the tiles of which the application traces one sample of the last frame again: the instance
    // then makes history confidence, too, which kConfidenceIdentifier stands for. 0 = it does not; 5 is usual.
    uint32_t confidenceTileSize = 0;
    // The device is software, such as lavapipe, which runs both sides of a branch and is slow in shared memory. Shaders
    // then run fewer instructions where a GPU's would hide latencies; the pictures are the same.
    bool isSoftwareDevice = false;
};

struct LibraryDesc
{
    uint32_t versionMajor, versionMinor, versionBuild, headerVersion;
    const Denoiser* supportedDenoisers;
    uint32_t supportedDenoisersNum;
};

struct SPIRV
{
    const uint32_t* words;
    size_t byteSize;
};

struct SpecializationConstant
{
    uint32_t id;
    uint32_t value; // bits of the 32-bit constant
};

// Bindings: set constantsAndSamplersSet holds the dynamic uniform buffer, then the samplers of
// InstanceDesc::samplers in order; set resourcesSet holds the textures, then the storage textures, then the storage
// buffers, each in the order of DispatchDesc::resources, from binding 0.
struct PipelineDesc
{
    const char* shaderIdentifier; // name of the permutation in the shader manifest
    SPIRV computeShaderSPIRV;
    const SpecializationConstant* specializationConstants;
    uint32_t specializationConstantsNum;
    uint32_t texturesNum;
    uint32_t storageTexturesNum;
    uint32_t storageBuffersNum;
    bool hasConstantData; // false: set constantsAndSamplersSet is not used
};

// 2D, one layer, one mip, sampled and storage; each side is ceil(resourceSize / downsampleFactor).
struct TextureDesc
{
    Format format;
    uint16_t downsampleFactor;
};

struct BufferDesc
{
    uint32_t byteSizePerTile; // size = this times the number of 16x16 tiles of the resource, plus byteSize
    uint32_t byteSize;
    bool isIndirectArguments;
};

// Totals for one frame in which every denoiser runs once with everything on, clears included.
struct DescriptorPoolDesc
{
    uint32_t setsMaxNum;
    uint32_t constantBuffersMaxNum;
    uint32_t samplersMaxNum;
    uint32_t texturesMaxNum;
    uint32_t storageTexturesMaxNum;
    uint32_t storageBuffersMaxNum;
};

struct DenoiserInfo
{
    Identifier identifier;
    Denoiser denoiser;
    uint32_t historyPeriod; // ping-pong textures are back in their places after this many dispatch requests
};

struct InstanceDesc
{
    uint32_t constantsAndSamplersSet;
    uint32_t constantBufferBinding;
    uint32_t samplersBaseBinding;
    uint32_t resourcesSet;
    uint32_t constantBufferMaxDataSize; // bytes
    const char* shaderEntryPoint;

    const Sampler* samplers;
    uint32_t samplersNum;
    const PipelineDesc* pipelines;
    uint32_t pipelinesNum;
    const TextureDesc* permanentPool;
    uint32_t permanentPoolSize;
    const TextureDesc* transientPool;
    uint32_t transientPoolSize;
    const BufferDesc* buffers;
    uint32_t buffersNum;
    const DenoiserInfo* denoisers;
    uint32_t denoisersNum;
    DescriptorPoolDesc descriptorPoolDesc;
    NormalEncoding normalEncoding;
    RoughnessEncoding roughnessEncoding;
};

struct ResourceDesc
{
    DescriptorType descriptorType;
    ResourceState state;
    ResourceType type;
    uint16_t indexInPool; // for TRANSIENT_POOL, PERMANENT_POOL and buffers
};

constexpr uint16_t kNoBuffer = 0xFFFF;

// Dispatches run in order. Between two of them a resource needs a barrier if its state changes or either use writes.
struct DispatchDesc
{
    const char* name; // "REBLUR_DIFFUSE_SPECULAR - Blur"
    Identifier identifier;
    uint16_t pipelineIndex;
    const ResourceDesc* resources; // textures, storage textures, storage buffers
    uint32_t resourcesNum;
    const uint8_t* constantBufferData; // null if the pipeline has none
    uint32_t constantBufferDataSize;
    bool constantBufferDataMatchesPreviousDispatch;
    uint32_t gridWidth, gridHeight; // groups; the full grid, also when indirect arguments exist
    uint16_t indirectBufferIndex;   // index in InstanceDesc::buffers, kNoBuffer = none
    uint32_t indirectBufferOffset;  // bytes
};

// One user-pool slot a denoiser needs under its present settings.
struct ResourceRequirement
{
    ResourceType type;
    DescriptorType descriptorType; // TEXTURE: sampled usage; STORAGE_TEXTURE: storage usage, and see isReadBack
    bool isRequired;               // false: used when bound, or only with a setting that is off now
    bool isReadBack;               // of an output: holds steps on the way too, so that it needs sampled usage as well
    Format minFormat;              // smallest format that keeps what the slot carries
    uint32_t sizeDivisor = 1;      // the image has at least ceil(resourceSize / sizeDivisor) pixels a side
};
} // namespace nrd
