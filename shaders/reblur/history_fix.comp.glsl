// Fills pixels with a short history from a wide sparse neighbourhood, then bounds the long history's luma by statistics
// of the fast one. Also keeps this frame's guides for the next.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "spatial_filter.glsl"

layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Length;
#define HAS_TRACK (HAS_SPECULAR * (1 - IS_BOUNDED))
#define FIRST_OUT (5 + SIGNAL_NUM + HAS_TRACK)
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Diffuse;
#if IS_SH
layout(set = SET_RESOURCES, binding = 4 + LOBE_NUM) uniform texture2D gIn_DiffuseSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_DiffuseSh;
#endif
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 3 + LOBE_NUM) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
#if IS_SH
layout(set = SET_RESOURCES, binding = 3 + 2 * LOBE_NUM) uniform texture2D gIn_SpecularSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2 * LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularSh;
#endif
#if HAS_TRACK
layout(set = SET_RESOURCES, binding = 5 + SIGNAL_NUM) uniform texture2D gIn_Track;
#endif
#endif
layout(set = SET_RESOURCES, binding = 4 + SIGNAL_NUM) uniform texture2D gIn_Fast;
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM) uniform writeonly image2D gOut_Fast;
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM + 1) uniform writeonly image2D gOut_PrevDepth;
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM + 2) uniform writeonly image2D gOut_PrevNormalRoughness;

#include "keep_surface.glsl"
#include "fast_history.glsl"
#include "history_fix.glsl"

float trackingOf(ivec2 position)
{
#if HAS_TRACK
    return abs(texelFetch(gIn_Track, position, 0).x);
#else
    return 0.0;
#endif
}

void main()
{
    ivec2 group = ivec2(gl_WorkGroupID.xy) * ivec2(8, 16);
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    float storedViewZ = texelFetch(gIn_ViewZ, guideTexel(clampToRect(position)), 0).x;
    float viewZ = decodeViewZ(storedViewZ);
    bool isUsed = isInRect(position) && isInRange(viewZ);
    // Before any exit: a stale depth in sky would let the next frame accept garbage.
    if (isInRect(position) && !isUsed) forgetSurface(position);
    if (texelFetch(gIn_Tiles, group / TILE_SIZE, 0).x > 0.5) return; // the same for the whole group
    measureWindows(group);
    if (!isUsed) return;
    vec4 packedGuide = texelFetch(gIn_NormalRoughness, guideTexel(position), 0);
    Guide guide = decodeGuide(packedGuide);
    keepSurface(position, storedViewZ, packedGuide, guide);
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
    vec2 share = clamp(n / max(g.historyFixFrameNum, 1e-3), 0.0, 1.0);
    vec2 fast = texelFetch(gIn_Fast, position, 0).xy;
    vec2 amount = vec2(0.0);
    if (any(lessThan(n, vec2(g.historyFixFrameNum)))) amount = fixAmount(position, n);
#if HAS_DIFFUSE
    Signal diffuse = readSignal(gIn_Diffuse, gIn_DiffuseSh, position);
    if (amount.x > 0.0)
    {
        Lobe lobe = Lobe(1.0, g.minMaterialForDiffuse, 0.0);
        diffuse = fixHistory(gIn_Diffuse, gIn_DiffuseSh, diffuse, makePixel(position, viewZ, guide), lobe, false,
                             n.x, amount.x, 0.0);
    }
    fast.x = boundSignal(diffuse, guide, 0, false, n.x, fast.x, share.x);
    storeSignal(gOut_Diffuse, gOut_DiffuseSh, position, diffuse);
#endif
#if HAS_SPECULAR
    const int c = kSpecularChannel;
    Signal specular = readSignal(gIn_Specular, gIn_SpecularSh, position);
    if (amount[c] > 0.0)
    {
        Lobe lobe = Lobe(guide.roughness, g.minMaterialForSpecular, 0.0);
        specular = fixHistory(gIn_Specular, gIn_SpecularSh, specular, makePixel(position, viewZ, guide), lobe, true,
                              n[c], amount[c], trackingOf(position));
    }
    // Filled-in data is unwanted in the fast history of sharp lobes.
    share[c] = mix(1.0, share[c], NRD_GetLobeSpread(guide.roughness, 0.25));
    fast[c] = boundSignal(specular, guide, c, true, n[c], fast[c], share[c]);
    storeSignal(gOut_Specular, gOut_SpecularSh, position, specular);
#endif
    imageStore(gOut_Fast, position, kIsBounded ? vec4(fast, 0.0, 0.0) : roundToHalf(vec4(fast, 0.0, 0.0)));
}
