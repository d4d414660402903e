// What the device's memory can do.
#pragma once
#include "engine/device.h"

namespace sample::bench
{
// Bytes read and written per second by the faster of a buffer copy and a copying compute shader, far beyond any cache;
// 0 on a queue without timestamps. Throws engine::Error.
double measureCopyBandwidth(const engine::Device& device);
} // namespace sample::bench
