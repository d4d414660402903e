// The images of a frame: guides and noisy signals of a known mean, as an application hands them over.
#pragma once
#include "setup.h"
#include <map>
#include <test_image.h>

namespace options
{
using test::Plane;

// NaN where the format has it; nothing of it may be read.
glm::vec4 poisonOf(rhi::Format format);

struct Frame
{
    glm::ivec2 size{0};     // of the images
    glm::ivec2 rect{0};     // the active part, outputs at its place
    quality::Guides guides; // of the rectangle
    bool hasSky = true;     // false: without IN_VIEWZ every pixel counts
    float denoisingRange = quality::kDenoisingRange;
    std::map<nrd::ResourceType, rhi::Format> formats;
    std::map<nrd::ResourceType, uint32_t> strides; // above 1: the image holds every so manyth pixel of every such row
    std::map<nrd::ResourceType, Plane> inputs;     // `size`
    std::map<nrd::ResourceType, Plane> noisy;      // `rect`, by output slot: what the noisy input says of each pixel
    std::map<nrd::ResourceType, Plane> means;      // `rect`, by output slot: what denoising should find

    glm::ivec2 sizeOf(nrd::ResourceType slot) const;
    size_t texel(int x, int y) const { return static_cast<size_t>(y * size.x + x); }
    size_t pixel(int x, int y) const { return static_cast<size_t>(y * rect.x + x); }
    bool isInRange(int x, int y) const { return !hasSky || std::abs(guides.viewZ[pixel(x, y)]) < denoisingRange; }
};

// What the slot's image holds.
Plane picked(const Frame& frame, nrd::ResourceType slot);

// Of a pixel of the rectangle, in metres.
glm::vec3 worldPosition(const Frame& frame, int x, int y);

// Least format, or a larger one, of a slot.
rhi::Format formatOf(const nrd::ResourceRequirement& need, const Setup& setup);

Frame makeFrame(const Setup& setup, const std::vector<nrd::ResourceRequirement>& needs, int frame);

bool isOutput(nrd::ResourceType slot);
} // namespace options
