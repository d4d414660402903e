// A recorded layer, as floats, to one input slot of a denoiser.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "checkerboard.glsl"
#include "nrd_frontend.glsl"
#include "replay_modes.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Layer;     // what is packed; a lobe: .xyz radiance, .w hit distance
layout(set = 0, binding = 1) uniform texture2D gIn_Direction; // .xyz the lobe's first bounce; any layer where unused
layout(set = 0, binding = 2) uniform texture2D gIn_Guides;    // .xyz normal, .w roughness
layout(set = 0, binding = 3) uniform texture2D gIn_Depth;     // .x viewZ, .y material ID
layout(set = 0, binding = 4) uniform writeonly image2D gOut_Slot;
layout(push_constant) uniform Constants
{
    vec4 hitDistanceParameters; // .xyz A, B, C
    uint mode;                  // REPLAY_PACK_...
    uint isDiffuse;
    uvec2 size; // pixels
    float constant;
    uint checkerboardMode; // nrd::CheckerboardMode, 0 for what is no lobe
    uint frameIndex;
    uint lightKind; // REPLAY_LIGHT_...
    vec4 light;     // .xyz view space, of local lights; .w radius, or tangent of the angular radius
    vec4 frustum;   // .xy slopes x/z, y/z at uv (0, 0), .zw their change to (1, 1)
    uint stride;    // pixels of the layer from one of the slot to the next
}
g;

// As the front end does, but a miss is 1 however far the surface is.
float getNormHitDist(float hitDist, float viewZ, float roughness)
{
    if (hitDist >= REPLAY_HIT_DIST_MISS) return 1.0;
    return REBLUR_FrontEnd_GetNormHitDist(hitDist, viewZ, g.hitDistanceParameters.xyz, roughness);
}

vec4 packRelax(ivec2 pixel, vec4 lobe)
{
    if (g.mode == REPLAY_PACK_RELAX_RADIANCE) return RELAX_FrontEnd_PackRadianceAndHitDist(lobe.xyz, lobe.w, false);
    vec4 sh1;
    vec4 sh0 = RELAX_FrontEnd_PackSh(lobe.xyz, lobe.w, texelFetch(gIn_Direction, pixel, 0).xyz, sh1, false);
    return g.mode == REPLAY_PACK_RELAX_SH0 ? sh0 : sh1;
}

// Nothing is sanitised: what is not finite in a capture is the denoiser's to deal with.
vec4 packLobe(ivec2 pixel, vec4 lobe)
{
    if (g.mode >= REPLAY_PACK_RELAX_RADIANCE) return packRelax(pixel, lobe);
    float roughness = g.isDiffuse != 0u ? 1.0 : texelFetch(gIn_Guides, pixel, 0).w;
    float normHitDist = getNormHitDist(lobe.w, texelFetch(gIn_Depth, pixel, 0).x, roughness);
    if (g.mode == REPLAY_PACK_REBLUR_HITDIST) return vec4(normHitDist);
    if (g.mode == REPLAY_PACK_REBLUR_RADIANCE)
        return REBLUR_FrontEnd_PackRadianceAndNormHitDist(lobe.xyz, normHitDist, false);
    vec3 direction = texelFetch(gIn_Direction, pixel, 0).xyz;
    if (g.mode == REPLAY_PACK_REBLUR_DIRECTION_HITDIST)
        return REBLUR_FrontEnd_PackDirectionalOcclusion(direction, normHitDist, false);
    vec4 sh1;
    vec4 sh0 = REBLUR_FrontEnd_PackSh(lobe.xyz, normHitDist, direction, sh1, false);
    return g.mode == REPLAY_PACK_REBLUR_SH0 ? sh0 : sh1;
}

float packPenumbra(ivec2 pixel, float hitDist)
{
    if (g.lightKind == REPLAY_LIGHT_SUN) return SIGMA_FrontEnd_PackPenumbra(hitDist, g.light.w);
    vec2 slope = g.frustum.xy + (vec2(pixel) + 0.5) / vec2(g.size) * g.frustum.zw;
    vec3 X = vec3(slope, 1.0) * texelFetch(gIn_Depth, pixel, 0).x;
    return SIGMA_FrontEnd_PackPenumbra(hitDist, distance(X, g.light.xyz), 2.0 * g.light.w);
}

vec4 pack(ivec2 pixel)
{
    if (g.mode == REPLAY_PACK_CONSTANT) return vec4(g.constant);
    vec4 layer = texelFetch(gIn_Layer, pixel, 0);
    if (g.mode == REPLAY_PACK_COPY) return layer;
    if (g.mode == REPLAY_PACK_SIGMA_PENUMBRA) return vec4(packPenumbra(pixel, layer.w));
    if (g.mode == REPLAY_PACK_SIGMA_TRANSLUCENCY) return SIGMA_FrontEnd_PackTranslucency(layer.w, layer.xyz);
    if (g.mode != REPLAY_PACK_NORMAL_ROUGHNESS) return packLobe(pixel, layer);
    float materialID = float(uint(texelFetch(gIn_Depth, pixel, 0).y) & 3u);
    return NRD_FrontEnd_PackNormalAndRoughness(layer.xyz, layer.w, materialID);
}

void main()
{
    uvec2 id = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(id * g.stride, g.size))) return;
    if (!hasCheckerboardSample(ivec2(id), g.frameIndex, g.checkerboardMode, g.isDiffuse != 0u)) return;
    imageStore(gOut_Slot, packedPixel(ivec2(id), g.checkerboardMode), pack(ivec2(id * g.stride)));
}
