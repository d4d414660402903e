#include "signals.h"

#include <algorithm>
#include <cmath>

namespace sample
{
namespace
{
// clang-format off
constexpr SignalInfo kSignals[] = {
    //                                                          planes radiance sky    flicker
    {Signal::Composed,            "composed",            3, true,  true,  true,  Channel::RefComposedR},
    {Signal::Diffuse,             "diffuse",             3, true,  false, true,  Channel::RefDiffuseR},
    {Signal::Specular,            "specular",            3, true,  false, true,  Channel::RefSpecularR},
    {Signal::Shadow,              "shadow",              1, false, false, true,  Channel::RefShadowV},
    {Signal::Translucency,        "translucency",        3, false, false, false, Channel::RefShadowR},
    {Signal::NormHitDist,         "normHitDist",         1, false, false, true,  Channel::RefDiffuseNormHitDist},
    {Signal::SpecularNormHitDist, "specularNormHitDist", 1, false, false, true,  Channel::RefSpecularNormHitDist},
};
// clang-format on

constexpr bool rowsMatchKeys()
{
    for (size_t i = 0; i < std::size(kSignals); i++)
        if (static_cast<size_t>(kSignals[i].signal) != i) return false;
    return std::size(kSignals) == kSignalCount;
}
static_assert(rowsMatchKeys());

Picture pictureOf(const Planes& planes, Channel first, int count)
{
    if (!planes.has(first)) return {};
    Picture picture(planes.width, planes.height, static_cast<size_t>(count));
    for (int c = 0; c < count; c++) picture.planes[static_cast<size_t>(c)] = planes[next(first, c)];
    return picture;
}

bool isSky(float viewZ, double denoisingRange) { return std::abs(viewZ) >= denoisingRange; }

// A hit distance that is not finite is no sample.
float normalized(float hitDist, double normalization)
{
    if (!std::isfinite(hitDist) || hitDist <= 0.0f) return 0.0f;
    if (hitDist >= kHitDistMiss) return 1.0f;
    return static_cast<float>(std::min(1.0, hitDist / normalization));
}

Picture hitDistances(const Planes& frame, const CaptureInfo& info, bool isSpecular)
{
    const Channel channel = isSpecular ? Channel::SpecularHitDist : Channel::DiffuseHitDist;
    if (!frame.has(channel) || (isSpecular && !frame.has(Channel::Roughness))) return {};
    Picture picture(frame.width, frame.height, 1);
    for (size_t i = 0; i < frame.pixelCount(); i++)
    {
        const double roughness = isSpecular ? frame[Channel::Roughness][i] : 1.0;
        const float viewZ = frame[Channel::ViewZ][i];
        const float distance = isSky(viewZ, info.denoisingRange) ? kHitDistMiss : frame[channel][i];
        picture.planes[0][i] = normalized(distance, hitDistanceNormalization(info, viewZ, roughness));
    }
    return picture;
}

Picture visibility(const Planes& frame)
{
    if (!frame.has(Channel::ShadowDist)) return {};
    Picture picture(frame.width, frame.height, 1);
    for (size_t i = 0; i < frame.pixelCount(); i++)
        picture.planes[0][i] = frame[Channel::ShadowDist][i] >= kHitDistMiss ? 1.0f : 0.0f;
    return picture;
}

bool addProduct(Picture& sum, const Picture& signal, const Planes& frame, Channel factor)
{
    if (!signal.exists()) return false;
    for (size_t c = 0; c < 3; c++)
    {
        const std::vector<float>& values = signal.planes[std::min(c, signal.planes.size() - 1)];
        const std::vector<float>& factors = frame[next(factor, static_cast<int>(c))];
        for (size_t i = 0; i < values.size(); i++)
            sum.planes[c][i] += factors[i] == 0.0f ? 0.0f : values[i] * factors[i]; // a NaN behind a 0 is not seen
    }
    return true;
}

// No picture when something is missing.
Picture composed(const Planes& frame, const Signals& signals, const Signals& reference)
{
    const auto chosen = [&](Signal signal) -> const Picture&
    { return signals.has(signal) ? signals[signal] : reference[signal]; };
    Picture sum =
        frame.has(Channel::DirectR) ? pictureOf(frame, Channel::DirectR, 3) : Picture(frame.width, frame.height, 3);
    // A denoiser without translucency shades with V in all three channels; one without shadows takes the reference's.
    const bool usesVisibility = signals.has(Signal::Shadow) && !signals.has(Signal::Translucency);
    Picture lit(frame.width, frame.height, 1);
    std::fill(lit.planes[0].begin(), lit.planes[0].end(), 1.0f);
    const Picture& shadow =
        frame.has(Channel::ShadowDist) ? chosen(usesVisibility ? Signal::Shadow : Signal::Translucency) : lit;
    bool isComplete = true;
    if (frame.has(Channel::SunR)) isComplete &= addProduct(sum, shadow, frame, Channel::SunR);
    if (frame.has(Channel::DiffuseFactorR))
        isComplete &= addProduct(sum, chosen(Signal::Diffuse), frame, Channel::DiffuseFactorR);
    if (frame.has(Channel::SpecularFactorR))
        isComplete &= addProduct(sum, chosen(Signal::Specular), frame, Channel::SpecularFactorR);
    return isComplete ? sum : Picture();
}

} // namespace

const SignalInfo& signalInfo(Signal signal) { return kSignals[static_cast<size_t>(signal)]; }

Signals referenceSignals(const Planes& reference, const Planes& frame)
{
    Signals signals;
    for (const SignalInfo& row : kSignals) signals[row.signal] = pictureOf(reference, row.reference, row.planeCount);
    Picture picture = composed(frame, signals, signals);
    if (picture.exists()) signals[Signal::Composed] = std::move(picture);
    return signals;
}

Signals noisySignals(const Planes& frame, const CaptureInfo& info, const SignalSet& wanted)
{
    const auto wants = [&](Signal s) { return wanted[static_cast<size_t>(s)]; };
    Signals signals;
    if (wants(Signal::Diffuse)) signals[Signal::Diffuse] = pictureOf(frame, Channel::DiffuseR, 3);
    if (wants(Signal::Specular)) signals[Signal::Specular] = pictureOf(frame, Channel::SpecularR, 3);
    if (wants(Signal::Shadow)) signals[Signal::Shadow] = visibility(frame);
    if (wants(Signal::Translucency)) signals[Signal::Translucency] = pictureOf(frame, Channel::ShadowR, 3);
    if (wants(Signal::NormHitDist)) signals[Signal::NormHitDist] = hitDistances(frame, info, false);
    if (wants(Signal::SpecularNormHitDist)) signals[Signal::SpecularNormHitDist] = hitDistances(frame, info, true);
    return signals;
}

void compose(Signals& signals, const Planes& frame, const Signals& reference)
{
    const bool hasAny = signals.has(Signal::Diffuse) || signals.has(Signal::Specular) || signals.has(Signal::Shadow);
    if (hasAny) signals[Signal::Composed] = composed(frame, signals, reference);
}

size_t countNonFinite(const Signals& signals)
{
    size_t count = 0;
    for (const Picture& picture : signals.pictures)
        for (const auto& plane : picture.planes)
            count += static_cast<size_t>(
                std::count_if(plane.begin(), plane.end(), [](float v) { return !std::isfinite(v); }));
    return count;
}

Mask surfaceMask(const Planes& frame, double denoisingRange)
{
    Mask mask(frame.pixelCount());
    for (size_t i = 0; i < mask.size(); i++) mask[i] = !isSky(frame[Channel::ViewZ][i], denoisingRange);
    return mask;
}

double hitDistanceNormalization(const CaptureInfo& info, double viewZ, double roughness)
{
    const auto& p = info.hitDistanceParameters;
    const double r = std::clamp(roughness, 0.0, 1.0);
    const double spread = (1.0 - std::exp2(-200.0 * r * r)) * std::sqrt(r);
    return (p[0] + p[1] * std::abs(viewZ)) * (p[2] + (1.0 - p[2]) * spread);
}
} // namespace sample
