#include "setup.h"
#include <algorithm>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>

namespace options
{
namespace
{
constexpr float kNear = 0.05f, kFar = 500.0f;

glm::mat4 makeProjection(Projection projection, float fovY, float aspect)
{
    constexpr float kOrthographicHeight = 3.0f; // half
    constexpr float kWidth = kOrthographicHeight;
    const glm::mat4 usual = glm::perspectiveLH_ZO(fovY, aspect, kNear, kFar);
    glm::mat4 infinite = usual;
    switch (projection)
    {
    case Projection::Perspective:
        return usual;
    case Projection::Reversed:
        return glm::perspectiveLH_ZO(fovY, aspect, kFar, kNear);
    case Projection::Infinite:
        infinite[2][2] = 1.0f;
        infinite[3][2] = -kNear;
        return infinite;
    case Projection::ReversedInfinite:
        infinite[2][2] = 0.0f;
        infinite[3][2] = kNear;
        return infinite;
    case Projection::Orthographic:
        return glm::orthoLH_ZO(-kWidth * aspect, kWidth * aspect, -kWidth, kWidth, 0.0f, kFar);
    }
    return usual;
}

// Four positions, so that the mean lies in the pixel's centre.
glm::vec2 jitterOf(int frame)
{
    const glm::vec2 positions[4] = {{-0.25f, 0.25f}, {0.25f, -0.125f}, {-0.125f, -0.25f}, {0.125f, 0.125f}};
    return positions[frame & 3];
}

void copy(float (&out)[16], const glm::mat4& matrix) { std::memcpy(out, glm::value_ptr(matrix), sizeof(out)); }

void copy(uint16_t (&out)[2], glm::ivec2 size)
{
    out[0] = static_cast<uint16_t>(size.x);
    out[1] = static_cast<uint16_t>(size.y);
}

void copy(double (&out)[3], const glm::dvec3& v)
{
    for (int i = 0; i < 3; i++) out[i] = v[i];
}

glm::dvec3 positionOf(const View& view)
{
    return glm::dvec3(glm::inverse(glm::dmat4(view.camera.worldToView))[3]); // without the origin, which is far
}

// In units, as the application keeps it in double precision.
glm::dvec3 findCameraDelta(const Setup& setup, const View& now, const View& before, int frames)
{
    const glm::dvec3 scene = glm::dvec3(setup.sceneVelocity) * double(frames);
    return (positionOf(before) - positionOf(now) - scene) * double(setup.unitsPerMeter);
}

void setMotion(const Setup& setup, nrd::CommonSettings& common)
{
    const float scale = 1.0f / setup.motionFactor;
    common.isMotionVectorInWorldSpace = setup.motion == MotionKind::World;
    common.motionVectorScale[0] = common.motionVectorScale[1] = common.motionVectorScale[2] = scale;
    if (setup.motion == MotionKind::World) return;
    common.motionVectorScale[0] = scale / static_cast<float>(setup.rect.x);
    common.motionVectorScale[1] = scale / static_cast<float>(setup.rect.y);
    if (setup.motion == MotionKind::Screen) common.motionVectorScale[2] = 0.0f;
}
} // namespace

Family familyOf(nrd::Denoiser denoiser)
{
    const std::string_view name = nrd::toString(denoiser);
    if (name.starts_with("REBLUR_")) return Family::Reblur;
    if (name.starts_with("RELAX_")) return Family::Relax;
    return name.starts_with("SIGMA_") ? Family::Sigma : Family::Reference;
}

nrd::CheckerboardMode checkerboardOf(const Setup& setup)
{
    switch (familyOf(setup.denoiser))
    {
    case Family::Reblur:
        return setup.settings.checkerboardMode;
    case Family::Relax:
        return setup.relaxSettings.checkerboardMode;
    case Family::Sigma:
        return setup.sigmaSettings.checkerboardMode;
    case Family::Reference:
        break;
    }
    return nrd::CheckerboardMode::OFF;
}

void setCheckerboard(Setup& setup, nrd::CheckerboardMode mode)
{
    setup.changeSettings([mode](auto& s) { s.checkerboardMode = mode; });
    setup.sigmaSettings.checkerboardMode = mode;
}

uint32_t guideDivisor(const Setup& setup)
{
    return setup.fullSize == nrd::FullSize::NOTHING ? setup.resolutionDivisor : 1;
}

glm::ivec2 rectOf(const Setup& setup, int frame)
{
    if (!setup.isRectVarying) return setup.rect;
    constexpr float kShares[4] = {1.0f, 0.8f, 0.67f, 0.9f};
    return glm::max(glm::ivec2(glm::vec2(setup.rect) * kShares[frame & 3]), glm::ivec2(1));
}

glm::ivec2 pixelsOf(const Setup& setup, int frame)
{
    const glm::ivec2 rect = rectOf(setup, frame);
    return {divideUp(rect.x, guideDivisor(setup)), divideUp(rect.y, guideDivisor(setup))};
}

View makeView(const Setup& setup, int frame)
{
    View view;
    view.camera =
        setup.camera ? setup.camera(frame) : quality::makeCamera(frame, setup.speed, setup.rect.x, setup.rect.y);
    const float aspect = static_cast<float>(setup.rect.x) / static_cast<float>(setup.rect.y);
    view.camera.viewToClip = makeProjection(setup.projection, setup.fovY, aspect);
    if (setup.isJittered) view.jitter = jitterOf(frame);

    view.viewToClip = view.camera.viewToClip;
    view.viewToClip[3][2] *= setup.unitsPerMeter;
    const glm::dvec3 origin = setup.worldOrigin + glm::dvec3(setup.sceneVelocity * static_cast<float>(frame));
    view.worldToView = glm::translate(glm::dmat4(view.camera.worldToView), -origin);
    view.worldToView[3] = glm::vec4(glm::vec3(view.worldToView[3]) * setup.unitsPerMeter, 1.0f);
    if (!setup.isRightHanded) return view;
    view.viewToClip[2] = -view.viewToClip[2];
    for (int column = 0; column < 4; column++) view.worldToView[column].z = -view.worldToView[column].z;
    return view;
}

quality::Guides renderView(const Setup& setup, const View& view, int frame)
{
    const glm::ivec2 pixels = pixelsOf(setup, frame);
    // The scene is traced with a finite projection of the same frustum; a shifted one samples where the jitter says.
    quality::Camera camera = view.camera;
    const bool isOrthographic = setup.projection == Projection::Orthographic;
    const float aspect = static_cast<float>(setup.rect.x) / static_cast<float>(setup.rect.y);
    if (!isOrthographic) camera.viewToClip = makeProjection(Projection::Perspective, setup.fovY, aspect);
    const glm::vec2 shift = 2.0f * view.jitter / glm::vec2(rectOf(setup, frame));
    const int column = isOrthographic ? 3 : 2;
    camera.viewToClip[column][0] -= shift.x;
    camera.viewToClip[column][1] += shift.y;
    return setup.scene ? setup.scene(camera, pixels, frame) : quality::renderGuides(camera, pixels.x, pixels.y);
}

nrd::CommonSettings makeCommon(const Setup& setup, int frame, bool isFirst)
{
    const int previous = isFirst ? frame : frame - 1;
    const View view = makeView(setup, frame), before = makeView(setup, previous);
    nrd::CommonSettings common;
    copy(common.viewToClipMatrix, view.viewToClip);
    copy(common.viewToClipMatrixPrev, before.viewToClip);
    copy(common.worldToViewMatrix, view.worldToView);
    copy(common.worldToViewMatrixPrev, before.worldToView);
    setMotion(setup, common);
    for (int i = 0; i < 2; i++)
    {
        common.cameraJitter[i] = view.jitter[i];
        common.cameraJitterPrev[i] = before.jitter[i];
    }
    copy(common.resourceSize, setup.size);
    copy(common.resourceSizePrev, setup.size);
    copy(common.rectSize, rectOf(setup, frame));
    copy(common.rectSizePrev, rectOf(setup, previous));
    copy(common.rectOrigin, setup.origin);
    common.metersToUnits = setup.unitsPerMeter;
    common.viewZScale = 1.0f / std::abs(setup.viewZFactor);
    common.denoisingRange = setup.denoisingRange * setup.unitsPerMeter;
    common.timeDeltaBetweenFrames = 16.667f;
    common.frameIndex = static_cast<uint32_t>(frame);
    common.isHistoryConfidenceAvailable = setup.confidence.has_value();
    common.isDisocclusionThresholdMixAvailable = setup.thresholdMix.has_value();
    common.isSpecularMotionAvailable = setup.reflectionMotionAt != nullptr;
    common.isCameraDeltaAvailable = setup.isCameraDeltaGiven;
    if (setup.isCameraDeltaGiven) copy(common.cameraDelta, findCameraDelta(setup, view, before, frame - previous));
    if (setup.changeCommon) setup.changeCommon(common, frame);
    return common;
}
} // namespace options
