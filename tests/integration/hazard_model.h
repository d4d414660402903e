// What Vulkan promises about one image, written down independently of the planner: a list of past accesses, which later
// commands each is ordered before, and to whom the last write is visible.
#pragma once
#include <nrd/integration.h>
#include <string>
#include <vector>

namespace test
{
class ImageModel
{
public:
    /// As an application hands it over: earlier work is complete for these stages and accesses, and these stages may
    /// have used it in this way since.
    explicit ImageModel(const nrd::NrdImageState& state);

    /// Empty, or what is wrong with this barrier. A change of layout is a write of its own.
    std::string barrier(const nrd::NrdImageState& before, const nrd::NrdImageState& after);
    /// Empty, or the hazard of an access without anything in between.
    std::string use(const nrd::NrdImageState& as);

private:
    struct Past
    {
        VkPipelineStageFlags stage;     // one bit, or 0 for a layout transition
        VkPipelineStageFlags orderedTo; // later commands of these stages happen after it
    };
    void note(const nrd::NrdImageState& as);
    bool happensBefore(const Past& past, VkPipelineStageFlags stages) const;

    VkImageLayout m_layout;
    std::vector<Past> m_reads; // since the last write
    Past m_write = {0, 0};
    VkAccessFlags m_writeAccess = 0; // how it was written
    bool m_isAvailable = true;
    VkPipelineStageFlags m_visibleStages = 0;
    VkAccessFlags m_visibleAccess = 0;
};
} // namespace test
