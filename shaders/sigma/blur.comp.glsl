// First blur, of the noisy input; and what the last frame knew of the same place, for the second one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.h"

#define FIRST_HISTORY (4 + HAS_TRANSLUCENCY)
#define FIRST_OUT (FIRST_HISTORY + 2 * HAS_HISTORY)
layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform utexture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Penumbra;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Radius;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 1) uniform writeonly image2D gOut_Shadow;
#if HAS_TRANSLUCENCY
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_Translucency;
#endif
#if HAS_HISTORY
layout(set = SET_RESOURCES, binding = FIRST_HISTORY) uniform texture2D gIn_Motion;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY + 1) uniform utexture2D gIn_History;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2) uniform writeonly uimage2D gOut_Past;
#if HAS_TRANSLUCENCY
layout(set = SET_RESOURCES, binding = FIRST_OUT + 3) uniform writeonly image2D gOut_PastColor;
#endif
#endif

#include "input.glsl"
ShadowSample readFiltered(ivec2 pixel, float viewZ) { return readInputSample(pixel, viewZ); }
#include "penumbra_filter.glsl"

#if HAS_HISTORY
#include "shadow_reprojection.glsl"

void storePast(ivec2 pixel, Past past)
{
    imageStore(gOut_Past, pixel, uvec4(packVisibility(past)));
#if HAS_TRANSLUCENCY
    imageStore(gOut_PastColor, pixel, unpackUnorm4x8(packColor(past)));
#endif
}
#endif

void main()
{
    ivec2 group = ivec2(gl_WorkGroupID.xy) * ivec2(8, 16);
    uint kinds = gatherKinds(group);
    bool isPenumbra = kinds == kTilePenumbra; // the same for the whole group
    if (isPenumbra) loadNeighbourhood(group);
    barrier();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(pixel)) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    if (!isInRange(viewZ)) return;
    ShadowSample result = readInputSample(pixel, viewZ);
    if (isPenumbra)
    {
        Receiver receiver = makeReceiver(pixel, viewZ);
        if (!isUnlit(result.radius))
            result = filterPenumbra(receiver, result, measureNeighbourhood(receiver, result), g.rotatorBlur);
#if HAS_HISTORY
        storePast(pixel, reproject(receiver, viewZ));
#endif
    }
    imageStore(gOut_Radius, pixel, vec4(encodeRadius(result.radius)));
    imageStore(gOut_Shadow, pixel, encodeShadow(result.shadow));
}
