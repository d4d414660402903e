// A traced lobe to one input slot of the denoiser, by the front end that applications include.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "checkerboard.glsl"
#include "lobe_modes.h"
#include "nrd_frontend.glsl"
#include "rounding.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = 0, binding = 1) uniform texture2D gIn_NormalRoughness;
layout(set = 0, binding = 2) uniform texture2D gIn_Signal; // radiance; .w: hit distance, world units
layout(set = 0, binding = 3) uniform texture2D gIn_Direction;
layout(set = 0, binding = 4) uniform writeonly image2D gOut_Slot;
layout(push_constant) uniform Constants
{
    vec4 hitDistanceParameters; // .xyz A, B, C
    uvec2 size;                 // texels of the slot
    uint mode;                  // LOBE_...
    uint isDiffuse;
    uint checkerboardMode; // nrd::CheckerboardMode
    uint frameIndex;
    int stride; // pixels from one that the slot has to the next
};

vec4 packRelax(vec4 signal, vec3 direction)
{
    if (mode == LOBE_RELAX) return RELAX_FrontEnd_PackRadianceAndHitDist(signal.xyz, signal.w, true);
    vec4 sh1;
    vec4 sh0 = RELAX_FrontEnd_PackSh(signal.xyz, signal.w, direction, sh1, true);
    return mode == LOBE_RELAX_SH0 ? sh0 : sh1;
}

vec4 pack(ivec2 pixel)
{
    vec4 signal = texelFetch(gIn_Signal, pixel, 0);
    if (mode == LOBE_MOTION) return signal;
    vec3 direction = texelFetch(gIn_Direction, pixel, 0).xyz;
    if (mode >= LOBE_RELAX) return packRelax(signal, direction);
    float roughness = isDiffuse != 0u ? 1.0 : texelFetch(gIn_NormalRoughness, pixel, 0).w;
    float viewZ = texelFetch(gIn_ViewZ, pixel, 0).x;
    float normHitDist = REBLUR_FrontEnd_GetNormHitDist(signal.w, viewZ, hitDistanceParameters.xyz, roughness);
    if (mode == LOBE_RADIANCE) return REBLUR_FrontEnd_PackRadianceAndNormHitDist(signal.xyz, normHitDist, true);
    if (mode == LOBE_HIT_DISTANCE) return vec4(normHitDist);
    if (mode == LOBE_DIRECTION) return REBLUR_FrontEnd_PackDirectionalOcclusion(direction, normHitDist, true);
    vec4 sh1;
    vec4 sh0 = REBLUR_FrontEnd_PackSh(signal.xyz, normHitDist, direction, sh1, true);
    return mode == LOBE_SH0 ? sh0 : sh1;
}

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (!hasCheckerboardSample(texel, frameIndex, checkerboardMode, isDiffuse != 0u)) return;
    imageStore(gOut_Slot, packedPixel(texel, checkerboardMode), roundToHalf(pack(texel * stride)));
}
