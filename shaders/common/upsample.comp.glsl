// Results of signals that are smaller than the guides, taken to the guides' size by joint bilateral upsampling (Kopf et
// al. 2007): each pixel is a mean of the nearest results, by how much their surfaces are its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "resampling.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_NormalRoughness;
#define FIRST_OUT (2 + SIGNAL_NUM)
// Whatever they hold: first of each lobe, then what spherical harmonics have in addition.
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_Signal0;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Signal0;
#if SIGNAL_NUM >= 2
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Signal1;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 1) uniform writeonly image2D gOut_Signal1;
#endif
#if SIGNAL_NUM == 4
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_Signal2;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2) uniform writeonly image2D gOut_Signal2;
layout(set = SET_RESOURCES, binding = 5) uniform texture2D gIn_Signal3;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 3) uniform writeonly image2D gOut_Signal3;
#endif

// Taps further off count where the nearest ones are of other surfaces by as many e-folds.
const float kStranger = 3.0;

// Of the signals' texels; weights of diffuse and specular light.
struct Sum
{
    vec4 signal0, signal1, signal2, signal3;
    vec2 weights;
};

const Sum kNoSum = Sum(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec2(0.0));

void add(Surface s, ivec2 tap, float share, inout Sum sum)
{
    tap = clampToRect(tap);
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(tap), 0).x);
    if (!isInRange(viewZ)) return; // nothing was denoised there
    Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(tap), 0));
    vec2 weights = share * kinship(s, guide, vec2(tap), viewZ);
    sum.signal0 += texelFetch(gIn_Signal0, tap, 0) * lobeWeight(weights, 0);
#if SIGNAL_NUM >= 2
    sum.signal1 += texelFetch(gIn_Signal1, tap, 0) * lobeWeight(weights, 1);
#endif
#if SIGNAL_NUM == 4
    sum.signal2 += texelFetch(gIn_Signal2, tap, 0) * lobeWeight(weights, 2);
    sum.signal3 += texelFetch(gIn_Signal3, tap, 0) * lobeWeight(weights, 3);
#endif
    sum.weights += weights;
}

// The four results around a place.
void addNearest(Surface s, vec2 place, inout Sum sum)
{
    ivec2 first = ivec2(floor(place));
    vec2 f = place - vec2(first);
    for (int i = 0; i < 4; i++)
    {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec2 share = mix(1.0 - f, f, vec2(offset));
        if (share.x * share.y > 0.0) add(s, first + offset, share.x * share.y, sum);
    }
}

// The ring of twelve around these.
void addRing(Surface s, vec2 place, inout Sum sum)
{
    ivec2 first = ivec2(floor(place)) - 1;
    for (int i = 0; i < 16; i++)
    {
        ivec2 offset = ivec2(i & 3, i >> 2);
        if (offset == clamp(offset, ivec2(1), ivec2(2))) continue;
        vec2 d = vec2(first + offset) - place;
        add(s, first + offset, exp(-dot(d, d)), sum);
    }
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThan(pixel, g.fullRectSizeMinusOne))) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, pixel + g.rectOrigin, 0).x);
    if (!isInRange(viewZ)) return;
    vec2 place = vec2(pixel) / float(g.guideStride);
    Surface s = makeSurface(decodeGuide(texelFetch(gIn_NormalRoughness, pixel + g.rectOrigin, 0)), place, viewZ);
    // A mean of pixels stands in their middle.
    place -= 0.5 - 0.5 / float(g.signalStride);
    Sum sum = kNoSum;
    addNearest(s, place, sum);
    if (min(sum.weights.x, sum.weights.y) < exp(-kStranger)) addRing(s, place, sum);
    // Where all around is sky there is nothing to take.
    vec2 scales = 1.0 / max(sum.weights, vec2(1e-30));
    imageStore(gOut_Signal0, pixel, roundToHalf(sum.signal0 * lobeWeight(scales, 0)));
#if SIGNAL_NUM >= 2
    imageStore(gOut_Signal1, pixel, roundToHalf(sum.signal1 * lobeWeight(scales, 1)));
#endif
#if SIGNAL_NUM == 4
    imageStore(gOut_Signal2, pixel, roundToHalf(sum.signal2 * lobeWeight(scales, 2)));
    imageStore(gOut_Signal3, pixel, roundToHalf(sum.signal3 * lobeWeight(scales, 3)));
#endif
}
