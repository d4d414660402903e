// The traced signals to the inputs of the denoiser, by the front end that applications include.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "nrd_frontend.glsl"
#include "rounding.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = 0, binding = 1) uniform texture2D gIn_NormalRoughness;
layout(set = 0, binding = 2) uniform texture2D gIn_Motion; // .w: material
layout(set = 0, binding = 3) uniform texture2D gIn_Diffuse; // .w: hit distance, world units
layout(set = 0, binding = 4) uniform texture2D gIn_Specular;
layout(set = 0, binding = 5) uniform writeonly image2D gOut_NormalRoughness;
layout(set = 0, binding = 6) uniform writeonly image2D gOut_Diffuse;
layout(set = 0, binding = 7) uniform writeonly image2D gOut_Specular;
layout(push_constant) uniform Constants
{
    vec4 hitDistanceParameters; // .xyz A, B, C
    uvec2 size;                 // pixels
};

vec4 packLobe(vec4 signal, float viewZ, float roughness)
{
    float hitDistance = REBLUR_FrontEnd_GetNormHitDist(signal.w, viewZ, hitDistanceParameters.xyz, roughness);
    return roundToHalf(REBLUR_FrontEnd_PackRadianceAndNormHitDist(signal.xyz, hitDistance, true));
}

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    float viewZ = texelFetch(gIn_ViewZ, pixel, 0).x;
    vec4 surface = texelFetch(gIn_NormalRoughness, pixel, 0);
    float material = float(uint(texelFetch(gIn_Motion, pixel, 0).w) & 3u); // two bits in the default encoding
    imageStore(gOut_NormalRoughness, pixel, NRD_FrontEnd_PackNormalAndRoughness(surface.xyz, surface.w, material));
    imageStore(gOut_Diffuse, pixel, packLobe(texelFetch(gIn_Diffuse, pixel, 0), viewZ, 1.0));
    imageStore(gOut_Specular, pixel, packLobe(texelFetch(gIn_Specular, pixel, 0), viewZ, surface.w));
}
