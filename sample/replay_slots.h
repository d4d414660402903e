// What a user-pool slot is filled from and what comes out of it, as one table.
#pragma once
#include "replay_denoisers.h"

#include <vulkan/vulkan.h>

#include <optional>

namespace sample
{
// Layers of a frame as four-component float images.
enum class Layer : uint8_t
{
    Guides, // normal, roughness
    Depth,  // viewZ, material ID
    Motion,
    Diffuse,  // radiance, hit distance
    Specular, // radiance, hit distance
    DiffuseDirection,
    SpecularDirection,
    Shadow,         // translucency, distance to the occluder
    SpecularMotion, // of what is reflected, hit distance: 0 where the pixel has no sample
    Count
};
inline constexpr size_t kLayerCount = static_cast<size_t>(Layer::Count);

// The layer's components of a frame, four floats per pixel; an absent material ID is 0.
std::vector<float> layerValues(const Planes& frame, Layer layer);

// The channels that a capture must have for the layer.
std::vector<Channel> neededChannels(Layer layer);

struct SlotRow
{
    nrd::ResourceType type;
    Family family; // that packs the slot so; None: every family
    VkFormat format;
    std::optional<Layer> layer;     // inputs: packed from it; nothing: a constant
    std::optional<Layer> direction; // inputs: and from it
    uint32_t mode;                  // REPLAY_PACK_... or REPLAY_UNPACK_...
    bool isDiffuse;
    bool isOutput;
    std::optional<nrd::ResourceType> sh1; // outputs: the other half of an SH signal, of which this is the first
    std::optional<Signal> radiance;       // outputs: what .xyz is
    std::optional<Signal> scalar;         // outputs: what .w is
};

// Null when the replay tool cannot serve the slot for that family.
const SlotRow* findSlot(nrd::ResourceType type, Family family);
} // namespace sample
