// What SIGMA made of the shadow: what comes through, and in .w the visible share of the light.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "nrd_frontend.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = 0, binding = 1) uniform texture2D gIn_Slot;
layout(set = 0, binding = 2) uniform writeonly image2D gOut_Values;
layout(push_constant) uniform Constants
{
    uvec2 size; // pixels
    uint isTranslucent;
    float denoisingRange; // world units
};

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec4 shadow = SIGMA_BackEnd_UnpackShadow(texelFetch(gIn_Slot, pixel, 0));
    vec4 values = isTranslucent != 0u ? shadow.yzwx : shadow.xxxx;
    // The denoiser leaves the sky's pixels as they were, which may be anything.
    bool isSky = abs(texelFetch(gIn_ViewZ, pixel, 0).x) > denoisingRange;
    imageStore(gOut_Values, pixel, isSky ? vec4(1.0) : values);
}
