// The validating decorator: the same interface over any device. It checks arguments, states, lifetimes and descriptors,
// and reports each misuse as one sentence that names the object. A misused call is not passed on; a misused factory
// throws rhi::Error with the same sentence.
// It takes the order of recording for the order of execution, and a submission for pending until its fence was seen
// signalled or waitIdle() returned.
#pragma once
#include <functional>
#include <memory>
#include <rhi/device.h>
#include <string>

namespace rhi
{
using ValidationSink = std::function<void(const std::string& sentence)>; // called from the thread that made the mistake

/// Takes `device` over. Only objects made by the returned device may be used with it. One thread at a time.
std::unique_ptr<Device> makeValidatingDevice(std::unique_ptr<Device> device, ValidationSink sink);
/// Borrows `device`, which must outlive the returned one.
std::unique_ptr<Device> makeValidatingDevice(Device& device, ValidationSink sink);
} // namespace rhi
