// A recorded layer, as floats, to one input slot of a denoiser.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "nrd_frontend.glsl"
#include "replay_modes.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Layer;  // what is packed; for a lobe .xyz radiance, .w hit distance
layout(set = 0, binding = 1) uniform texture2D gIn_Guides; // .xyz normal, .w roughness
layout(set = 0, binding = 2) uniform texture2D gIn_Depth;  // .x viewZ, .y material ID
layout(set = 0, binding = 3) uniform writeonly image2D gOut_Slot;
layout(push_constant) uniform Constants
{
    vec4 hitDistanceParameters; // .xyz A, B, C
    uint mode;                  // REPLAY_PACK_...
    uint isDiffuse;
    uvec2 size; // pixels
}
g;

// As the front end does, but a miss is 1 however far the surface is.
float getNormHitDist(float hitDist, float viewZ, float roughness)
{
    if (hitDist >= REPLAY_HIT_DIST_MISS) return 1.0;
    return REBLUR_FrontEnd_GetNormHitDist(hitDist, viewZ, g.hitDistanceParameters.xyz, roughness);
}

vec4 pack(vec4 layer, vec4 guides, vec2 depth)
{
    if (g.mode == REPLAY_PACK_NORMAL_ROUGHNESS)
        return NRD_FrontEnd_PackNormalAndRoughness(guides.xyz, guides.w, float(uint(depth.y) & 3u));
    if (g.mode == REPLAY_PACK_COPY) return layer;
    float normHitDist = getNormHitDist(layer.w, depth.x, g.isDiffuse != 0u ? 1.0 : guides.w);
    if (g.mode == REPLAY_PACK_REBLUR_HITDIST) return vec4(normHitDist);
    // Not sanitised: what is not finite in a capture is the denoiser's to deal with.
    return REBLUR_FrontEnd_PackRadianceAndNormHitDist(layer.xyz, normHitDist, false);
}

void main()
{
    uvec2 id = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(id, g.size))) return;
    ivec2 pixel = ivec2(id);
    vec2 depth = texelFetch(gIn_Depth, pixel, 0).xy;
    imageStore(gOut_Slot, pixel, pack(texelFetch(gIn_Layer, pixel, 0), texelFetch(gIn_Guides, pixel, 0), depth));
}
