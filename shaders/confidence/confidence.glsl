// Shared by the passes of the history confidence. A texel is a tile of last frame's screen.
#ifndef CONFIDENCE_GLSL
#define CONFIDENCE_GLSL
#include "bindings.h"
#include "confidence_constants.h"
#include "geometry.glsl"
#include "nrd_frontend.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = SET_CONSTANTS, binding = BINDING_CONSTANTS, std140) uniform Constants { ConfidenceConstants g; };

bool isInRect(ivec2 tile) { return all(greaterThanEqual(tile, ivec2(0))) && all(lessThan(vec2(tile), g.rectSizePrev)); }

// 1e-4 keeps the distances that depths are divided by away from zero.
float decodeViewZ(float stored) { return max(abs(stored * g.viewZScale), 1e-4); }

// Comparisons are written so that NaN counts as out of range.
bool isInRange(float viewZ) { return viewZ < g.denoisingRange; }

#endif
