// Noisy signals of every kind of denoiser, from the same samples.
#pragma once
#include "inputs.h"

namespace options
{
// Fills the input of `slot`, packed as the checkerboard asks, and what it says of each pixel of the rectangle.
void addSignal(const Setup& setup, Frame& frame, nrd::ResourceType slot, int frameIndex);

// Whether a lobe has data in a pixel: diffuse where BLACK or WHITE says, specular on the others, changing places every
// frame.
bool hasData(nrd::CheckerboardMode mode, bool isSpecular, glm::ivec2 pixel, int frameIndex);
} // namespace options
