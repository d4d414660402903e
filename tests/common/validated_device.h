// The device of the GPU tests, under validation and synchronisation validation. NRD_TEST_DEVICE (index or part of a
// name) picks it; NRD_TEST_NO_VALIDATION turns the layers off where they are not installed.
#pragma once
#include <rhi/rhi.h>

namespace test
{
rhi::Device& validatedDevice(); // one for the whole process

// Submits and waits.
void submitAndWait(rhi::CommandBuffer& commands);

// Every message of the layers since the last call fails the running test case.
void failOnMessages();
} // namespace test
