#include "validate.h"
#include "checker.h"
#include "expand.h"
#include <cfloat>

namespace nrd
{
namespace
{
constexpr float kHuge = FLT_MAX;

void checkHistory(Checker& check, const ReblurSettings& s)
{
    check.inside("maxAccumulatedFrameNum", s.maxAccumulatedFrameNum, 0u, 63u);
    check.inside("maxFastAccumulatedFrameNum", s.maxFastAccumulatedFrameNum, 0u, 63u);
    check.inside("maxStabilizedFrameNum", s.maxStabilizedFrameNum, 0u, 255u);
    check.inside("historyFixFrameNum", s.historyFixFrameNum, 0u, 8u);
    check.require(s.historyFixFrameNum == 0 || s.historyFixFrameNum < s.maxFastAccumulatedFrameNum,
                  "historyFixFrameNum", s.historyFixFrameNum, "0 or below maxFastAccumulatedFrameNum");
    check.inside("historyFixBasePixelStride", s.historyFixBasePixelStride, 1u, 64u);
    check.inside("historyFixAlternatePixelStride", s.historyFixAlternatePixelStride, 1u, 64u);

    const ResponsiveAccumulationSettings& r = s.responsiveAccumulationSettings;
    check.inside("responsiveAccumulationSettings.roughnessThreshold", r.roughnessThreshold, 0.0f, 1.0f);
    // The minimum is unused, and so not in anybody's way, while responsive accumulation is off.
    check.require(r.roughnessThreshold <= 0.0f || r.minAccumulatedFrameNum <= s.historyFixFrameNum,
                  "responsiveAccumulationSettings.minAccumulatedFrameNum", r.minAccumulatedFrameNum,
                  "at most historyFixFrameNum");
}

void checkFilters(Checker& check, const ReblurSettings& s)
{
    check.inside("fastHistoryClampingSigmaScale", s.fastHistoryClampingSigmaScale, 1.0f, 3.0f);
    check.inside("diffusePrepassBlurRadius", s.diffusePrepassBlurRadius, 0.0f, 256.0f);
    check.inside("specularPrepassBlurRadius", s.specularPrepassBlurRadius, 0.0f, 256.0f);
    check.inside("minHitDistanceWeight", s.minHitDistanceWeight, 0.0f, 0.2f);
    check.inside("minBlurRadius", s.minBlurRadius, 0.0f, 256.0f);
    check.inside("maxBlurRadius", s.maxBlurRadius, 0.0f, 256.0f);
    check.inside("lobeAngleFraction", s.lobeAngleFraction, 0.0f, 1.0f);
    check.inside("roughnessFraction", s.roughnessFraction, 0.0f, 1.0f);
    check.aboveUpTo("planeDistanceSensitivity", s.planeDistanceSensitivity, 0.0f, 1.0f);
    check.inside("fireflySuppressorMinRelativeScale", s.fireflySuppressorMinRelativeScale, 1.0f, 3.0f);
}

void checkModes(Checker& check, const ReblurSettings& s)
{
    check.enumerator("prePassMode", s.prePassMode);
    check.enumerator("checkerboardMode", s.checkerboardMode);
    check.enumerator("hitDistanceReconstructionMode", s.hitDistanceReconstructionMode);
}
} // namespace

Error findError(const ReblurSettings& s)
{
    Checker check("ReblurSettings");
    check.aboveUpTo("hitDistanceParameters.A", s.hitDistanceParameters.A, 0.0f, kHuge);
    check.aboveUpTo("hitDistanceParameters.B", s.hitDistanceParameters.B, 0.0f, kHuge);
    check.inside("hitDistanceParameters.C", s.hitDistanceParameters.C, 1.0f, kHuge);
    check.aboveUpTo("antilagSettings.luminanceSigmaScale", s.antilagSettings.luminanceSigmaScale, 0.0f, 100.0f);
    check.aboveUpTo("antilagSettings.luminanceSensitivity", s.antilagSettings.luminanceSensitivity, 0.0f, 100.0f);
    check.aboveUpTo("convergenceSettings.s", s.convergenceSettings.s, 0.0f, 10.0f);
    check.inside("convergenceSettings.b", s.convergenceSettings.b, 0.0f, 1.0f);
    check.inside("convergenceSettings.p", s.convergenceSettings.p, 0.0f, 1.0f);
    checkHistory(check, s);
    checkFilters(check, s);
    checkModes(check, s);
    return check.error();
}

Error findError(const SigmaSettings& s)
{
    Checker check("SigmaSettings");
    for (int i = 0; i < 3; i++)
    {
        check.inside("lightDirection", s.lightDirection[i], -kHuge, kHuge, i);
        check.inside("lightPosition", s.lightPosition[i], -kHuge, kHuge, i);
    }
    check.aboveUpTo("planeDistanceSensitivity", s.planeDistanceSensitivity, 0.0f, 1.0f);
    check.inside("maxStabilizedFrameNum", s.maxStabilizedFrameNum, 0u, 15u);
    check.enumerator("checkerboardMode", s.checkerboardMode);
    return check.error();
}

Error findError(const ReferenceSettings& s)
{
    Checker check("ReferenceSettings");
    check.inside("maxAccumulatedFrameNum", s.maxAccumulatedFrameNum, 0u, 4095u);
    return check.error();
}

Error findError(const ConfidenceSettings& s)
{
    constexpr float kMaxHalf = 65504.0f;
    Checker check("ConfidenceSettings");
    check.aboveUpTo("sensitivity", s.sensitivity, 0.0f, 100.0f);
    check.inside("tolerance", s.tolerance, 0.0f, 1.0f);
    check.aboveUpTo("minLuminance", s.minLuminance, 0.0f, kMaxHalf);
    check.aboveUpTo("maxLuminance", s.maxLuminance, 0.0f, kMaxHalf);
    check.aboveUpTo("planeDistanceSensitivity", s.planeDistanceSensitivity, 0.0f, 1.0f);
    check.inside("blurPassNum", s.blurPassNum, 0u, 5u);
    return check.error();
}

namespace
{
// REFERENCE knows no guides to resample along, and a mean of penumbrae is none.
FullSize mostFullSize(Denoiser denoiser)
{
    if (denoiser == Denoiser::REFERENCE) return FullSize::NOTHING;
    const bool isShadow = denoiser == Denoiser::SIGMA_SHADOW || denoiser == Denoiser::SIGMA_SHADOW_TRANSLUCENCY;
    return isShadow ? FullSize::GUIDES_AND_OUTPUTS : FullSize::EVERYTHING;
}

void checkDenoisers(Error& error, const InstanceCreationDesc& desc)
{
    for (uint32_t i = 0; i < desc.denoisersNum && !error; i++)
    {
        const DenoiserDesc& denoiser = desc.denoisers[i];
        if (!findVariant(denoiser.denoiser).family)
        {
            error.result = Result::UNSUPPORTED;
            error.text << "InstanceCreationDesc::denoisers[" << i << "].denoiser is "
                       << static_cast<uint32_t>(denoiser.denoiser) << " (" << toString(denoiser.denoiser)
                       << "), expected one of LibraryDesc::supportedDenoisers";
        }
        if (!error && !findVariant(denoiser.denoiser, keptBy(denoiser)).family)
        {
            error.result = Result::INVALID_ARGUMENT;
            error.text << "InstanceCreationDesc::denoisers[" << i
                       << "].hasHistory is 0, expected 1: " << toString(denoiser.denoiser) << " does not work without";
        }
        if (!error && (denoiser.resolutionDivisor < 1 || denoiser.resolutionDivisor > 8))
        {
            error.result = Result::INVALID_ARGUMENT;
            error.text << "InstanceCreationDesc::denoisers[" << i << "].resolutionDivisor is "
                       << denoiser.resolutionDivisor << ", expected [1; 8]";
        }
        if (!error && denoiser.fullSize > mostFullSize(denoiser.denoiser))
        {
            error.result = Result::INVALID_ARGUMENT;
            error.text << "InstanceCreationDesc::denoisers[" << i << "].fullSize is "
                       << static_cast<uint32_t>(denoiser.fullSize) << ", expected at most "
                       << static_cast<uint32_t>(mostFullSize(denoiser.denoiser)) << " of "
                       << toString(denoiser.denoiser);
        }
        if (!error && denoiser.identifier == kConfidenceIdentifier)
        {
            error.result = Result::NON_UNIQUE_IDENTIFIER;
            error.text << "InstanceCreationDesc::denoisers[" << i << "].identifier is " << denoiser.identifier
                       << ", which is kConfidenceIdentifier";
        }
        for (uint32_t j = 0; j < i && !error; j++)
        {
            if (desc.denoisers[j].identifier != denoiser.identifier) continue;
            error.result = Result::NON_UNIQUE_IDENTIFIER;
            error.text << "InstanceCreationDesc::denoisers[" << i << "].identifier is " << denoiser.identifier
                       << ", which denoisers[" << j << "] has already";
        }
    }
}
} // namespace

Error findError(const InstanceCreationDesc& desc)
{
    Checker check("InstanceCreationDesc");
    const AllocationCallbacks& c = desc.allocationCallbacks;
    const int callbackNum = (c.allocate ? 1 : 0) + (c.reallocate ? 1 : 0) + (c.free ? 1 : 0);
    Error error;
    if (desc.headerVersion == 0 || desc.headerVersion > kHeaderVersion)
    {
        error.result = Result::UNSUPPORTED;
        error.text << "InstanceCreationDesc::headerVersion is " << desc.headerVersion << ", expected [1; "
                   << kHeaderVersion << "]: the library is older than its caller's headers";
        return error;
    }
    check.invalid(callbackNum != 0 && callbackNum != 3, "allocationCallbacks",
                  "is incomplete, expected allocate, reallocate and free, or none of them");
    check.invalid(!desc.denoisers && desc.denoisersNum > 0, "denoisers", "is null, expected denoisersNum elements");
    check.require(desc.denoisersNum <= 1024, "denoisersNum", desc.denoisersNum, "at most 1024");
    check.enumerator("normalEncoding", desc.normalEncoding);
    check.enumerator("roughnessEncoding", desc.roughnessEncoding);
    check.inside("confidenceTileSize", desc.confidenceTileSize, 0u, 8u);
    error = check.error();
    if (!error) checkDenoisers(error, desc);
    return error;
}
} // namespace nrd
