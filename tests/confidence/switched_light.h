// A room with a lamp in the ceiling and a strong light that is switched off: what the sample shows frame by frame, held
// against a reference of the room after the switch.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace confidence
{
constexpr uint32_t kSwitchFrame = 40; // the first without the light
constexpr uint32_t kFramesAfter = 40;

struct FrameFigures
{
    double rmse = 0.0;                                  // of the composed, tone-mapped picture, as PSNR takes it
    double flip = 0.0;                                  // of the composed picture
    std::optional<double> diffuse = {}, specular = {};  // mean confidence; nullopt without
};

// By denoiser, in the order of the names; then by frame. Errors count from kSwitchFrame on, before they are 0.
std::vector<std::vector<FrameFigures>> runSwitchedLight(const std::string& denoisers, bool hasConfidence);
} // namespace confidence
