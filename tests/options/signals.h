// Noisy signals of every kind of denoiser, from the same samples.
#pragma once
#include "inputs.h"

namespace options
{
// Fills the input of `slot`, packed as the checkerboard asks, and what it says of each pixel of the rectangle.
void addSignal(const Setup& setup, Frame& frame, nrd::ResourceType slot, int frameIndex);

// The same for a slot of SIGMA's: a shadow's edge goes down the middle, its penumbra takes half of the width.
void addShadow(const Setup& setup, Frame& frame, nrd::ResourceType slot, int frameIndex);

float meanOf(const Setup& setup, const Frame& frame, glm::ivec2 pixel, int frameIndex);

// Seed of a frame's noise, and whether it is that of the frame before, turned round.
struct Noise
{
    unsigned seed;
    bool isOpposite;
};
Noise noiseOf(const Setup& setup, int frameIndex);

// Two pixels share a texel of a checkerboard, and one of them has data. samples: one per pixel of the rectangle.
Plane packSamples(const Setup& setup, const Frame& frame, nrd::ResourceType slot, int frameIndex, bool isSpecular,
                  const Plane& samples);

// As the format stores it.
glm::vec4 asStored(rhi::Format format, glm::vec4 value);

// Whether a lobe has data in a pixel: diffuse where BLACK or WHITE says, specular on the others, changing places every
// frame.
bool hasData(nrd::CheckerboardMode mode, bool isSpecular, glm::ivec2 pixel, int frameIndex);
} // namespace options
