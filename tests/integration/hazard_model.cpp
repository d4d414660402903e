#include "hazard_model.h"

namespace test
{
namespace
{
constexpr VkAccessFlags kWrites = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
                                  VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
constexpr uint32_t kStageBits = 17; // TOP_OF_PIPE to ALL_COMMANDS
} // namespace

ImageModel::ImageModel(const nrd::NrdImageState& state) : m_layout(state.layout)
{
    m_write.orderedTo = state.stages;
    m_visibleStages = state.stages;
    m_visibleAccess = state.access;
    note(state);
}

bool ImageModel::happensBefore(const Past& past, VkPipelineStageFlags stages) const
{
    return ((past.stage | past.orderedTo) & stages) != 0;
}

std::string ImageModel::barrier(const nrd::NrdImageState& before, const nrd::NrdImageState& after)
{
    if (before.layout != VK_IMAGE_LAYOUT_UNDEFINED && before.layout != m_layout) return "old layout is not the present";
    const bool isTransition = before.layout != after.layout;
    const bool isWriteCovered = happensBefore(m_write, before.stages);
    if (isWriteCovered && (m_write.stage & before.stages) != 0 && (m_writeAccess & ~before.access) == 0)
        m_isAvailable = true;
    if (isTransition)
    {
        for (const Past& read : m_reads)
            if (!happensBefore(read, before.stages)) return "the layout changes during a read";
        if (!isWriteCovered && m_write.stage != 0) return "the layout changes during a write";
        if (!m_isAvailable) return "the layout changes before a write is available";
        m_reads.clear();
        m_write = {0, after.stages};
        m_writeAccess = 0;
        m_isAvailable = true;
        m_visibleStages = after.stages;
        m_visibleAccess = after.access;
        m_layout = after.layout;
        return {};
    }
    for (Past& read : m_reads)
        if (happensBefore(read, before.stages)) read.orderedTo |= after.stages;
    if (!isWriteCovered) return {};
    m_write.orderedTo |= after.stages;
    if (!m_isAvailable) return {};
    m_visibleStages |= after.stages;
    m_visibleAccess |= after.access;
    return {};
}

std::string ImageModel::use(const nrd::NrdImageState& as)
{
    if (as.layout != m_layout) return "used in another layout than it is in";
    if ((m_write.orderedTo & as.stages) != as.stages) return "not ordered after the last write";
    if (!m_isAvailable) return "the last write is not available";
    if ((as.access & ~kWrites) != 0 && ((m_visibleStages & as.stages) != as.stages ||
                                        (m_visibleAccess & as.access & ~kWrites) != (as.access & ~kWrites)))
        return "the last write is not visible to the read";
    if ((as.access & kWrites) != 0)
        for (const Past& read : m_reads)
            if ((read.orderedTo & as.stages) != as.stages) return "written while it may still be read";
    note(as);
    return {};
}

void ImageModel::note(const nrd::NrdImageState& as)
{
    const bool isWrite = (as.access & kWrites) != 0;
    if (isWrite)
    {
        m_reads.clear();
        m_isAvailable = false;
        m_writeAccess = as.access & kWrites;
        m_visibleStages = m_visibleAccess = 0;
    }
    for (uint32_t bit = 0; bit < kStageBits; bit++)
    {
        const VkPipelineStageFlags stage = as.stages & (1u << bit);
        if (stage == 0) continue;
        if (isWrite) m_write = {stage, 0};
        // A command may read and write: then its read is over when its write is.
        else if (as.access != 0)
            m_reads.push_back({stage, 0});
    }
}
} // namespace test
