// Every fault the doctor knows, put into recorded frames one at a time: it is named, with its cure, and nothing else
// is.
#include "catch.h"
#include "inputs.h"
#include "room.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

namespace fs = std::filesystem;
using nrd::DoctorRule;

namespace
{
using Frames = std::vector<test::FrameInputs>;

struct Fault
{
    const char* name;
    DoctorRule rule;
    const char* sentence; // part of it
    std::function<void(test::FrameInputs&)> put;
    bool isOnScreen = false; // motion is made screen space first
};

void scaleMotion(test::FrameInputs& frame, double x, double y, double z)
{
    for (size_t i = 0; i < frame.motion.size(); i += 4)
    {
        frame.motion[i] *= static_cast<float>(x);
        frame.motion[i + 1] *= static_cast<float>(y);
        frame.motion[i + 2] *= static_cast<float>(z);
    }
}

Fault screenMotion(const char* name, const char* sentence, double x, double y)
{
    return {name, DoctorRule::MOTION, sentence, [=](test::FrameInputs& frame) { scaleMotion(frame, x, y, 1.0); }, true};
}

void mapRoughness(test::FrameInputs& frame, float (*map)(float))
{
    const test::Texels guides = frame.guides;
    for (size_t i = 3; i < frame.guides.size(); i += 4) frame.guides[i] = map(guides[i]);
    const test::Texels specular = frame.specular;
    frame.pack();
    frame.specular = specular; // the renderer normalises with the roughness it means
}

// Writes normals by `map`, which gets view-space rows as well.
void mapNormals(test::FrameInputs& frame,
                const std::function<std::array<float, 3>(const float*, const float (&)[16])>& map)
{
    const test::Texels guides = frame.guides;
    for (size_t i = 0; i < guides.size(); i += 4)
    {
        const std::array<float, 3> n = map(&guides[i], frame.common.worldToViewMatrix);
        std::copy(n.begin(), n.end(), frame.guides.begin() + static_cast<std::ptrdiff_t>(i));
    }
    frame.pack();
}

std::array<float, 3> toView(const float* n, const float (&m)[16])
{
    std::array<float, 3> result = {};
    for (size_t row = 0; row < 3; row++)
        for (size_t column = 0; column < 3; column++) result[row] += m[column * 4 + row] * n[column];
    return result;
}

void multiply(test::Texels& signal, const test::Texels& factor)
{
    for (size_t i = 0; i < signal.size(); i += 4)
        for (size_t c = 0; c < 3; c++) signal[i + c] *= factor[i + c];
}

// From the camera through a pixel, per unit of depth.
double primaryLength(const test::FrameInputs& frame, size_t pixel)
{
    const double x = (double(pixel % frame.width) + 0.5) / double(frame.width) * 2.0 - 1.0;
    const double y = 1.0 - (double(pixel / frame.width) + 0.5) / double(frame.height) * 2.0;
    const double slopeX = x / double(frame.common.viewToClipMatrix[0]);
    const double slopeY = y / double(frame.common.viewToClipMatrix[5]);
    return std::sqrt(1.0 + slopeX * slopeX + slopeY * slopeY);
}

// The distance from the camera comes on top of every hit distance.
void addPrimary(test::FrameInputs& frame, test::Texels& signal)
{
    for (size_t i = 0; i < frame.pixelCount(); i++)
    {
        const double primary = std::abs(double(frame.viewZ[i * 4])) * primaryLength(frame, i);
        float& hitDistance = signal[i * 4 + 3];
        if (hitDistance > 0.0f && hitDistance < sample::kHitDistMiss) hitDistance += static_cast<float>(primary);
    }
    frame.pack();
}

// A window of sky, for scenes that have none: no path begins there.
void openWindow(test::FrameInputs& frame, float viewZ)
{
    for (size_t y = 10; y < 40; y++)
        for (size_t x = 20; x < 90; x++)
        {
            const size_t i = 4 * (y * frame.width + x);
            frame.viewZ[i] = viewZ;
            for (size_t c = 0; c < 4; c++)
                frame.diffuse[i + c] = frame.specular[i + c] = frame.motion[i + c] = frame.specularDirection[i + c] =
                    0.0f;
            for (size_t c = 0; c < 4; c++) frame.diffuseFactor[i + c] = frame.specularFactor[i + c] = 0.0f;
        }
}

void jitterProjection(test::FrameInputs& frame)
{
    const auto put = [&](float(&clip)[16], const float(&jitter)[2])
    {
        clip[8] -= 2.0f * jitter[0] / static_cast<float>(frame.width) * clip[11];
        clip[9] += 2.0f * jitter[1] / static_cast<float>(frame.height) * clip[11];
    };
    put(frame.common.viewToClipMatrix, frame.common.cameraJitter);
    put(frame.common.viewToClipMatrixPrev, frame.common.cameraJitterPrev);
}

std::vector<Fault> settingsFaults()
{
    return {
        {"frame index stands still", DoctorRule::FRAME_INDEX, "stood still at 7",
         [](auto& frame) { frame.common.frameIndex = 7; }},
        {"previous view matrix is the current one", DoctorRule::PREVIOUS_CAMERA,
         "worldToViewMatrixPrev equals the current worldToViewMatrix",
         [](auto& frame) { std::copy_n(frame.common.worldToViewMatrix, 16, frame.common.worldToViewMatrixPrev); }},
        {"camera delta is negated", DoctorRule::PREVIOUS_CAMERA, "negate it",
         [](auto& frame)
         {
             for (double& delta : frame.common.cameraDelta) delta = -delta;
         }},
        {"jitter in the projection", DoctorRule::JITTER_IN_MATRIX, "projection without jitter",
         [](auto& frame) { jitterProjection(frame); }, true},
        {"jitter in the projection instead of the settings", DoctorRule::JITTER_IN_MATRIX, "projection without jitter",
         [](auto& frame)
         {
             jitterProjection(frame);
             for (float* jitter : {frame.common.cameraJitter, frame.common.cameraJitterPrev}) jitter[0] = jitter[1] = 0;
         },
         true},
    };
}

std::vector<Fault> motionFaults()
{
    return {
        screenMotion("screen motion: sign", "looks like current - previous; multiply motionVectorScale by -1", -1, -1),
        screenMotion("screen motion: x flipped", "x flipped; multiply motionVectorScale by (-1; 1)", -1, 1),
        screenMotion("screen motion: y flipped", "y flipped; multiply motionVectorScale by (1; -1)", 1, -1),
        screenMotion("screen motion: pixels",
                     "in pixels instead of uv; multiply motionVectorScale by (0.003125; 0.0055", 320, 180),
        screenMotion("screen motion: negative pixels", "current - previous, in pixels instead of uv", -320, -180),
        screenMotion("screen motion: half", "half as long as it must be; multiply motionVectorScale by 2", 0.5, 0.5),
        screenMotion("screen motion: device coordinates", "y flipped, twice as long", 2, -2),
        {"screen motion said to be world space", DoctorRule::MOTION, "clear isMotionVectorInWorldSpace",
         [](auto& frame) { frame.common.isMotionVectorInWorldSpace = true; }, true},
        {"world motion said to be on screen", DoctorRule::MOTION, "set isMotionVectorInWorldSpace",
         [](auto& frame) { frame.common.isMotionVectorInWorldSpace = false; }},
        {"motion holds jitter", DoctorRule::JITTER_IN_MOTION, "matrices without jitter",
         [](auto& frame)
         {
             for (size_t i = 0; i < frame.motion.size(); i++)
                 if (i % 4 < 2)
                     frame.motion[i] += (frame.common.cameraJitter[i % 4] - frame.common.cameraJitterPrev[i % 4]) /
                                        static_cast<float>(i % 4 ? frame.height : frame.width);
         },
         true},
        {"depth of motion: sign", DoctorRule::MOTION_DEPTH, "multiply motionVectorScale[2] by -1",
         [](auto& frame)
         {
             scaleMotion(frame, 1, 1, -1);
             frame.common.motionVectorScale[2] = 1.0f;
         },
         true},
    };
}

std::vector<Fault> guideFaults()
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    return {
        {"squared roughness", DoctorRule::ROUGHNESS_ENCODING, "GGX alpha",
         [](auto& frame) { mapRoughness(frame, [](float r) { return r * r; }); }},
        {"square root of roughness", DoctorRule::ROUGHNESS_ENCODING, "square root of linear roughness",
         [](auto& frame) { mapRoughness(frame, [](float r) { return std::sqrt(r); }); }},
        {"smoothness", DoctorRule::ROUGHNESS_ENCODING, "1 - smoothness",
         [](auto& frame) { mapRoughness(frame, [](float r) { return 1.0f - r; }); }},
        {"view-space normals", DoctorRule::NORMAL_SPACE, "are in view space",
         [](auto& frame) { mapNormals(frame, toView); }},
        {"view-space normals, depth in half floats", DoctorRule::NORMAL_SPACE, "are in view space",
         [](auto& frame)
         {
             mapNormals(frame, toView);
             test::roundToHalf(frame.viewZ);
         }},
        {"normals that point away", DoctorRule::NORMAL_SPACE, "negate them",
         [](auto& frame) {
             mapNormals(frame, [](const float* n, const auto&) { return std::array{-n[0], -n[1], -n[2]}; });
         }},
        {"normals with y flipped", DoctorRule::NORMAL_SPACE, "y flipped",
         [](auto& frame) {
             mapNormals(frame, [](const float* n, const auto&) { return std::array{n[0], -n[1], n[2]}; });
         }},
        {"plain normals for the octahedral encoding", DoctorRule::NORMAL_ENCODING, "0.5 * n + 0.5",
         [](auto& frame)
         {
             for (size_t i = 0; i < frame.guides.size(); i++)
                 if (i % 4 < 3) frame.normalRoughness[i] = 0.5f * frame.guides[i] + 0.5f;
             frame.specularDirection.assign(frame.pixelCount() * 4, 0.0f); // .z is no roughness now
         }},
        {"octahedral normals for a float encoding", DoctorRule::NORMAL_ENCODING, "packed for R10_G10_B10_A2_UNORM",
         [](auto& frame)
         {
             frame.normalEncoding = nrd::NormalEncoding::RGBA16_SNORM;
             frame.specularDirection.assign(frame.pixelCount() * 4, 0.0f);
         }},
        {"depth buffer", DoctorRule::VIEWZ_ENCODING, "the depth buffer",
         [](auto& frame)
         {
             const auto& clip = frame.common.viewToClipMatrix;
             for (size_t i = 0; i < frame.viewZ.size(); i += 4)
                 frame.viewZ[i] = (clip[10] * frame.viewZ[i] + clip[14]) / (clip[11] * frame.viewZ[i]);
         }},
        {"distance instead of depth", DoctorRule::VIEWZ_ENCODING, "the distance to the camera",
         [](auto& frame)
         {
             for (size_t i = 0; i < frame.pixelCount(); i++)
                 frame.viewZ[i * 4] *= static_cast<float>(primaryLength(frame, i));
         }},
        {"NaN in the motion", DoctorRule::NON_FINITE, "IN_MV holds NaN or infinity in 4 pixels, the first at (50; 100)",
         [](auto& frame) { frame.motion[4 * (100 * frame.width + 50)] = kNan; }},
        {"infinite depth", DoctorRule::NON_FINITE, "sky takes any finite value",
         [](auto& frame) { frame.viewZ[4 * (5 * frame.width + 50)] = kInfinity; }},
        {"sky of depth 0", DoctorRule::SKY_IN_RANGE, "IN_VIEWZ is 0", [](auto& frame) { openWindow(frame, 0.0f); }},
        {"sky within the range", DoctorRule::SKY_IN_RANGE, "viewZ = 500, which is within denoisingRange = 1000",
         [](auto& frame) { openWindow(frame, 500.0f); }},
    };
}

