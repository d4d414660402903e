// Workers that start at one moment on threads of their own, and then again one after the other.
#pragma once
#include <cstdint>
#include <functional>

namespace test
{
constexpr uint32_t kWorkerNum = 4;

using Work = std::function<uint64_t(uint32_t worker)>; // gives a digest of all that it saw

/// Every worker saw side by side what it sees alone. The threads come first: what the libraries might set up at their
/// first use, they set up then.
void requireUndisturbed(const Work& work);
} // namespace test
