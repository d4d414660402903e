// What SIGMA remembers of a pixel, and how it is packed: the depth's code in 16 bits, square root of visibility in 12,
// frames in 4, square roots of the colour in 11, 11 and 10.
#ifndef SHADOW_HISTORY_GLSL
#define SHADOW_HISTORY_GLSL
#include "depth_code.glsl"
#include "shadow_packing.glsl"

const float kLongestHistory = 15.0; // frames

struct Past
{
    Shadow shadow;
    float n; // frames
};

uint packRoot(float x, float steps) { return uint(sqrt(clamp(x, 0.0, 1.0)) * steps + 0.5); }
float unpackRoot(uint code, float steps)
{
    float root = float(code) / steps;
    return root * root;
}

uint packVisibility(Past past)
{
    return (packRoot(visibility(past.shadow), 4095.0) << 4) | uint(clamp(past.n + 0.5, 0.0, kLongestHistory));
}

Past unpackPast(uint word, uint colorWord)
{
    Past past;
    past.n = float(word & 15u);
    float v = unpackRoot((word >> 4) & 4095u, 4095.0);
#if HAS_TRANSLUCENCY
    past.shadow = vec4(v, unpackRoot(colorWord & 2047u, 2047.0), unpackRoot((colorWord >> 11) & 2047u, 2047.0),
                       unpackRoot(colorWord >> 22, 1023.0));
#else
    past.shadow = v;
#endif
    return past;
}

uint packColor(Past past)
{
#if HAS_TRANSLUCENCY
    vec3 color = past.shadow.yzw;
    return packRoot(color.x, 2047.0) | (packRoot(color.y, 2047.0) << 11) | (packRoot(color.z, 1023.0) << 22);
#else
    return 0u;
#endif
}

#endif
