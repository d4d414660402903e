// One output slot of a denoiser to floats: .xyz radiance, .w normalised hit distance, where there are such; RELAX's .w
// is the history length.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "nrd_frontend.glsl"
#include "replay_modes.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Slot;
layout(set = 0, binding = 1) uniform texture2D gIn_Sh1;    // the other half of an SH signal; else gIn_Slot
layout(set = 0, binding = 2) uniform texture2D gIn_Guides; // .xyz normal, .w roughness
layout(set = 0, binding = 3) uniform texture2D gIn_Depth;  // .x viewZ
layout(set = 0, binding = 4) uniform writeonly image2D gOut_Values;
layout(push_constant) uniform Constants
{
    mat4 worldToView;
    vec4 frustum; // .xy slopes x/z, y/z at uv (0, 0), .zw their change to (1, 1)
    uvec2 size;   // pixels
    vec2 jitter;  // pixels
    uint mode;    // REPLAY_UNPACK_...
    uint isDiffuse;
}
g;

// Unit, world space, surface to camera, of the ray that went through the jittered pixel.
vec3 getViewVector(ivec2 pixel, float viewZ)
{
    vec2 uv = (vec2(pixel) + 0.5 + g.jitter) / vec2(g.size);
    vec3 ray = vec3(g.frustum.xy + uv * g.frustum.zw, 1.0) * (viewZ < 0.0 ? 1.0 : -1.0);
    return normalize(ray * mat3(g.worldToView)); // rigid: times the transpose is times the inverse
}

// Two pixels away: at one, a jittered frame's neighbours share too much of what they show.
vec3 getReferenceNormal(ivec2 pixel, vec3 V, float roughness)
{
    const ivec2 offsets[4] = ivec2[](ivec2(-2, 0), ivec2(2, 0), ivec2(0, -2), ivec2(0, 2));
    NRD_Neighborhood s;
    s.normal = texelFetch(gIn_Guides, pixel, 0).xyz;
    s.viewZ = texelFetch(gIn_Depth, pixel, 0).x;
    for (int i = 0; i < 4; i++)
    {
        ivec2 neighbor = clamp(pixel + offsets[i], ivec2(0), ivec2(g.size) - 1);
        s.neighborNormals[i] = texelFetch(gIn_Guides, neighbor, 0).xyz;
        s.neighborViewZ[i] = texelFetch(gIn_Depth, neighbor, 0).x;
    }
    return NRD_GetReferenceNormal(s, V, roughness);
}

vec3 restore(NRD_SG lobe, ivec2 pixel, vec4 guides, vec3 V)
{
    bool isDiffuse = g.isDiffuse != 0u;
    vec3 reference = getReferenceNormal(pixel, V, isDiffuse ? 1.0 : guides.w);
    return isDiffuse ? NRD_SG_RestoreDiffuse(lobe, guides.xyz, reference)
                     : NRD_SG_RestoreSpecular(lobe, guides.xyz, reference, V, guides.w);
}

vec3 resolve(NRD_SG lobe, ivec2 pixel)
{
    if (g.mode == REPLAY_UNPACK_EXTRACT) return NRD_SG_ExtractColor(lobe);
    vec4 guides = texelFetch(gIn_Guides, pixel, 0);
    vec3 V = getViewVector(pixel, texelFetch(gIn_Depth, pixel, 0).x);
    bool isDiffuse = g.isDiffuse != 0u;
    if (g.mode == REPLAY_UNPACK_RESTORE) return restore(lobe, pixel, guides, V);
    if (g.mode == REPLAY_UNPACK_RESOLVE_SH)
        return isDiffuse ? NRD_SH_ResolveDiffuse(lobe, guides.xyz)
                         : NRD_SH_ResolveSpecular(lobe, guides.xyz, V, guides.w);
    return isDiffuse ? NRD_SG_ResolveDiffuse(lobe, guides.xyz, V, guides.w)
                     : NRD_SG_ResolveSpecular(lobe, guides.xyz, V, guides.w);
}

vec4 unpack(ivec2 pixel)
{
    vec4 data = texelFetch(gIn_Slot, pixel, 0);
    if (g.mode == REPLAY_UNPACK_COPY) return data;
    if (g.mode == REPLAY_UNPACK_SIGMA) return SIGMA_BackEnd_UnpackShadow(data).yzwx;
    if (g.mode == REPLAY_UNPACK_REBLUR_HITDIST) return vec4(data.x);
    if (g.mode == REPLAY_UNPACK_REBLUR_RADIANCE) return REBLUR_BackEnd_UnpackRadianceAndNormHitDist(data);
    if (g.mode == REPLAY_UNPACK_RELAX_RADIANCE) return RELAX_BackEnd_UnpackRadiance(data);
    if (g.mode == REPLAY_UNPACK_REBLUR_DIRECTION_HITDIST)
        return vec4(REBLUR_BackEnd_UnpackDirectionalOcclusion(data).normHitDist);
    NRD_SG lobe = REBLUR_BackEnd_UnpackSh(data, texelFetch(gIn_Sh1, pixel, 0));
    return vec4(resolve(lobe, pixel), lobe.normHitDist);
}

void main()
{
    uvec2 id = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(id, g.size))) return;
    imageStore(gOut_Values, ivec2(id), unpack(ivec2(id)));
}
