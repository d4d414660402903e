// A room with a light that is switched off: what the sample shows frame by frame, held against a reference of the room
// after the switch.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

namespace confidence
{
constexpr uint32_t kSwitchFrame = 32; // the first without the light
constexpr uint32_t kFramesAfter = 36;

struct FrameFigures
{
    double rmse = 0.0;                                 // of the composed, tone-mapped picture, as PSNR takes it
    double flip = 0.0;                                 // of the composed picture
    std::optional<double> diffuse = {}, specular = {}; // mean confidence; nullopt without
};
using Frames = std::vector<FrameFigures>; // errors count from kSwitchFrame on, before they are 0

struct Comparison
{
    const char* denoiser = "";
    Frames with, without; // confidence
    Frames restarted;     // from the switch on, without what was before it
};

struct Room
{
    bool hasLamp = false;  // the ceiling shines on, a noisy light
    float strength = 1.0f; // of the light that goes off; 1 is most of all light, 0.1 less than a tenth where the lamp is
};

// On the same noise.
std::vector<Comparison> runSwitchedLight(const Room& room);
} // namespace confidence
