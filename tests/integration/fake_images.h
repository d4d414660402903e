// User pools over a device that never looks at an image: any number serves as a handle. Without the test framework.
#pragma once
#include <nrd/integration.h>

namespace test
{
/// Every slot that the denoiser reads or writes under its present settings, the optional ones too, in the state of a
/// new image. The size is the resource size.
void fillSlots(const nrd::NrdIntegration& integration, nrd::Identifier identifier, uint32_t width, uint32_t height,
               nrd::NrdUserPool& pool);
} // namespace test
