// The quantities that are measured, taken from the frames and references of a capture or from a denoiser's output.
#pragma once
#include "capture.h"
#include "picture.h"

#include <array>

namespace sample
{
enum class Signal : uint8_t
{
    Composed,
    Diffuse,
    Specular,
    Shadow,       // share of the light that is visible, V
    Translucency, // its colour
    NormHitDist,  // diffuse: ambient occlusion
    SpecularNormHitDist,
    Count
};
inline constexpr size_t kSignalCount = static_cast<size_t>(Signal::Count);

struct SignalInfo
{
    Signal signal;
    const char* name;   // key of the report
    int planeCount;     // 3: colour, 1: scalar
    bool isRadiance;    // tone-mapped before it is compared; else compared as it is
    bool isSkyIncluded; // all pixels count
    bool hasFlicker;
    Channel reference; // first channel of it in a reference
};
const SignalInfo& signalInfo(Signal signal);

// One frame's pictures, linear; those that don't exist have no planes.
struct Signals
{
    std::array<Picture, kSignalCount> pictures;

    Picture& operator[](Signal s) { return pictures[static_cast<size_t>(s)]; }
    const Picture& operator[](Signal s) const { return pictures[static_cast<size_t>(s)]; }
    bool has(Signal s) const { return (*this)[s].exists(); }
};

// Which signals a denoiser produces; Composed is never among them, it follows from the others.
using SignalSet = std::array<bool, kSignalCount>;

// Everything a reference holds. Composed is put together from the reference's own signals where all are there, so
// that a signal which a denoiser takes from the reference adds no error; else it is the recorded one.
Signals referenceSignals(const Planes& reference, const Planes& frame);

// The wanted signals of the noisy frame. A hit distance of 0 is 0, a miss is 1, and so is the sky.
Signals noisySignals(const Planes& frame, const CaptureInfo& info, const SignalSet& wanted);

// Adds Composed to `signals`: direct + sun * shadow + diffuse * diffuseFactor + specular * specularFactor, with what
// `signals` lacks taken from the reference. Does nothing when neither radiance nor shadow is among them, or when
// something that composition needs is in neither.
void compose(Signals& signals, const Planes& frame, const Signals& reference);

// How many values of all pictures are NaN or infinite.
size_t countNonFinite(const Signals& signals);

// Pixels nearer than the sky.
Mask surfaceMask(const Planes& frame, double denoisingRange);

// The distance by which a hit distance is divided: (A + B |viewZ|) mix(C, 1, spread(roughness)); roughness 1: diffuse.
double hitDistanceNormalization(const CaptureInfo& info, double viewZ, double roughness);
} // namespace sample
