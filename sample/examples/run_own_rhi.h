// Frames of the noisy wall through OwnRhi, on a device that is made for it.
#pragma once
#include "own_rhi.h"

namespace example
{
/// Both outputs of the last frame, diffuse first.
std::vector<float> denoiseWall(const ShaderSource& source = embeddedShader);
} // namespace example
