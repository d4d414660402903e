// What can be looked at: every input, what became of it, and the pictures.
#pragma once
#include "engine/resources.h"
#include "replay_denoisers.h"

#include <span>
#include <string_view>

namespace sample
{
class Viewer;

struct ViewRow
{
    const char* name;
    uint32_t mode;                                        // VIEW_...
    float range;                                          // factor of values that are no light
    engine::Image* (*image)(Viewer& viewer, size_t side); // null when there is none now
    engine::Image* (*over)(Viewer& viewer, size_t side);  // what the mode needs besides; may be null
    bool showsHistory = false;
};
std::span<const ViewRow> views();

/// Its denoisers draw a validation overlay.
constexpr bool hasOverlay(Family family) { return family == Family::Reblur || family == Family::Relax; }

/// Index in views(); throws SettingError for another name.
size_t findView(std::string_view name);
} // namespace sample
