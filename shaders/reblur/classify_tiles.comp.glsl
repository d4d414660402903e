// Marks 16x16 tiles without a pixel in the denoising range; every later pass leaves them at once.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LOBES 3
#include "reblur.glsl"

layout(local_size_x = 8, local_size_y = 4) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 1) uniform writeonly image2D gOut_Tiles;

shared uint sIsUsed;

void main()
{
    if (gl_LocalInvocationIndex == 0) sIsUsed = 0;
    barrier();
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    ivec2 first = tile * TILE_SIZE + ivec2(gl_LocalInvocationID.xy) * ivec2(2, 4);
    bool isUsed = false;
    for (int i = 0; i < 8; i++)
    {
        ivec2 pixel = first + ivec2(i & 1, i >> 1);
        // Pixels beyond the rectangle count as out of range: what lies there is not ours to read.
        if (isInRect(pixel)) isUsed = isUsed || isInRange(decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x));
    }
    if (isUsed) sIsUsed = 1; // every writer writes the same value
    barrier();
    if (gl_LocalInvocationIndex == 0) imageStore(gOut_Tiles, tile, vec4(sIsUsed == 0 ? 1.0 : 0.0));
}
