// Floors seen from above, the runs that denoise their shadows, and what is measured in them.
#pragma once
#include "light.h"
#include <measures.h>

namespace shadow
{
constexpr nrd::Denoiser kBoth[] = {nrd::Denoiser::SIGMA_SHADOW, nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY};
constexpr float kVisibleMeters = 6.0f; // of the floor from top to bottom, in the view from above

float pixelSizeOf(glm::ivec2 size); // metres, in the view from above

// Straight down on the floor y = 0, without perspective: X is right, Z up.
options::Setup makeSetup(nrd::Denoiser denoiser, glm::ivec2 size, const Light& light, const Occluder& occluder);
void hideLight(options::Setup& setup); // from the settings
void lookAlong(options::Setup& setup); // in place of straight down: over the floor, in perspective

// Unpacked: visibility, colour.
glm::vec4 shadowOf(const options::Result& result, size_t texel);
glm::vec4 noisyOf(const options::Result& result, size_t pixel);

using Truth = std::function<double(glm::vec3 P)>; // visible share

struct Errors
{
    double denoised, noisy; // root mean square of visibility
};
Errors measureErrors(const options::Result& result, const Truth& truth);

// Means over columns from the left to the right, of rows from the first on.
struct Rows
{
    int first, count;
};
std::vector<double> denoisedProfile(const options::Result& result, Rows rows);
std::vector<double> trueProfile(const options::Result& result, Rows rows, const Truth& truth);
double widthOf(const std::vector<double>& profile); // pixels from 10 % to 90 %
} // namespace shadow
