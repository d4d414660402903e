// Finds, for every tile, how bright a sample may be. One invocation looks at eight pixels.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "denoiser.glsl"
#include "checkerboard.glsl"

layout(local_size_x = 8, local_size_y = 4) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_Diffuse;
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 1 + LOBE_NUM) uniform texture2D gIn_Specular;
#endif
layout(set = SET_RESOURCES, binding = 2 + SIGNAL_NUM) uniform texture2D gIn_Cut;
layout(set = SET_RESOURCES, binding = 3 + SIGNAL_NUM) uniform texture2D gIn_PrevSpread;
layout(set = SET_RESOURCES, binding = 4 + SIGNAL_NUM) uniform writeonly image2D gOut_Cap;
layout(set = SET_RESOURCES, binding = 5 + SIGNAL_NUM) uniform writeonly image2D gOut_Spread;

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
    ivec2 inside = clampToRect(pixel);
    bool isUsed = inside == pixel && isInRange(decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(inside), 0).x));
#if HAS_DIFFUSE
    lumas.x = sampleLuma(gIn_Diffuse, inside, false);
#endif
#if HAS_SPECULAR
    lumas[kSpecularChannel] = sampleLuma(gIn_Specular, inside, true);
#endif
    return isUsed ? lumas : vec2(kNoLuma);
}

void main()
{
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    bool isFirst = gl_LocalInvocationIndex == 0u;
    if (texelFetch(gIn_Tiles, tile, 0).x > 0.5) // the same for the whole group
    {
        if (isFirst) imageStore(gOut_Spread, tile, vec4(0.0));
        return;
    }
    Samples part = kNoSamples;
    ivec2 first = tile * TILE_SIZE + ivec2(gl_LocalInvocationID.xy);
    // Unrolled, so that the reads are under way at once.
    [[unroll]] for (int i = 0; i < 8; i++) addSample(part, sampleLumas(first + ivec2(i & 1, i >> 1) * ivec2(8, 4)));
    vec2 cap = shareCap(tile, part);
    if (isFirst) imageStore(gOut_Cap, tile, vec4(min(cap, vec2(kNoCap)), 0.0, 0.0));
}
