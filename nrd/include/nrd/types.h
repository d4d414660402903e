// The vocabulary: results, formats, denoisers, resource slots and the encodings of the guides.
#pragma once
#include <cstdint>

#if defined(NRD_SHARED) && defined(_WIN32)
#if defined(NRD_BUILDING)
#define NRD_API extern "C++" __declspec(dllexport)
#else
#define NRD_API extern "C++" __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define NRD_API __attribute__((visibility("default")))
#else
#define NRD_API
#endif

namespace nrd
{
// Chosen by the application; names one denoiser of an instance.
using Identifier = uint32_t;

enum class [[nodiscard]] Result : uint32_t{
    SUCCESS,
    FAILURE,               // memory, or an error of the device underneath
    INVALID_ARGUMENT,      // the message names the field, its value and what was expected
    UNSUPPORTED,           // a denoiser, encoding or version this build does not offer
    NON_UNIQUE_IDENTIFIER, // two denoisers of one instance share an identifier
    MAX_NUM};

// Order is part of the interface; it only grows.
enum class Denoiser : uint32_t
{
    REBLUR_DIFFUSE,
    REBLUR_DIFFUSE_OCCLUSION,
    REBLUR_DIFFUSE_SH,
    REBLUR_SPECULAR,
    REBLUR_SPECULAR_OCCLUSION,
    REBLUR_SPECULAR_SH,
    REBLUR_DIFFUSE_SPECULAR,
    REBLUR_DIFFUSE_SPECULAR_OCCLUSION,
    REBLUR_DIFFUSE_SPECULAR_SH,
    REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION,
    RELAX_DIFFUSE,
    RELAX_DIFFUSE_SH,
    RELAX_SPECULAR,
    RELAX_SPECULAR_SH,
    RELAX_DIFFUSE_SPECULAR,
    RELAX_DIFFUSE_SPECULAR_SH,
    SIGMA_SHADOW,
    SIGMA_SHADOW_TRANSLUCENCY,
    REFERENCE,
    MAX_NUM
};

// The slots of the user pool, then the two pools the library describes. Order is part of the interface.
enum class ResourceType : uint32_t
{
    IN_MV,               // motion, previous - current, unjittered; see CommonSettings::motionVectorScale
    IN_NORMAL_ROUGHNESS, // world normal and roughness, packed by NRD_FrontEnd_PackNormalAndRoughness
    IN_VIEWZ,            // linear view depth, either sign; sky: finite and beyond denoisingRange
    IN_DIFF_CONFIDENCE,  // [0; 1], on the previous frame's screen
    IN_SPEC_CONFIDENCE,
    IN_DISOCCLUSION_THRESHOLD_MIX, // [0; 1], 0 = disocclusionThreshold, 1 = ...Alternate
    // .xyz where what the specular path's first bounce hits was one frame ago minus where it is now, camera excluded:
    // in world units whatever motionVectorScale is, 0 where nothing moves; .w 0: the pixel has no sample of the lobe.
    IN_SPEC_MV,
    IN_DIFF_RADIANCE_HITDIST,
    IN_SPEC_RADIANCE_HITDIST,
    IN_DIFF_HITDIST,
    IN_SPEC_HITDIST,
    IN_DIFF_DIRECTION_HITDIST,
    IN_DIFF_SH0,
    IN_DIFF_SH1,
    IN_SPEC_SH0,
    IN_SPEC_SH1,
    IN_PENUMBRA,
    IN_TRANSLUCENCY,
    IN_SIGNAL,
    OUT_DIFF_RADIANCE_HITDIST,
    OUT_SPEC_RADIANCE_HITDIST,
    OUT_DIFF_SH0,
    OUT_DIFF_SH1,
    OUT_SPEC_SH0,
    OUT_SPEC_SH1,
    OUT_DIFF_HITDIST,
    OUT_SPEC_HITDIST,
    OUT_DIFF_DIRECTION_HITDIST,
    OUT_SHADOW_TRANSLUCENCY,
    OUT_SIGNAL,
    OUT_VALIDATION,
    // Of the history confidence, one texel per tile of InstanceCreationDesc::confidenceTileSize pixels a side. .x
    // luminance of the demodulated diffuse lobe, .y of specular, .z view depth as in IN_VIEWZ:
    IN_STORED_SAMPLE,           // last frame's sample of the tile, see NRD_GetConfidencePixel
    IN_RETRACED_SAMPLE,         // the same path, by the same random numbers, through this frame's scene
    IN_STORED_NORMAL_ROUGHNESS, // last frame's IN_NORMAL_ROUGHNESS where that sample is
    TRANSIENT_POOL,             // may be reused by the application after the dispatches
    PERMANENT_POOL,             // history; not to be touched
    MAX_NUM
};

// Named as in Vulkan.
enum class Format : uint32_t
{
    R8_UNORM,
    R8_SNORM,
    R8_UINT,
    RG8_UNORM,
    RG8_UINT,
    RGBA8_UNORM,
    RGBA8_SNORM,
    R16_UNORM,
    R16_UINT,
    R16_SFLOAT,
    RG16_UNORM,
    RG16_SFLOAT,
    RGBA16_UNORM,
    RGBA16_SNORM,
    RGBA16_SFLOAT,
    R32_UINT,
    R32_SFLOAT,
    RG32_UINT,
    RG32_SFLOAT,
    RGBA32_SFLOAT,
    A2B10G10R10_UNORM_PACK32,
    B10G11R11_UFLOAT_PACK32,
    E5B9G9R9_UFLOAT_PACK32,
    MAX_NUM
};

enum class DescriptorType : uint32_t
{
    TEXTURE,         // sampled
    STORAGE_TEXTURE, // written, never read through this descriptor
    STORAGE_BUFFER,
    MAX_NUM
};

// The state a resource must be in while a dispatch runs, compute stage.
enum class ResourceState : uint32_t
{
    SAMPLED,             // every use in this dispatch is a sampled read
    STORAGE,             // every use is a storage write or an atomic operation
    SAMPLED_AND_STORAGE, // both: each invocation reads and writes its own texel only; general layout
    INDIRECT_ARGUMENTS,
    MAX_NUM
};

enum class Sampler : uint32_t
{
    NEAREST_CLAMP,
    LINEAR_CLAMP,
    MAX_NUM
};

// How IN_NORMAL_ROUGHNESS is encoded; chosen when the instance is created.
enum class NormalEncoding : uint32_t
{
    RGBA8_UNORM,
    RGBA8_SNORM,
    R10_G10_B10_A2_UNORM, // octahedral, with a 2-bit material ID; the default
    RGBA16_UNORM,
    RGBA16_SNORM, // float formats as well
    MAX_NUM
};

enum class RoughnessEncoding : uint32_t
{
    SQ_LINEAR,   // GGX alpha
    LINEAR,      // perceptual roughness; the default
    SQRT_LINEAR, // square root of it
    MAX_NUM
};

enum class AccumulationMode : uint8_t
{
    CONTINUE,
    RESTART,           // history lengths are 0 for this frame: a camera cut
    CLEAR_AND_RESTART, // every texture the denoiser writes is zeroed first
    MAX_NUM
};

enum class CheckerboardMode : uint8_t
{
    OFF,
    BLACK,
    WHITE,
    MAX_NUM
};

// Spatial reuse of the noisy input before it is accumulated.
enum class PrePassMode : uint8_t
{
    OFF,
    SIMPLE, // taps are weighed by guides and hit distance
    AUTO,   // SIMPLE where hit distances or half of a checkerboard are to be completed, else OFF
    MAX_NUM
};

enum class HitDistanceReconstructionMode : uint8_t
{
    OFF,
    AREA_3X3,
    AREA_5X5,
    MAX_NUM
};

// The enumerator's name as written above; "UNKNOWN" for a value outside the enumeration. Never null.
NRD_API const char* toString(Result value);
NRD_API const char* toString(Denoiser value);
NRD_API const char* toString(ResourceType value);
NRD_API const char* toString(Format value);

NRD_API uint32_t texelByteSize(Format format); // bytes; 0 for values outside the enumeration
} // namespace nrd
