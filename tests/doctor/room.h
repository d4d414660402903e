// A path tracer's first frames in closed form: a camera that turns inside a box, for tests that need no files. View
// space has z backwards, depth is reversed and infinite, every other quarter of a surface is dark.
#pragma once
#include "inputs.h"

namespace test
{
std::vector<FrameInputs> makeRoom(size_t frameCount, size_t width, size_t height);
} // namespace test
