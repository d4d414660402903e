// What SIGMA's passes share.
#ifndef SIGMA_GLSL
#define SIGMA_GLSL
#define LOBES 1
#define SIGNAL 0
#include "motion.glsl"
#include "checkerboard.glsl"
#include "shadow_packing.glsl"

//----------------------------------------------------------------------------------------------------------------------
// Tiles: what the rays of 16x16 pixels met, as bits. Where a tile and those around it hold one kind only, there is
// nothing to filter.

#define TILE_LIT 1u
#define TILE_SHADOWED 2u
const uint kTilePenumbra = TILE_LIT | TILE_SHADOWED;

#endif
