// The traced surface to IN_NORMAL_ROUGHNESS, by the front end that applications include.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "nrd_frontend.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_NormalRoughness;
layout(set = 0, binding = 1) uniform texture2D gIn_Motion; // .w: material
layout(set = 0, binding = 2) uniform writeonly image2D gOut_NormalRoughness;
layout(push_constant) uniform Constants
{
    uvec2 size; // pixels
};

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec4 surface = texelFetch(gIn_NormalRoughness, pixel, 0);
    float material = float(uint(texelFetch(gIn_Motion, pixel, 0).w) & 3u); // two bits in the default encoding
    imageStore(gOut_NormalRoughness, pixel, NRD_FrontEnd_PackNormalAndRoughness(surface.xyz, surface.w, material));
}
