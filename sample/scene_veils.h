// What one looks through, moving in front of a patterned wall under the sky: solid glass, a blended pane, a grille cut
// out by its alpha; and a skinned stalk that bends.
#pragma once
#include "scene.h"

namespace sample
{
/// From left to right, each at its place: kVeilPlaces.
Scene makeVeils();

/// Middles of the things, along X; they stay within half a metre of it.
constexpr float kVeilPlaces[] = {-1.8f, -0.6f, 0.6f, 1.8f};
} // namespace sample
