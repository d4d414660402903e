#include "filter.h"

#include <algorithm>
#include <cmath>

namespace sample
{
namespace
{
// Tap by tap over whole rows: the inner loops are straight additions, which the compiler vectorises.
void addScaled(float* sum, const float* values, float weight, int count)
{
    for (int i = 0; i < count; i++) sum[i] += weight * values[i];
}
} // namespace

Kernel gaussian(double sigma, int radius)
{
    Kernel kernel;
    double sum = 0.0;
    for (int x = -radius; x <= radius; x++) sum += std::exp(-0.5 * x * x / (sigma * sigma));
    for (int x = -radius; x <= radius; x++)
        kernel.push_back(static_cast<float>(std::exp(-0.5 * x * x / (sigma * sigma)) / sum));
    return kernel;
}

Plane convolve(const Plane& plane, int width, int height, const Kernel& horizontal, const Kernel& vertical)
{
    const int radiusX = static_cast<int>(horizontal.size() / 2);
    const int radiusY = static_cast<int>(vertical.size() / 2);
    Plane rows(plane.size(), 0.0f);
    Plane padded(static_cast<size_t>(width + 2 * radiusX));
    for (int y = 0; y < height; y++)
    {
        const float* source = plane.data() + static_cast<size_t>(y) * width;
        std::fill_n(padded.begin(), radiusX, source[0]);
        std::copy_n(source, width, padded.begin() + radiusX);
        std::fill_n(padded.begin() + radiusX + width, radiusX, source[width - 1]);
        for (size_t t = 0; t < horizontal.size(); t++)
            addScaled(rows.data() + static_cast<size_t>(y) * width, padded.data() + t, horizontal[t], width);
    }
    Plane result(plane.size(), 0.0f);
    for (int y = 0; y < height; y++)
    {
        for (int t = -radiusY; t <= radiusY; t++)
        {
            const size_t row = static_cast<size_t>(std::clamp(y + t, 0, height - 1));
            addScaled(result.data() + static_cast<size_t>(y) * width, rows.data() + row * width,
                      vertical[static_cast<size_t>(t + radiusY)], width);
        }
    }
    return result;
}
} // namespace sample
