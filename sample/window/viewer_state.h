// All that a user can turn, as plain data: panel, script and keys write it, the viewer follows.
#pragma once
#include "options.h"
#include "window/camera_control.h"
#include "window/sun.h"

namespace sample
{
/// What one side of the split is denoised with.
struct Side
{
    DenoiserSet set;
    std::vector<Assignment> settings; // those that differ from the defaults
    Resolution resolution = {};
};

/// Replaces the assignment of that key, or adds it.
void assign(std::vector<Assignment>& settings, const Assignment& assignment);
void unassign(std::vector<Assignment>& settings, const std::string& key);

/// What a panel shows of a set: fields with a group, each once.
std::vector<SettingField> panelFields(ReplaySettings& settings, const DenoiserSet& set);

struct ViewerState
{
    std::array<Side, 2> sides; // A, left of the split, and B
    bool isCompared = false;   // B runs, too
    float split = 0.5f;        // [0; 1], share of the picture's width

    size_t view = 0;                  // of views()
    float exposure = 0.0f;            // powers of two
    uint32_t tone = 0;                // TONE_...
    float range = 1.0f;               // factor for values that are no light
    std::optional<glm::ivec2> picked; // pixel of the picture

    bool isPaused = false;
    uint32_t steps = 0;       // frames to render while paused
    bool isRestarted = false; // the next frame has no history
    bool hasReference = false;
    uint32_t referenceSamples = 1; // per frame, [1; 16]

    CameraMode cameraMode = CameraMode::Scene;
    CameraControl camera;
    float animationSpeed = 1.0f; // [0; 4]
    SunAngles sun;
    float environmentTurn = 0.0f; // degrees

    uint32_t bounces = 4;    // [1; 64]
    float roughening = 0.5f; // [0; 1]
    bool hasJitter = false;
    bool hasTemporalAa = false;
    bool hasPsr = false; // mirrors are followed
    bool hasConfidence = false;
    Lobes lobes = Lobes::Both;
    nrd::CheckerboardMode checkerboard = nrd::CheckerboardMode::OFF;
};
} // namespace sample
