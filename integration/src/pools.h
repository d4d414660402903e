// The textures and buffers that the descriptor library asks for, at one resource size.
#pragma once
#include "memory_source.h"
#include "retire_queue.h"
#include "state_tracker.h"
#include <nrd/integration.h>
#include <rhi/device.h>
#include <string>

namespace nrd
{
struct PoolsDesc
{
    const char* name = ""; // of the integration: prefix of debug names and memory tags
    uint32_t width = 1;    // pixels, resource size
    uint32_t height = 1;
    NrdMemory transientMemory = {}; // lent by the application; null: allocated
    MemorySource* source = nullptr; // of what is not lent, outlives the pools; null: none is made
};

/// Textures in one block of memory, and the views of each.
class TexturePool final : public Retirable
{
public:
    /// `letter` names them: "NRD P(0)". Throws rhi::Error, or a Refusal if a block is lent that does not serve.
    TexturePool(rhi::Device& device, const PoolsDesc& desc, rhi::Span<const TextureDesc> textures, char letter,
                const NrdMemory& lent = {});

    uint32_t size() const { return static_cast<uint32_t>(m_slots.size()); }
    uint64_t byteSize() const { return m_byteSize; }
    /// Null if it is empty or if no memory type serves all of its textures.
    NrdMemory memory() const { return m_blocks.size() == 1 ? m_blocks[0].place() : NrdMemory(); }
    const rhi::Texture& texture(uint32_t index) const { return *m_slots[index].texture; }
    const rhi::TextureView& view(uint32_t index, rhi::ViewType type) const
    {
        return type == rhi::ViewType::Storage ? *m_slots[index].storage : *m_slots[index].sampled;
    }

private:
    void allocate(rhi::Device& device, const std::vector<rhi::TextureDesc>& descs, const VkMemoryRequirements& needs,
                  MemorySource& source, const std::string& tag);

    struct Slot
    {
        std::unique_ptr<rhi::Texture> texture;
        std::unique_ptr<rhi::TextureView> sampled;
        std::unique_ptr<rhi::TextureView> storage;
    };
    std::vector<MemoryBlock> m_blocks; // one, or one for each texture if no memory type serves all of them
    std::vector<Slot> m_slots;
    uint64_t m_byteSize = 0; // as the driver asked for; 0 in memory that is lent
};

class Pools final : public Retirable
{
public:
    Pools(rhi::Device& device, const PoolsDesc& desc, const InstanceDesc& instance);

    uint32_t width() const { return m_width; } // pixels, resource size
    uint32_t height() const { return m_height; }
    const TexturePool& permanent() const { return m_permanent; }
    const TexturePool& transient() const { return *m_transient; }
    /// There is none afterwards: of pools of which only the history is still of use.
    std::unique_ptr<Retirable> takeTransient() { return std::move(m_transient); }
    const rhi::Buffer& buffer(uint32_t index) const { return *m_buffers[index]; }

    /// Textures: permanent, then transient, then one for each slot of the user pool.
    StateTracker states;
    std::vector<rhi::BufferState> bufferStates;

private:
    uint32_t m_width;
    uint32_t m_height;
    TexturePool m_permanent;
    std::unique_ptr<TexturePool> m_transient;
    std::vector<std::unique_ptr<rhi::Buffer>> m_buffers;
};

/// What the pools will take, by the driver's word; the images that it is asked about are not kept. Throws rhi::Error.
PoolMemoryRequirements poolMemoryRequirements(rhi::Device& device, const PoolsDesc& desc, const InstanceDesc& instance);

/// Line of the device's memory report: "NRD permanent", "NRD transient", "NRD constants", "NRD buffers".
std::string memoryTag(const char* name, const char* part);
} // namespace nrd
