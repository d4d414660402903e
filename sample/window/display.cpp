#include "window/display.h"

#include "engine/transfer.h"
#include "nrd_window_shaders.h"

namespace sample
{
Display::Display(const engine::Device& device, uint32_t width, uint32_t height, uint32_t slotCount)
    : m_picture(device, {"picture", width, height, VK_FORMAT_R8G8B8A8_UNORM}),
      m_black(device, {"black", width, height, VK_FORMAT_R8_UNORM}),
      m_pipeline(createPixelPipeline(device, window::shaderBlob(window::Shader::Display), 4, sizeof(DisplayConstants),
                                     slotCount)),
      m_sets(slotCount, VK_NULL_HANDLE)
{
    const std::vector<std::byte> zeros(m_black.byteSize());
    engine::upload(device, m_black, zeros);
}

void Display::record(VkCommandBuffer cmd, uint32_t slot, const DisplayImages& images, DisplayConstants constants)
{
    std::vector<engine::Binding> bindings;
    for (engine::Image* image : images)
    {
        engine::Image& in = image ? *image : m_black;
        transition(cmd, in, engine::kSampled);
        bindings.emplace_back(in);
    }
    transition(cmd, m_picture, engine::kStorage);
    bindings.emplace_back(m_picture);
    VkDescriptorSet& set = m_sets[slot];
    if (set)
        m_pipeline.writeSet(set, bindings);
    else
        set = m_pipeline.createSet(bindings);
    constants.size = {m_picture.desc().width, m_picture.desc().height};
    dispatchPixels(cmd, m_pipeline, set, constants, constants.size);
}
} // namespace sample
