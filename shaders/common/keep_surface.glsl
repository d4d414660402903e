// What a frame keeps of its surfaces for the next one's eyes. Needs gOut_PrevDepth, gOut_PrevNormalRoughness.
#ifndef KEEP_SURFACE_GLSL
#define KEEP_SURFACE_GLSL
#include "prev_surface.glsl"

void forgetSurface(ivec2 pixel) { imageStore(gOut_PrevDepth, pixel, vec4(0.0)); }

void keepSurface(ivec2 pixel, float storedViewZ, vec4 packedGuide, Guide guide)
{
    imageStore(gOut_PrevDepth, pixel, vec4(depthCode(storedViewZ)));
#if HAS_SPECULAR
    imageStore(gOut_PrevNormalRoughness, pixel, packedGuide);
#else
    imageStore(gOut_PrevNormalRoughness, pixel, packSide(guide));
#endif
}

#endif
