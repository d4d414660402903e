// Bytes to and from images and buffers; every call waits for the device.
#pragma once
#include "engine/resources.h"

#include <array>

namespace engine
{
/// Fills the whole image, rows from the top without padding; leaves it in the sampled state.
/// Throws Error when `bytes` is not exactly the image.
void upload(const Device& device, Image& image, std::span<const std::byte> bytes);

/// Fills the buffer from its start; throws Error when `bytes` does not fit.
void upload(const Device& device, Buffer& buffer, std::span<const std::byte> bytes);

/// The whole image, rows from the top without padding; the image comes back in the state it was in.
std::vector<std::byte> readBack(const Device& device, Image& image);

/// The whole buffer.
std::vector<std::byte> readBack(const Device& device, const Buffer& buffer);

/// One texel of each of several float images of the same size, in the order of the list; missing components are 0.
/// The images come back in the state they were in.
std::vector<std::array<float, 4>> readTexels(const Device& device, const std::vector<Image*>& images, uint32_t x,
                                             uint32_t y);

/// readBack() as an array of T.
template <class T, class Resource> std::vector<T> readBackAs(const Device& device, Resource& resource)
{
    const std::vector<std::byte> bytes = readBack(device, resource);
    const T* first = reinterpret_cast<const T*>(bytes.data()); // operator new aligns for every T used here
    return std::vector<T>(first, first + bytes.size() / sizeof(T));
}

/// A new device buffer with `bytes` in it.
Buffer createFilled(const Device& device, BufferDesc desc, std::span<const std::byte> bytes);
} // namespace engine
