// The traced shadow to one input slot of SIGMA, by the front end that applications include.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "nrd_frontend.glsl"
#include "rounding.glsl"
#include "shadow_modes.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Shadow; // translucency, .w: distance to what casts it
layout(set = 0, binding = 1) uniform texture2D gIn_Sun;    // .w: distance to the light, 0: infinite
layout(set = 0, binding = 2) uniform writeonly image2D gOut_Slot;
layout(push_constant) uniform Constants
{
    uvec2 size; // texels of the slot
    uint mode;  // SHADOW_...
    float tanAngularRadius; // of an infinitely distant light
    float lightSize;        // diameter of another, world units
    int stride;             // pixels from one that the slot has to the next
};

float packPenumbra(float hitDist, float distanceToLight)
{
    if (distanceToLight == 0.0) return SIGMA_FrontEnd_PackPenumbra(hitDist, tanAngularRadius);
    return SIGMA_FrontEnd_PackPenumbra(hitDist, distanceToLight, lightSize);
}

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), pixel = texel * stride;
    vec4 shadow = texelFetch(gIn_Shadow, pixel, 0);
    vec4 packed = SIGMA_FrontEnd_PackTranslucency(shadow.w, shadow.rgb);
    if (mode == SHADOW_PENUMBRA) packed = vec4(roundToHalf(packPenumbra(shadow.w, texelFetch(gIn_Sun, pixel, 0).w)));
    imageStore(gOut_Slot, texel, packed);
}
