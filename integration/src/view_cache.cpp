#include "view_cache.h"
#include "refusal.h"
#include <rhi/vulkan.h>

namespace nrd
{
namespace
{
rhi::TextureUsage usageOf(const rhi::Device& device, const ImageKey& key)
{
    rhi::TextureUsage result = rhi::TextureUsage::None;
    if (key.usage & VK_IMAGE_USAGE_SAMPLED_BIT) result |= rhi::TextureUsage::Sampled;
    if (key.usage & VK_IMAGE_USAGE_STORAGE_BIT) result |= rhi::TextureUsage::Storage;
    if (key.usage != 0) return result;
    const rhi::FormatSupport support = device.formatSupport(rhi::fromVulkan(key.format));
    if (rhi::hasAny(support, rhi::FormatSupport::Sampled)) result |= rhi::TextureUsage::Sampled;
    if (rhi::hasAny(support, rhi::FormatSupport::Storage)) result |= rhi::TextureUsage::Storage;
    return result;
}
} // namespace

ImageKey keyOf(const NrdUserImage& image)
{
    return {image.image, image.generation, image.format, image.width, image.height, image.usage};
}

bool operator==(const ImageKey& a, const ImageKey& b)
{
    return a.image == b.image && a.generation == b.generation && a.format == b.format && a.width == b.width &&
           a.height == b.height && a.usage == b.usage;
}

CachedImage::CachedImage(rhi::Device& device, const ImageKey& key, const char* name) : m_key(key)
{
    rhi::TextureDesc desc;
    desc.format = rhi::fromVulkan(key.format);
    desc.width = key.width;
    desc.height = key.height;
    desc.usage = usageOf(device, key);
    desc.name = name;
    m_texture = rhi::wrapVulkanTexture(device, key.image, desc);
}

const rhi::TextureView& CachedImage::view(rhi::Device& device, rhi::ViewType type)
{
    std::unique_ptr<rhi::TextureView>& view = type == rhi::ViewType::Storage ? m_storage : m_sampled;
    if (view) return *view;
    const bool isStorage = type == rhi::ViewType::Storage;
    const rhi::FormatSupport needed = isStorage ? rhi::FormatSupport::Storage : rhi::FormatSupport::Sampled;
    if (!rhi::hasAll(device.formatSupport(m_texture->desc().format), needed))
        throw Refusal(Result::UNSUPPORTED,
                      sentence("%s: this device cannot use %s as a %s image", m_texture->name(),
                               rhi::formatInfo(m_texture->desc().format).name, isStorage ? "storage" : "sampled"));
    view = device.createView(*m_texture, {type, {0, 1}});
    return *view;
}

template <class Predicate> void ViewCache::retireIf(Predicate predicate, RetireQueue& queue)
{
    for (size_t i = 0; i < m_images.size();)
    {
        if (!predicate(*m_images[i]))
        {
            i++;
            continue;
        }
        const uint64_t frame = m_images[i]->lastFrame;
        queue.reserve(1); // before anything moves
        queue.retire(frame, std::move(m_images[i]));
        m_images[i] = std::move(m_images.back());
        m_images.pop_back();
        outdate();
    }
}

CachedImage& ViewCache::acquire(const NrdUserImage& image, const char* name, uint64_t frame, RetireQueue& queue)
{
    const ImageKey key = keyOf(image);
    bool isReplaced = false;
    for (const std::unique_ptr<CachedImage>& cached : m_images)
    {
        if (cached->key() == key)
        {
            cached->lastFrame = frame;
            return *cached;
        }
        isReplaced |= cached->key().image == key.image && cached->key().generation != key.generation;
    }
    if (isReplaced)
        retireIf([&key](const CachedImage& cached)
                 { return cached.key().image == key.image && cached.key().generation != key.generation; },
                 queue);
    m_images.push_back(std::make_unique<CachedImage>(m_device, key, name));
    m_images.back()->lastFrame = frame;
    return *m_images.back();
}

void ViewCache::collect(uint64_t oldestFrame, RetireQueue& queue)
{
    retireIf([oldestFrame](const CachedImage& cached) { return cached.lastFrame < oldestFrame; }, queue);
}

void ViewCache::forget(VkImage image, RetireQueue& queue)
{
    retireIf([image](const CachedImage& cached) { return cached.key().image == image; }, queue);
}
} // namespace nrd