std::vector<Fault> signalFaults()
{
    return {
        {"diffuse radiance with albedo", DoctorRule::ALBEDO_IN_RADIANCE, "IN_DIFF_RADIANCE_HITDIST follows the diffuse",
         [](auto& frame)
         {
             multiply(frame.diffuseSignal, frame.diffuseFactor);
             frame.pack();
         }},
        {"NaN in the radiance", DoctorRule::NON_FINITE, "IN_SPEC_RADIANCE_HITDIST holds NaN",
         [](auto& frame) { frame.specular[4 * (100 * frame.width + 50)] = std::nanf(""); }},
        {"negative radiance", DoctorRule::NEGATIVE_RADIANCE, "negative luma",
         [](auto& frame)
         {
             for (size_t i = 0; i < frame.diffuse.size(); i += 4) frame.diffuse[i] -= 0.2f;
         }},
        {"diffuse hit distance with the primary ray", DoctorRule::HIT_DISTANCE_PRIMARY, "from the primary hit on",
         [](auto& frame)
         {
             frame.hitDistanceParameters.A = 30.0f; // the default ends before most of these distances do
             addPrimary(frame, frame.diffuseSignal);
         }},
        {"diffuse hit distance with the primary ray, beyond what is kept", DoctorRule::HIT_DISTANCE_CONSTANT,
         "hit distance 1 everywhere",
         [](auto& frame)
         {
             frame.hitDistanceParameters.A = 1.0f;
             addPrimary(frame, frame.diffuseSignal);
         }},
        {"specular hit distance with the primary ray", DoctorRule::HIT_DISTANCE_PRIMARY, "IN_SPEC_RADIANCE_HITDIST",
         [](auto& frame) { addPrimary(frame, frame.specularSignal); }},
        {"constant hit distance", DoctorRule::HIT_DISTANCE_CONSTANT, "0.5 everywhere",
         [](auto& frame)
         {
             for (size_t i = 3; i < frame.diffuse.size(); i += 4)
                 if (frame.diffuse[i] > 0.0f) frame.diffuse[i] = 0.5f;
         }},
        {"hit distance in units", DoctorRule::HIT_DISTANCE_SCALE, "above 1",
         [](auto& frame)
         {
             for (size_t i = 3; i < frame.diffuse.size(); i += 4) frame.diffuse[i] = frame.diffuseSignal[i];
         }},
    };
}

