// The textures and buffers that the descriptor library asks for, at one resource size.
#pragma once
#include "retire_queue.h"
#include "state_tracker.h"
#include <nrd/descs.h>
#include <rhi/device.h>
#include <string>

namespace nrd
{
struct PoolsDesc
{
    const char* name = ""; // of the integration: prefix of debug names and memory tags
    uint32_t width = 1;    // pixels, resource size
    uint32_t height = 1;
};

/// One block of memory with its textures and the views of each.
class TexturePool
{
public:
    /// `letter` names them: "NRD P(0)". Throws rhi::Error.
    TexturePool(rhi::Device& device, const PoolsDesc& desc, const TextureDesc* textures, uint32_t textureCount,
                char letter);

    uint32_t size() const { return static_cast<uint32_t>(m_slots.size()); }
    uint64_t byteSize() const { return m_byteSize; }
    const rhi::Texture& texture(uint32_t index) const { return *m_slots[index].texture; }
    const rhi::TextureView& view(uint32_t index, rhi::ViewType type) const
    {
        return type == rhi::ViewType::Storage ? *m_slots[index].storage : *m_slots[index].sampled;
    }

private:
    struct Slot
    {
        std::unique_ptr<rhi::Texture> texture;
        std::unique_ptr<rhi::TextureView> sampled;
        std::unique_ptr<rhi::TextureView> storage;
    };
    std::unique_ptr<rhi::Memory> m_memory; // empty if no memory type serves all of them
    std::vector<Slot> m_slots;
    uint64_t m_byteSize = 0; // as the driver asked for
};

class Pools final : public Retirable
{
public:
    Pools(rhi::Device& device, const PoolsDesc& desc, const InstanceDesc& instance);

    const TexturePool& permanent() const { return m_permanent; }
    const TexturePool& transient() const { return m_transient; }
    const rhi::Buffer& buffer(uint32_t index) const { return *m_buffers[index]; }

    /// Textures: permanent, then transient, then one for each slot of the user pool.
    StateTracker states;
    std::vector<rhi::BufferState> bufferStates;

private:
    TexturePool m_permanent;
    TexturePool m_transient;
    std::vector<std::unique_ptr<rhi::Buffer>> m_buffers;
};

/// Line of the device's memory report: "NRD permanent", "NRD transient", "NRD constants", "NRD buffers".
std::string memoryTag(const char* name, const char* part);
} // namespace nrd
