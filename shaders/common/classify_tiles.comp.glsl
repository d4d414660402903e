// Marks 16x16 tiles without a pixel in the denoising range, which later passes leave at once, and counts samples
// whose surface was on the last frame's screen.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#define LOBES 3
#define SIGNAL 0
#include "motion.glsl"
#include "history.glsl"

layout(local_size_x = 8, local_size_y = 4) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_Motion;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_PrevViewZ;
layout(set = SET_RESOURCES, binding = 3) uniform writeonly image2D gOut_Tiles;

shared uint sIsUsed;
shared uint sSamples;
shared uint sFound;

// Lenient: between the depths of the footprint's texels, give or take a few times the disocclusion threshold.
bool isFound(ivec2 pixel, float viewZ)
{
    vec2 uv = pixelUv(pixel);
    vec3 X = rotate(g.viewToWorld, reconstructViewPosition(uv, g.frustum, viewZ, g.cameraDelta.w));
    Motion motion = followMotion(uv, viewZ, X, readMotion(gIn_Motion, gIn_ViewZ, pixel));
    if (!isInScreen(motion.uv)) return false;
    float expected = transform(g.worldToViewPrev, motion.Xprev).z;
    ivec2 last = ivec2(g.rectSizePrev) - 1;
    ivec2 origin = makeFootprint(motion.uv * g.rectSizePrev).origin;
    float nearest = 1e30, farthest = 0.0;
    for (int i = 0; i < 4; i++)
    {
        float depth = decodeViewZ(texelFetch(gIn_PrevViewZ, footprintTexel(origin, i, last), 0).x);
        nearest = min(nearest, depth);
        farthest = max(farthest, isInRange(depth) ? depth : 0.0);
    }
    float tolerance = 4.0 * g.disocclusionThreshold * getFrustumSize(viewZ);
    return expected > nearest - tolerance && expected < farthest + tolerance;
}

void main()
{
    if (gl_LocalInvocationIndex == 0) sIsUsed = sSamples = sFound = 0;
    barrier();
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    ivec2 first = tile * TILE_SIZE + ivec2(gl_LocalInvocationID.xy) * ivec2(2, 4);
    bool isUsed = false;
    float firstViewZ = 0.0;
    // Unrolled and without branches, so that all reads are under way at once. What lies beyond the rectangle is not
    // ours to read: the nearest pixel inside, which is of this tile, stands for it.
    [[unroll]] for (int i = 7; i >= 0; i--)
    {
        ivec2 pixel = clampToRect(first + ivec2(i & 1, i >> 1));
        firstViewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
        isUsed = isUsed || isInRange(firstViewZ);
    }
    if (g.isCutDetected != 0u && isInRect(first) && isInRange(firstViewZ))
    {
        atomicAdd(sSamples, 1u);
        if (isFound(first, firstViewZ)) atomicAdd(sFound, 1u);
    }
    if (isUsed) sIsUsed = 1; // every writer writes the same value
    barrier();
    if (gl_LocalInvocationIndex > 0) return;
    vec2 counts = vec2(sSamples, sFound) / float(CUT_SAMPLES_PER_TILE);
    imageStore(gOut_Tiles, tile, vec4(sIsUsed == 0 ? 1.0 : 0.0, counts, 0.0));
}
