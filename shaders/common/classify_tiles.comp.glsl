// Looks at a tile of 16x16 pixels before anything else does: is there a pixel in the denoising range, how bright a
// sample may be, and are the surfaces of the last frame still there. One invocation looks at eight pixels.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "motion.glsl"
#include "history.glsl"
#include "depth_code.glsl"
#include "checkerboard.glsl"

#define HAS_CAP (1 - IS_BOUNDED)
#define FIRST_CAP_IN 4
#define FIRST_OUT (FIRST_CAP_IN + HAS_CAP * (SIGNAL_NUM + 2))
layout(local_size_x = 8, local_size_y = 4) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_Motion;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_PrevDepth;
layout(set = SET_RESOURCES, binding = 3) uniform utexture2D gIn_PrevCut;
#if HAS_CAP
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = FIRST_CAP_IN) uniform texture2D gIn_Diffuse;
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = FIRST_CAP_IN + LOBE_NUM - 1) uniform texture2D gIn_Specular;
#endif
layout(set = SET_RESOURCES, binding = FIRST_CAP_IN + SIGNAL_NUM) uniform texture2D gIn_PrevSpread;
layout(set = SET_RESOURCES, binding = FIRST_CAP_IN + SIGNAL_NUM + 1) uniform texture2D gIn_PrevNewSpread;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2) uniform writeonly image2D gOut_Cap;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 3) uniform writeonly image2D gOut_Spread;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 4) uniform writeonly image2D gOut_NewSpread;
#endif
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Tiles;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 1, r32ui) uniform uimage2D gOut_Cut;

shared uint sIsUsed; // 1: the tile has a pixel in range

#include "vote_on_cut.glsl"
#if HAS_CAP
#include "firefly_cap.glsl"

float sampleLuma(texture2D t, ivec2 pixel, bool isSpecular)
{
    bool isValid;
    vec4 value = sanitize(texelFetch(t, inputTexel(pixel), 0), isValid);
    return isValid && hasData(pixel, isSpecular) ? value.x : kNoLuma;
}

vec2 sampleLumas(ivec2 pixel)
{
    vec2 lumas = vec2(kNoLuma);
#if HAS_DIFFUSE
    lumas.x = sampleLuma(gIn_Diffuse, pixel, false);
#endif
#if HAS_SPECULAR
    lumas[kSpecularChannel] = sampleLuma(gIn_Specular, pixel, true);
#endif
    return lumas;
}
#endif

void main()
{
    bool isFirst = gl_LocalInvocationIndex == 0u;
    ivec2 tile = ivec2(gl_WorkGroupID.xy), first = tile * TILE_SIZE + ivec2(gl_LocalInvocationID.xy);
    if (isFirst)
    {
        sIsUsed = 0u;
        prepareVotes();
    }
    barrier();
    bool isUsed = false;
#if HAS_CAP
    Samples part = kNoSamples;
#endif
    // Unrolled and without branches, so that all reads are under way at once.
    [[unroll]] for (int i = 0; i < 8; i++)
    {
        ivec2 pixel = first + ivec2(i & 1, i >> 1) * ivec2(8, 4), inside = clampToRect(pixel);
        bool isHere = inside == pixel && isInRange(decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(inside), 0).x));
        isUsed = isUsed || isHere;
#if HAS_CAP
        if (kHasAntiFirefly)
        {
            vec2 lumas = sampleLumas(inside);
            addSample(part, isHere ? lumas : vec2(kNoLuma));
        }
#endif
    }
    if (isUsed) sIsUsed = 1u; // every writer writes the same value
    voteOnCut(tile);
#if HAS_CAP
    if (kHasAntiFirefly) findCaps(tile, part);
#endif
    barrier();
    if (!isFirst) return;
    imageStore(gOut_Tiles, tile, vec4(sIsUsed == 0u ? 1.0 : 0.0));
    countVotes();
}
