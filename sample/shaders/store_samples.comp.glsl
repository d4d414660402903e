// What is kept of a frame for the history confidence of the next: one sample per tile, and the surface it is of.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "nrd_frontend.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = 0, binding = 1) uniform texture2D gIn_NormalRoughness;
layout(set = 0, binding = 2) uniform texture2D gIn_Diffuse;
layout(set = 0, binding = 3) uniform texture2D gIn_Specular;
layout(set = 0, binding = 4) uniform writeonly image2D gOut_StoredSample;
layout(set = 0, binding = 5) uniform writeonly image2D gOut_StoredNormalRoughness;
layout(push_constant) uniform Constants
{
    uvec2 size;  // pixels
    uvec2 tiles;
    int tileSize;
    int stride; // pixels from one that has samples to the next
};

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, tiles))) return;
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 pixel = NRD_GetConfidencePixel(tile, tileSize, ivec2(size));
    pixel -= pixel % stride;
    vec4 surface = texelFetch(gIn_NormalRoughness, pixel, 0);
    vec3 diffuse = texelFetch(gIn_Diffuse, pixel, 0).rgb, specular = texelFetch(gIn_Specular, pixel, 0).rgb;
    float viewZ = texelFetch(gIn_ViewZ, pixel, 0).x;
    imageStore(gOut_StoredSample, tile, NRD_FrontEnd_PackConfidenceSample(diffuse, specular, viewZ));
    imageStore(gOut_StoredNormalRoughness, tile, NRD_FrontEnd_PackNormalAndRoughness(surface.xyz, surface.w, 0.0));
}