void checkFault(const Frames& world, const Frames& screen, const Fault& fault)
{
    Frames frames = fault.isOnScreen ? screen : world;
    for (test::FrameInputs& frame : frames) fault.put(frame);
    const test::Diagnosis diagnosis = test::diagnose(frames);
    INFO(fault.name << '\n' << diagnosis.text());
    CHECK(diagnosis.has(fault.rule));
    CHECK_THAT(diagnosis.text(), containing(fault.sentence));
    for (const test::Diagnosis::Entry& entry : diagnosis.entries) CHECK(entry.rule == fault.rule);
}

void checkFaults(const Frames& world)
{
    Frames screen = world;
    test::toScreenMotion(screen);
    for (const auto& faults : {settingsFaults(), motionFaults(), guideFaults(), signalFaults()})
        for (const Fault& fault : faults) checkFault(world, screen, fault);
}
} // namespace

TEST_CASE("motion of what moves by itself is judged by the last frame's depths", "[golden]")
{
    const fs::path folder = fs::path(NRD_SEQUENCES) / "sun-shadow";
    if (!fs::exists(folder / "capture.json"))
    {
        std::printf("SKIPPED motion in a recorded sequence: it is not here\n");
        return;
    }
    const Frames world = test::readInputs(folder, 10, 6);
    Frames screen = world;
    test::toScreenMotion(screen);
    checkFault(world, screen,
               {"world motion: sign", DoctorRule::MOTION,
                "looks like current - previous; multiply motionVectorScale by -1",
                [](auto& frame) { scaleMotion(frame, -1, -1, -1); }});
}

TEST_CASE("every fault is named, and no other", "[unit]") { checkFaults(test::makeRoom(4, 320, 180)); }

TEST_CASE("every fault of recorded frames is named, and no other", "[golden]")
{
    int count = 0;
    for (const char* name : {"cornell-pan", "roughness-ladder"})
    {
        const fs::path folder = fs::path(NRD_SEQUENCES) / name;
        if (!fs::exists(folder / "capture.json")) continue;
        count++;
        INFO(name);
        checkFaults(test::readInputs(folder, 0, 4));
    }
    if (count == 0) std::printf("SKIPPED faults in the recorded sequences: they are not here\n");
}
