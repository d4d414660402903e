// Pictures as separate planes of floats, which is what filters want, and the mask of pixels that count.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sample
{
// Row 0 on top. A radiance has 3 planes, a scalar 1; no plane: the quantity does not exist.
struct Picture
{
    int width = 0;
    int height = 0;
    std::vector<std::vector<float>> planes;

    Picture() = default;
    Picture(int w, int h, size_t planeCount)
        : width(w), height(h), planes(planeCount, std::vector<float>(static_cast<size_t>(w) * static_cast<size_t>(h)))
    {
    }
    size_t pixelCount() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    bool exists() const { return !planes.empty(); }
};

// One byte per pixel, not 0 where the pixel counts. Empty: all pixels count.
using Mask = std::vector<uint8_t>;

inline bool counts(const Mask& mask, size_t pixel) { return mask.empty() || mask[pixel] != 0; }
} // namespace sample
