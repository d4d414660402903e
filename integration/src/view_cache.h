// The application's images as the RHI sees them, with their views, for as long as they keep being used.
#pragma once
#include "retire_queue.h"
#include <nrd/integration.h>
#include <rhi/device.h>

namespace nrd
{
/// Facts that make two user images the same to the cache: a re-created image differs in its generation.
struct ImageKey
{
    VkImage image = VK_NULL_HANDLE;
    uint64_t generation = 0;
    VkFormat format = VK_FORMAT_UNDEFINED;
    uint32_t width = 0;
    uint32_t height = 0;
    VkImageUsageFlags usage = 0;
};
ImageKey keyOf(const NrdUserImage& image);
bool operator==(const ImageKey& a, const ImageKey& b);

class CachedImage final : public Retirable
{
public:
    /// Throws rhi::Error, also if the device cannot use the format as asked.
    CachedImage(rhi::Device& device, const ImageKey& key, const char* name);

    const ImageKey& key() const { return m_key; }
    const rhi::Texture& texture() const { return *m_texture; }
    const rhi::TextureView& view(rhi::Device& device, rhi::ViewType type); // created at its first use

    uint64_t lastFrame = 0; // that used it

private:
    ImageKey m_key;
    std::unique_ptr<rhi::Texture> m_texture;
    std::unique_ptr<rhi::TextureView> m_sampled;
    std::unique_ptr<rhi::TextureView> m_storage;
};

class ViewCache
{
public:
    explicit ViewCache(rhi::Device& device) : m_device(device) {}

    /// The entry of this image, made if there is none; an older generation of the same handle is retired.
    CachedImage& acquire(const NrdUserImage& image, const char* name, uint64_t frame, RetireQueue& queue);
    /// Retires what no frame from `oldestFrame` on has used.
    void collect(uint64_t oldestFrame, RetireQueue& queue);
    void forget(VkImage image, RetireQueue& queue);
    uint32_t size() const { return static_cast<uint32_t>(m_images.size()); }
    /// Changes when a view goes, of these or, by outdate(), of the pools: a new one may have its address.
    uint64_t generation() const { return m_generation; }
    void outdate() { m_generation++; }

private:
    template <class Predicate> void retireIf(Predicate predicate, RetireQueue& queue);

    rhi::Device& m_device;
    std::vector<std::unique_ptr<CachedImage>> m_images;
    uint64_t m_generation = 0;
};
} // namespace nrd
