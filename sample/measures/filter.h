// Separable convolution with edge pixels replicated.
#pragma once
#include <vector>

namespace sample
{
using Plane = std::vector<float>;

// Odd number of weights; weight i belongs to the offset i - size / 2.
using Kernel = std::vector<float>;

// exp(-x^2 / (2 sigma^2)), normalised to sum 1.
Kernel gaussian(double sigma, int radius);

// The plane filtered along its rows by `horizontal` and along its columns by `vertical`.
Plane convolve(const Plane& plane, int width, int height, const Kernel& horizontal, const Kernel& vertical);
} // namespace sample
