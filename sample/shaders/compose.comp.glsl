// Radiance of both lobes times its factors plus the direct part. IS_PACKED 1: the lobes come from the denoiser.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "nrd_frontend.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Diffuse;
layout(set = 0, binding = 1) uniform texture2D gIn_Specular;
layout(set = 0, binding = 2) uniform texture2D gIn_DiffuseFactor;
layout(set = 0, binding = 3) uniform texture2D gIn_SpecularFactor;
layout(set = 0, binding = 4) uniform texture2D gIn_Direct;
layout(set = 0, binding = 5) uniform texture2D gIn_ViewZ;
layout(set = 0, binding = 6) uniform writeonly image2D gOut_Composed;
layout(set = 0, binding = 7) uniform writeonly image2D gOut_Diffuse; // linear radiance, .w: normalised hit distance
layout(set = 0, binding = 8) uniform writeonly image2D gOut_Specular;
layout(push_constant) uniform Constants
{
    uvec2 size;           // pixels
    float denoisingRange; // world units
};

vec4 unpackLobe(vec4 texel)
{
#if IS_PACKED
    return REBLUR_BackEnd_UnpackRadianceAndNormHitDist(texel);
#else
    return texel;
#endif
}

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    // The denoiser leaves the sky's pixels as they were, which may be anything.
    bool isSky = abs(texelFetch(gIn_ViewZ, pixel, 0).x) > denoisingRange;
    vec4 diffuse = isSky ? vec4(0.0) : unpackLobe(texelFetch(gIn_Diffuse, pixel, 0));
    vec4 specular = isSky ? vec4(0.0) : unpackLobe(texelFetch(gIn_Specular, pixel, 0));
    vec3 composed = texelFetch(gIn_Direct, pixel, 0).rgb;
    composed += diffuse.rgb * texelFetch(gIn_DiffuseFactor, pixel, 0).rgb;
    composed += specular.rgb * texelFetch(gIn_SpecularFactor, pixel, 0).rgb;
    imageStore(gOut_Composed, pixel, vec4(composed, 1.0));
    imageStore(gOut_Diffuse, pixel, diffuse);
    imageStore(gOut_Specular, pixel, specular);
}
