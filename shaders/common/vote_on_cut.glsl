// Camera cuts that nobody announced: hardly a pixel of the last frame's surfaces is seen again. Some pixels
// of a tile vote, in larger pictures of every second or fourth tile a side: votes wait for each other.
// Needs gIn_ViewZ, gIn_Motion, gIn_PrevDepth, gOut_Cut.
#ifndef VOTE_ON_CUT_GLSL
#define VOTE_ON_CUT_GLSL
#include "cut.glsl"

shared int sVotes;

const float kTileVotePixels = 512.0; // of the shorter side, for which all tiles vote

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
        float depth = decodeDepth(texelFetch(gIn_PrevDepth, footprintTexel(origin, i, last), 0).x); // 0: sky
        nearest = min(nearest, depth > 0.0 ? depth : 1e30);
        farthest = max(farthest, depth);
    }
    float tolerance = 4.0 * g.disocclusionThreshold * getFrustumSize(viewZ);
    return expected > nearest - tolerance && expected < farthest + tolerance;
}

// By one invocation, before a barrier.
void prepareVotes() { sVotes = 0; }

// Behind it.
void voteOnCut(ivec2 tile)
{
    ivec2 stride = ivec2(max(g.minRectDim / kTileVotePixels, 1.0));
    if (g.isCutDetected == 0u || tile % stride != ivec2(0)) return;
    ivec2 pixel = tile * TILE_SIZE + ivec2(gl_LocalInvocationID.xy) * ivec2(2, 4);
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(clampToRect(pixel)), 0).x);
    if (isInRect(pixel) && isInRange(viewZ)) atomicAdd(sVotes, isFound(pixel, viewZ) ? kFoundVote : kLostVote);
}

// By one invocation, behind another. Sums of integers do not depend on their order.
void countVotes()
{
    if (sVotes != 0) imageAtomicAdd(gOut_Cut, ivec2(0), uint(sVotes));
}

#endif
