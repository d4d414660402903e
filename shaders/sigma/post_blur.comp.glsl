// Second blur, of the first one's result; then the mean with the last frames, as far as they agree with this one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.h"

#define FIRST_OUT (5 + HAS_HISTORY * (1 + HAS_TRANSLUCENCY))
layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform utexture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Radius;
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_Shadow;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_ShadowTranslucency;
#if HAS_HISTORY
layout(set = SET_RESOURCES, binding = 5) uniform utexture2D gIn_Past;
#if HAS_TRANSLUCENCY
layout(set = SET_RESOURCES, binding = 6) uniform texture2D gIn_PastColor;
#endif
layout(set = SET_RESOURCES, binding = FIRST_OUT + 1) uniform writeonly uimage2D gOut_History;
#endif

#include "sigma.glsl"
ShadowSample readFiltered(ivec2 pixel, float viewZ)
{
    float radius = decodeRadius(texelFetch(gIn_Radius, pixel, 0).x);
    return ShadowSample(decodeShadow(texelFetch(gIn_Shadow, pixel, 0)), radius);
}

#if HAS_HISTORY
#include "shadow_history.glsl"
float readPastVisibility(ivec2 pixel)
{
    Past past = unpackPast(texelFetch(gIn_Past, pixel, 0).x, 0u);
    return past.n > 0.0 ? visibility(past.shadow) : -1.0;
}
#define HAS_PAST 1
#endif
#include "penumbra_filter.glsl"
#if HAS_HISTORY
#include "stabilize_shadow.glsl"
#endif

void main()
{
    ivec2 group = ivec2(gl_WorkGroupID.xy) * ivec2(8, 16);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    uint kinds = gatherKinds(group);
    bool isPenumbra = kinds == kTilePenumbra; // the same for the whole group
    if (isPenumbra) loadNeighbourhood(group);
    barrier();
    if (!isInRect(pixel)) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    if (!isInRange(viewZ))
    {
#if HAS_HISTORY
        imageStore(gOut_History, pixel, uvec4(0u)); // a stale depth would let a later frame accept garbage
#endif
        return;
    }
    ShadowSample result = readFiltered(pixel, viewZ);
#if HAS_HISTORY
    Past past = Past(result.shadow, kLongestHistory); // what is not filtered needs no history, and makes a good one
#endif
    if (isPenumbra && !isUnlit(result.radius))
    {
        Receiver receiver = makeReceiver(pixel, viewZ);
        Neighbourhood neighbourhood = measureNeighbourhood(receiver, result);
        result = filterPenumbra(receiver, result, neighbourhood, g.rotatorPostBlur);
#if HAS_HISTORY
        past = stabilize(pixel, result, neighbourhood);
#endif
    }
#if HAS_HISTORY
    result.shadow = past.shadow;
    imageStore(gOut_History, pixel, uvec4((packDepth(viewZ) << 16) | packVisibility(past), packColor(past), 0u, 0u));
#endif
    if (pixelUv(pixel).x >= g.splitScreen) imageStore(gOut_ShadowTranslucency, pixel, encodeOutput(result.shadow));
}
