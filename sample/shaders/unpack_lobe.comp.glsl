// What the denoiser made of a lobe, as linear radiance and in .w the normalised hit distance, of RELAX the history
// length. The directional forms are resolved for the pixel's own, full-detail normal.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lobe_modes.h"
#include "nrd_frontend.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = 0, binding = 1) uniform texture2D gIn_NormalRoughness;
layout(set = 0, binding = 2) uniform texture2D gIn_Slot;
layout(set = 0, binding = 3) uniform texture2D gIn_Sh1; // gIn_Slot again where there is none
layout(set = 0, binding = 4) uniform writeonly image2D gOut_Values;
layout(push_constant) uniform Constants
{
    uvec2 size; // pixels
    uint mode;  // LOBE_..., not one of SH1
    uint isDiffuse;
    float denoisingRange; // world units
};

const int kRadius = 3;                // pixels
const float kDiffuseNormalAngle = 0.4; // radians, about what the blur lets pass while a history is short

// Mean of the normals that the blur mixes at this pixel.
vec3 blurredNormal(ivec2 pixel, vec3 normal)
{
    vec3 sum = vec3(0.0);
    for (int y = -kRadius; y <= kRadius; ++y)
        for (int x = -kRadius; x <= kRadius; ++x)
        {
            ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(size) - 1);
            vec3 n = texelFetch(gIn_NormalRoughness, at, 0).xyz;
            sum += n * max(1.0 - acos(clamp(dot(n, normal), -1.0, 1.0)) / kDiffuseNormalAngle, 0.0);
        }
    return NRD_NormalizeOrZero(sum);
}

// The specular blur hardly mixes normals, so its colour is right as it is.
vec3 resolve(NRD_SG lobe, ivec2 pixel)
{
    if (isDiffuse == 0u) return NRD_SG_ExtractColor(lobe);
    vec3 normal = texelFetch(gIn_NormalRoughness, pixel, 0).xyz;
    return NRD_SG_RestoreDiffuse(lobe, normal, blurredNormal(pixel, normal));
}

vec4 unpack(ivec2 pixel)
{
    vec4 data = texelFetch(gIn_Slot, pixel, 0);
    if (mode == LOBE_RADIANCE) return REBLUR_BackEnd_UnpackRadianceAndNormHitDist(data);
    if (mode == LOBE_RELAX) return RELAX_BackEnd_UnpackRadiance(data);
    if (mode == LOBE_HIT_DISTANCE) return vec4(vec3(0.0), data.x);
    if (mode == LOBE_DIRECTION) return vec4(vec3(0.0), REBLUR_BackEnd_UnpackDirectionalOcclusion(data).normHitDist);
    vec4 sh1 = texelFetch(gIn_Sh1, pixel, 0);
    NRD_SG lobe = mode == LOBE_RELAX_SH0 ? RELAX_BackEnd_UnpackSh(data, sh1) : REBLUR_BackEnd_UnpackSh(data, sh1);
    return vec4(resolve(lobe, pixel), lobe.normHitDist);
}

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    // The denoiser leaves the sky's pixels as they were, which may be anything. No light, and everything is missed.
    bool isSky = abs(texelFetch(gIn_ViewZ, pixel, 0).x) > denoisingRange;
    imageStore(gOut_Values, pixel, isSky ? vec4(0.0, 0.0, 0.0, 1.0) : unpack(pixel));
}
