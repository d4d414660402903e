// Which kinds of ray the 16x16 pixels of a tile have: through to the light, or met by something.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "bindings.h"

layout(local_size_x = 8, local_size_y = 4) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_Penumbra;
#if HAS_TRANSLUCENCY
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_Translucency;
#endif
layout(set = SET_RESOURCES, binding = 2 + HAS_TRANSLUCENCY) uniform writeonly uimage2D gOut_Tiles;

#include "input.glsl"

const float kOpaque = 0.003; // colour that counts as none

shared uint sKinds;

uint kindsOf(ShadowSample s)
{
    if (isUnlit(s.radius)) return 0u; // both lit and shadowed pixels leave it alone
    if (isLit(s.radius)) return TILE_LIT;
#if HAS_TRANSLUCENCY
    if (any(greaterThan(s.shadow.yzw, vec3(kOpaque)))) return kTilePenumbra;
#endif
    return visibility(s.shadow) > 0.0 ? kTilePenumbra : TILE_SHADOWED;
}

void main()
{
    if (gl_LocalInvocationIndex == 0) sKinds = 0u;
    barrier();
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    ivec2 first = tile * TILE_SIZE + ivec2(gl_LocalInvocationID.xy) * ivec2(2, 4);
    uint kinds = 0u;
    // Unrolled and without branches, so that all reads are under way at once; what lies outside is its neighbour again.
    [[unroll]] for (int i = 0; i < 8; i++)
    {
        ivec2 pixel = clampToRect(first + ivec2(i & 1, i >> 1));
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
        uint own = kindsOf(readInputSample(pixel, viewZ));
        kinds |= isInRange(viewZ) ? own : 0u;
    }
    atomicOr(sKinds, kinds);
    barrier();
    if (gl_LocalInvocationIndex == 0) imageStore(gOut_Tiles, tile, uvec4(sKinds));
}
