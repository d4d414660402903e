// What tests of the sample's own stages run on.
#pragma once
#include "image_io.h"
#include "measures.h"

#include "engine/device.h"

namespace test
{
/// One for the program, with validation on; what was reported is the caller's to look at.
engine::Device& sampleDevice();

sample::Picture toPicture(const sample::Image& image);
} // namespace test
