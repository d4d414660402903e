// Camera cuts that nobody announced: hardly a pixel of the last frame's surfaces is seen again.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#define LOBES 3
#define SIGNAL 0
#include "denoiser.glsl"

layout(local_size_x = 32, local_size_y = 8) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform writeonly image2D gOut_Cut;

const float kMinShare = 0.1;   // a pan of 90 degrees a second still finds nine tenths
const float kMinSamples = 8.0; // fewer say nothing about the camera

const int kBatch = 12;

shared vec2 sCount[256]; // samples, and those found again

void main()
{
    int lane = int(gl_LocalInvocationIndex);
    ivec2 tiles = (g.rectSizeMinusOne + TILE_SIZE) / TILE_SIZE;
    vec2 count = vec2(0.0);
    ivec2 first = ivec2(gl_LocalInvocationID.xy);
    // Many at a time: one group alone has nothing else to hide the latency of its reads behind.
    for (int x = first.x; x < tiles.x; x += 32)
    {
        for (int y = first.y; y < tiles.y; y += 8 * kBatch)
        {
            [[unroll]] for (int i = 0; i < kBatch; i++)
            {
                ivec2 tile = ivec2(x, y + 8 * i);
                vec2 counts = texelFetch(gIn_Tiles, min(tile, tiles - 1), 0).yz;
                count += tile.y < tiles.y ? counts * float(CUT_SAMPLES_PER_TILE) : vec2(0.0);
            }
        }
    }
    sCount[lane] = count;
    for (int stride = 128; stride > 0; stride /= 2)
    {
        barrier();
        if (lane < stride) sCount[lane] += sCount[lane + stride];
    }
    if (lane > 0) return;
    bool isCut = sCount[0].x >= kMinSamples && sCount[0].y < kMinShare * sCount[0].x;
    imageStore(gOut_Cut, ivec2(0), vec4(isCut ? 1.0 : 0.0));
}
