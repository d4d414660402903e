// InputDoctor: looks at what a denoiser is fed, and names what is wrong with it and how to mend it. No graphics API.
//
// It takes the inputs of a few frames in a row, as the denoiser gets them: the settings, and the slots' texels as
// floats. Two frames tell about motion and matrices, one about the rest; a camera that moves and turns tells most.
// A rule fires only where something else would fit clearly better, so a good input raises no finding; what a picture
// does not show (a flipped axis along which nothing moves) is not found.
//
// Threads: one at a time per object. Nothing throws; a refused call changes nothing.
// NrdIntegration::RecordDiagnosis() and Diagnose() feed it with an application's images.
#pragma once
#include <memory>
#include <nrd/settings.h>

namespace nrd
{
/// Order is part of the interface; it only grows.
enum class DoctorRule : uint32_t
{
    FRAME_INDEX,          // stands still
    PREVIOUS_CAMERA,      // what is said of the last frame is not what the last frame said
    JITTER_IN_MATRIX,     // the projection moves with the sampling pattern
    NON_FINITE,           // NaN or infinity
    NEGATIVE_RADIANCE,    //
    SKY_IN_RANGE,         // pixels without a surface are denoised
    VIEWZ_ENCODING,       // not linear view depth
    NORMAL_ENCODING,      // encoded otherwise than the instance decodes
    NORMAL_SPACE,         // not world space, or an axis is flipped
    ROUGHNESS_ENCODING,   // needs DoctorFrame::specularDirection
    MOTION,               // sign, scale, flip, space or unit
    MOTION_DEPTH,         // the same of the third component
    JITTER_IN_MOTION,     //
    HIT_DISTANCE_PRIMARY, // includes the way from the camera
    HIT_DISTANCE_CONSTANT,
    HIT_DISTANCE_SCALE, // not normalised
    ALBEDO_IN_RADIANCE, // needs DoctorFrame::diffuseFactor or specularFactor
    MAX_NUM
};
NRD_API const char* toString(DoctorRule rule); // "UNKNOWN" for a value outside the enumeration

enum class FindingSeverity : uint32_t
{
    WARNING, // costs quality
    FAULT,   // the denoiser cannot work so
    MAX_NUM
};

struct Finding
{
    DoctorRule rule = DoctorRule::MAX_NUM;
    FindingSeverity severity = FindingSeverity::FAULT;
    ResourceType slot = ResourceType::MAX_NUM; // MAX_NUM: it is about CommonSettings
    float evidence = 0.0f;                     // the number in the text that made the rule fire
    const char* text = "";                     // one sentence: what is wrong and how to mend it
};

/// One frame's inputs. Images have 4 floats per texel, missing components are 0; rows of common.resourceSize.
struct DoctorFrame
{
    CommonSettings common = {};
    NormalEncoding normalEncoding = NormalEncoding::R10_G10_B10_A2_UNORM; // of the instance
    RoughnessEncoding roughnessEncoding = RoughnessEncoding::LINEAR;
    HitDistanceParameters hitDistanceParameters = {}; // of ReblurSettings

    const float* viewZ = nullptr;           // IN_VIEWZ; required
    const float* motion = nullptr;          // IN_MV; this and all below may be null: rules that need them rest
    const float* normalRoughness = nullptr; // IN_NORMAL_ROUGHNESS as stored; UNORM and SNORM as the shader sees them
    const float* diffuse = nullptr;         // IN_DIFF_RADIANCE_HITDIST of REBLUR
    const float* specular = nullptr;        // IN_SPEC_RADIANCE_HITDIST of REBLUR

    // Not read by any denoiser.
    const float* diffuseFactor = nullptr;     // .xyz what demodulation divided the diffuse signal by
    const float* specularFactor = nullptr;    // the same for specular
    const float* specularDirection = nullptr; // .xyz first direction of the specular path, world space, unit or 0
};

class NRD_API InputDoctor
{
public:
    InputDoctor();
    ~InputDoctor();
    InputDoctor(InputDoctor&&) noexcept;
    InputDoctor& operator=(InputDoctor&&) noexcept;

    /// Frames in order; only consecutive ones are compared. The images are read before it returns, which takes
    /// milliseconds for a small picture and most of a second for a large one. INVALID_ARGUMENT, FAILURE (memory).
    Result AddFrame(const DoctorFrame& frame);
    uint32_t GetFrameNum() const;

    /// What all frames so far show, faults first. Valid until the next call.
    Result GetFindings(const Finding*& findings, uint32_t& findingsNum);

    /// Forgets all frames.
    void Reset();

    /// The sentence of the last refusal; empty if there was none.
    const char* GetLastMessage() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl; // null until the first frame
};
} // namespace nrd
