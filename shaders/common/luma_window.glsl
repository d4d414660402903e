// The 5x5 windows over which a group of 8x16 compares the fast with the long history. Needs gIn_Diffuse, gIn_Specular.
#ifndef LUMA_WINDOW_GLSL
#define LUMA_WINDOW_GLSL
#include "denoiser.glsl"

const int kRadius = 2;
const ivec2 kHalo = ivec2(8 + 2 * kRadius, 16 + 2 * kRadius);
const float kInvalid = -1.0; // lumas are not negative

// Of the long history, both lobes.
vec2 slowLumas(ivec2 pixel)
{
    vec2 lumas = vec2(0.0);
#if HAS_DIFFUSE
    lumas.x = texelFetch(gIn_Diffuse, pixel, 0).x;
#endif
#if HAS_SPECULAR
    lumas[kSpecularChannel] = texelFetch(gIn_Specular, pixel, 0).x;
#endif
    return lumas;
}

#endif
