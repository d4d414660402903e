// The last frame's shadow on the same surface. Needs gIn_Motion, gIn_History.
#ifndef SHADOW_REPROJECTION_GLSL
#define SHADOW_REPROJECTION_GLSL
#include "history.glsl"
#include "shadow_history.glsl"

// By the distance from the receiver's plane: depths of a slanted one differ much from pixel to pixel.
float isSamePlane(Receiver r, vec3 Xprev, ivec2 texel, float viewZ)
{
    vec2 uv = (vec2(texel) + 0.5) / g.rectSizePrev;
    vec3 X = transform(g.viewToWorldPrev, reconstructViewPosition(uv, g.frustumPrev, viewZ, g.cameraDelta.w));
    vec3 N = rotate(g.viewToWorld, r.Nv);
    return abs(dot(N, X - Xprev)) < r.tooFar ? 1.0 : 0.0;
}

Past reproject(Receiver r, float viewZ)
{
    Past none = Past(Shadow(0.0), 0.0);
    if (g.isHistoryReset != 0u || g.maxAccumulatedFrameNum.x == 0.0) return none;
    vec3 X = rotate(g.viewToWorld, r.Xv);
    Motion motion = followMotion(pixelUv(r.pixel), viewZ, X, readMotion(gIn_Motion, gIn_ViewZ, r.pixel));
    if (!isInScreen(motion.uv)) return none;
    Footprint footprint = makeFootprint(motion.uv * g.rectSizePrev);
    ivec2 last = ivec2(g.rectSizePrev) - 1;
    vec4 weights = footprint.bilinear * footprintInside(footprint.origin, last);
    Past sum = none;
    float weightSum = 0.0;
    for (int i = 0; i < 4; i++)
    {
        ivec2 texel = footprintTexel(footprint.origin, i, last);
        uvec4 words = texelFetch(gIn_History, texel, 0);
        float depth = unpackDepth(words.x >> 16);
        float weight = depth > 0.0 ? weights[i] * isSamePlane(r, motion.Xprev, texel, depth) : 0.0;
        Past tap = unpackPast(words.x, words.y);
        sum.shadow += tap.shadow * weight;
        sum.n += tap.n * weight;
        weightSum += weight;
    }
    if (weightSum < 1e-3) return none;
    return Past(sum.shadow / weightSum, sum.n / weightSum);
}

#endif
