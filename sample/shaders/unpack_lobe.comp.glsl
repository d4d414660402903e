// What the denoiser made of a lobe, as linear radiance and in .w the normalised hit distance. The directional forms are
// resolved for the pixel's own normal.
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
    mat4 viewToWorld;
    vec4 frustum; // .xy tangents of the half angles, .zw jitter in pixels
    uvec2 size;   // pixels
    uint mode;    // LOBE_..., not LOBE_SH1
    uint isDiffuse;
    float denoisingRange; // world units
};

// Unit, world space, from the surface to the camera.
vec3 viewVector(ivec2 pixel)
{
    vec2 uv = (vec2(pixel) + 0.5 + frustum.zw) / vec2(size);
    vec3 ray = vec3((2.0 * uv.x - 1.0) * frustum.x, (1.0 - 2.0 * uv.y) * frustum.y, -1.0);
    return -normalize(mat3(viewToWorld) * ray);
}

vec4 unpack(ivec2 pixel)
{
    vec4 data = texelFetch(gIn_Slot, pixel, 0);
    if (mode == LOBE_RADIANCE) return REBLUR_BackEnd_UnpackRadianceAndNormHitDist(data);
    if (mode == LOBE_HIT_DISTANCE) return vec4(vec3(0.0), data.x);
    if (mode == LOBE_DIRECTION) return vec4(vec3(0.0), REBLUR_BackEnd_UnpackDirectionalOcclusion(data).normHitDist);
    NRD_SG lobe = REBLUR_BackEnd_UnpackSh(data, texelFetch(gIn_Sh1, pixel, 0));
    vec4 surface = texelFetch(gIn_NormalRoughness, pixel, 0);
    vec3 view = viewVector(pixel);
    vec3 radiance = isDiffuse != 0u ? NRD_SG_ResolveDiffuse(lobe, surface.xyz, view, surface.w)
                                    : NRD_SG_ResolveSpecular(lobe, surface.xyz, view, surface.w);
    return vec4(radiance, lobe.normHitDist);
}

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    // The denoiser leaves the sky's pixels as they were, which may be anything. No light, and everything is missed.
    bool isSky = abs(texelFetch(gIn_ViewZ, pixel, 0).x) > denoisingRange;
    imageStore(gOut_Values, pixel, isSky ? vec4(0.0, 0.0, 0.0, 1.0) : unpack(pixel));
}
