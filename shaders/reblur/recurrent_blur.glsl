// Beside radiance, hit distances stay the centre's own: a blurred one would steer the next frame's weights with its own
// output and posterise contact shadows.
#ifndef RECURRENT_BLUR_GLSL
#define RECURRENT_BLUR_GLSL
#include "spatial_filter.glsl"

// Lighting edges that no guide shows survive where the history says that a difference is not noise: the admissible
// relative difference of luma shrinks with convergence. Fitted on the recorded sequences.
const float kLumaTolerance = 12.0;

// How alike two signals are: of their hit distances and lumas, with one division for all falloffs.
float signalWeight(Weights w, Signal centre, Signal other, float lumaTolerance)
{
    // Occlusion is its own hit distance, whose weight is strict enough: with another it flickered more.
    if (kIsBounded) return hitDistWeight(w, centre.value.w, other.value.w);
    float x = abs(other.value.w - centre.value.w) * (3.0 * w.hitDist);
    float far = x * x + (x + 1.0); // 1 / heavy()
    float a = 3.0 * abs(luma(other) - luma(centre));
    float b = max(luma(other), luma(centre)) * lumaTolerance + kEps;
    float bb = b * b; // over bb + a (a + b): heavy(a / 3 b)
    return (w.minHitDist * far + 1.0) * bb / (far * (a * (a + b) + bb));
}

// Where the history has settled, four taps of equal weight do as well as eight.
const float kSettled = 0.15; // convergence of about 16 frames
const float kSettledRadius = 0.8;

// Fitted to the flicker of hit distances on the recorded sequences, as long as their error falls or stays.
const float kNearRadius = 1.5; // pixels
const float kSignalFloor = 4.0;

struct Sum
{
    Signal signal;
    float weight;
};

// Four of the eight. Unrolled and without a branch, so that the reads of all taps are under way at once. Needs gIn_ViewZ
// and gIn_NormalRoughness.
void addTaps(inout Sum sum, Signal centre, texture2D t, texture2D second, Pixel p, Lobe lobe, bool isSpecular,
             Kernel kernel, Weights w, float lumaTolerance, bool mayFold, int first, float gaussian)
{
    [[unroll]] for (int i = first; i < first + 4; i++)
    {
        Tap tap = readTap(gIn_ViewZ, gIn_NormalRoughness, p, lobe, isSpecular, w, tapPosition(kernel, i), gaussian,
                          mayFold);
        Signal value = readSignal(t, second, tap.pixel);
        float weight = tap.weight * signalWeight(w, centre, value, lumaTolerance);
        sum.signal = addWeighted(sum.signal, value, weight);
        sum.weight += weight > 0.0 ? weight : 0.0; // not NaN
    }
}

Kernel scaled(Kernel kernel, float scale)
{
    kernel.axes[0] *= scale;
    kernel.axes[1] *= scale;
    return kernel;
}

Signal blurLobe(texture2D t, texture2D second, Pixel p, Lobe lobe, bool isSpecular, ivec2 position, float narrowing)
{
    Signal centre = readSignal(t, second, position);
    float spread = NRD_GetLobeSpread(lobe.roughness, 0.5);
    float factor = hitDistFactor(getHitDist(centre.value.w, p.viewZ, lobe.roughness), p.frustumSize);
    float radius = blurRadius(lobe, factor, narrowing);
    if (radius == 0.0) return centre;
    // Where the hit distance is the signal, a low floor or one that fades would leave nothing to average.
    float minHitDist = g.minHitDistanceWeight * spread * (kIsBounded ? kSignalFloor : narrowing);
    Weights w = makeWeights(p, lobe, isSpecular, narrowing, 1.0, minHitDist);
    Kernel kernel;
    if (isSpecular)
        kernel = specularKernel(p, g.rotatorBlur, factor, narrowing, radius);
    else
        kernel = flatKernel(p, g.rotatorBlur, diffuseSkew(p) * radius);
    float lumaTolerance = kLumaTolerance * narrowing;
    Sum sum = Sum(centre, 1.0);
    // Few kernels reach beyond the screen: the others need not ask it of every tap.
    bool isInside = isOnScreen(kernel), isSettled = isInside && narrowing < kSettled;
    Kernel outer = scaled(kernel, isSettled ? kSettledRadius : 1.0);
    float gaussian = isSettled ? 1.0 : kTaps[0].z;
    if (isInside && !kIsSoftware)
        addTaps(sum, centre, t, second, p, lobe, isSpecular, outer, w, lumaTolerance, false, 0, gaussian);
    else
        addTaps(sum, centre, t, second, p, lobe, isSpecular, outer, w, lumaTolerance, true, 0, gaussian);
    if (!isSettled)
        addTaps(sum, centre, t, second, p, lobe, isSpecular, kernel, w, lumaTolerance, true, 4, kTaps[4].z);
    // What nothing stabilises is calmed by pixels close by.
    if (kIsOcclusion)
    {
        Kernel near = scaled(kernel, kNearRadius / radius);
        addTaps(sum, centre, t, second, p, lobe, isSpecular, near, w, lumaTolerance, true, 0, 1.0);
    }
    Signal result = scaled(sum.signal, 1.0 / sum.weight);
    if (!kIsBounded) result.value.w = centre.value.w;
    return result;
}

// The convergence of a pixel, drawn towards that of its 2x2 partners where they are more stable: single fresh pixels
// on edges would shimmer under a wide kernel.
vec2 adaptedConvergence(texture2D lengths, texture2D viewZs, ivec2 position)
{
    ivec2 quad[3] = ivec2[](position, clampToRect(ivec2(position.x ^ 1, position.y)),
                            clampToRect(ivec2(position.x, position.y ^ 1)));
    vec2 own = vec2(0.0), sum = vec2(0.0);
    for (int i = 0; i < 3; i++)
    {
        vec2 n = unpackLengths(texelFetch(lengths, quad[i], 0).xy);
        bool isUsed = isInRange(decodeViewZ(texelFetch(viewZs, guideTexel(quad[i]), 0).x));
        vec2 value = isUsed ? vec2(convergence(n.x), convergence(n.y)) : vec2(0.0);
        if (i == 0) own = value;
        sum += value;
    }
    return min(own, max(sum * (1.0 / 3.0), 1e-3)); // a divisor later on
}

#endif
