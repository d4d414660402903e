// A room under a lamp and a strong light that is switched off: what the sample shows frame by frame, held against a
// reference of the room after the switch.
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
};

// On the same noise.
std::vector<Comparison> runSwitchedLight();
} // namespace confidence
