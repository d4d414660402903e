#include "checker.h"
#include <cfloat>
#include <cmath>

namespace nrd
{
namespace
{
constexpr uint32_t kNoMaterial = 999;
constexpr float kHuge = FLT_MAX;

void checkFinite(Checker& check, const char* field, const float (&matrix)[16])
{
    for (int i = 0; i < 16; i++) check.require(std::isfinite(matrix[i]), field, matrix[i], "a finite number", i);
}

// x' = a x + b z (or + b), y' likewise; w = +-z or 1, which a transposed matrix does not have.
void checkProjection(Checker& check, const char* field, const float (&m)[16])
{
    checkFinite(check, field, m);
    if (!check.isClean()) return;
    double largest = 0.0;
    for (float element : m) largest = std::fmax(largest, std::fabs(element));
    check.invalid(largest == 0.0, field, "is zero, expected an invertible projection");

    const auto isSmall = [](double a, double b) { return std::fabs(a) <= 1e-6 * std::fabs(b); };
    const auto isUnit = [](double a) { return std::fabs(std::fabs(a) - 1.0) <= 1e-3; };
    const bool isPerspective = isUnit(m[11]) && isSmall(m[15], 1.0);
    const bool isOrthographic = m[11] == 0.0f && isUnit(m[15]) && m[15] > 0.0f;
    const bool isShifted = isPerspective ? m[12] != 0.0f || m[13] != 0.0f : m[8] != 0.0f || m[9] != 0.0f;
    const bool isSheared = !isSmall(m[4], m[0]) || !isSmall(m[1], m[5]) || m[3] != 0.0f || m[7] != 0.0f;
    check.invalid(!isPerspective && !isOrthographic, field,
                  "is no projection, expected w = z or -z (perspective) or w = 1 (orthographic); is it transposed?");
    check.invalid(m[0] == 0.0f || m[5] == 0.0f, field, "is singular, expected an invertible projection");
    check.invalid(isSheared || isShifted, field, "is sheared, expected a perspective or orthographic projection");
    check.invalid(m[5] < 0.0f, field, "has a negative y scale, expected clip space with Y up");
    // Depth is d = (m[10] z + m[14]) / w: constant in z if the second coefficient (the first, without w) is 0.
    check.invalid((isPerspective && m[14] == 0.0f) || (isOrthographic && m[10] == 0.0f), field,
                  "is singular in depth, expected an invertible projection");
}

// Rotation, with or without a mirrored axis, and translation: the inverse is taken as the transpose.
void checkView(Checker& check, const char* field, const float (&m)[16])
{
    constexpr double kTolerance = 1e-2;
    checkFinite(check, field, m);
    if (!check.isClean()) return;
    for (int a = 0; a < 3; a++)
    {
        for (int b = 0; b <= a; b++)
        {
            double dot = 0.0;
            for (int row = 0; row < 3; row++) dot += static_cast<double>(m[a * 4 + row]) * m[b * 4 + row];
            check.invalid(std::fabs(dot - (a == b ? 1.0 : 0.0)) > kTolerance, field,
                          "has scale or shear or is singular, expected rotation and translation");
        }
    }
    const bool isAffine = m[3] == 0.0f && m[7] == 0.0f && m[11] == 0.0f && m[15] == 1.0f;
    check.invalid(!isAffine, field, "has a last row that is not 0 0 0 1; is it transposed?");
}

void checkSizes(Checker& check, const CommonSettings& s)
{
    for (int i = 0; i < 2; i++)
    {
        const uint32_t resource = s.resourceSize[i], rect = s.rectSize[i], origin = s.rectOrigin[i];
        const uint32_t resourcePrev = s.resourceSizePrev[i], rectPrev = s.rectSizePrev[i];
        check.require(resource > 0, "resourceSize", resource, ">= 1", i);
        check.require(resourcePrev > 0, "resourceSizePrev", resourcePrev, ">= 1", i);
        check.require(rect > 0, "rectSize", rect, ">= 1", i);
        check.require(rectPrev > 0, "rectSizePrev", rectPrev, ">= 1", i);
        check.require(rect <= resource, "rectSize", rect, "at most resourceSize", i);
        check.require(rectPrev <= resourcePrev, "rectSizePrev", rectPrev, "at most resourceSizePrev", i);
        check.require(origin + rect <= resource, "rectOrigin", origin, "rectOrigin + rectSize at most resourceSize", i);
    }
}

void checkMotion(Checker& check, const CommonSettings& s)
{
    for (int i = 0; i < 3; i++)
    {
        const float scale = s.motionVectorScale[i];
        check.require(std::isfinite(scale), "motionVectorScale", scale, "a finite number", i);
        const bool isNeeded = i < 2 && !s.isMotionVectorInWorldSpace;
        check.require(!isNeeded || scale != 0.0f, "motionVectorScale", scale, "not 0 unless in world space", i);
    }
    for (int i = 0; i < 2; i++)
    {
        check.inside("cameraJitter", s.cameraJitter[i], -0.5f, 0.5f, i);
        check.inside("cameraJitterPrev", s.cameraJitterPrev[i], -0.5f, 0.5f, i);
    }
    for (int i = 0; i < 3 && s.isCameraDeltaAvailable; i++)
    {
        check.require(std::isfinite(s.cameraDelta[i]), "cameraDelta", s.cameraDelta[i], "a finite number", i);
    }
}

void checkScalars(Checker& check, const CommonSettings& s)
{
    check.aboveUpTo("metersToUnits", s.metersToUnits, 0.0f, kHuge);
    check.aboveUpTo("viewZScale", s.viewZScale, 0.0f, kHuge);
    check.inside("timeDeltaBetweenFrames", s.timeDeltaBetweenFrames, 0.0f, kHuge);
    check.aboveUpTo("denoisingRange", s.denoisingRange, 0.0f, kHuge);
    check.aboveUpTo("disocclusionThreshold", s.disocclusionThreshold, 0.0f, 1.0f);
    check.aboveUpTo("disocclusionThresholdAlternate", s.disocclusionThresholdAlternate, 0.0f, 1.0f);
    check.aboveUpTo("strandThickness", s.strandThickness, 0.0f, kHuge);
    check.inside("splitScreen", s.splitScreen, 0.0f, 1.0f);
    check.enumerator("accumulationMode", s.accumulationMode);
}

void checkMaterial(Checker& check, const char* field, uint32_t id, NormalEncoding encoding)
{
    const bool hasIds = encoding == NormalEncoding::R10_G10_B10_A2_UNORM;
    check.require(id == kNoMaterial || hasIds, field, id, "999 (none): only R10_G10_B10_A2_UNORM carries material IDs");
}
} // namespace

Error findError(const CommonSettings& s, NormalEncoding normalEncoding)
{
    Checker check("CommonSettings");
    checkProjection(check, "viewToClipMatrix", s.viewToClipMatrix);
    checkProjection(check, "viewToClipMatrixPrev", s.viewToClipMatrixPrev);
    checkView(check, "worldToViewMatrix", s.worldToViewMatrix);
    checkView(check, "worldToViewMatrixPrev", s.worldToViewMatrixPrev);
    checkMotion(check, s);
    checkSizes(check, s);
    checkScalars(check, s);
    checkMaterial(check, "cameraAttachedReflectionMaterialID", s.cameraAttachedReflectionMaterialID, normalEncoding);
    checkMaterial(check, "strandMaterialID", s.strandMaterialID, normalEncoding);
    checkMaterial(check, "historyFixAlternatePixelStrideMaterialID", s.historyFixAlternatePixelStrideMaterialID,
                  normalEncoding);
    return check.error();
}
} // namespace nrd
