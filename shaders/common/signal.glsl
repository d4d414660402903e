// What is denoised, in the one form in which the passes compute with it, and the forms in which it is stored.
#ifndef SIGNAL_GLSL
#define SIGNAL_GLSL
#include "axis.glsl"
#include "random.glsl"

struct Signal
{
    // .w normalised hit distance; .xyz Y, Co, Cg; occlusion: .x as .w; directional: direction * .w.
    // RELAX: .w world units before accumulation; afterwards the variance over the squared luma.
    vec4 value;
    vec3 axis;  // spherical harmonics: direction * Y, shorter the less directional the light
};

// Stored as hit distance where not a single finite sample was found.
const float kNoSample = -1.0;

const float kNoLuma = -1.0; // lumas are not negative

const Signal kNoSignal = Signal(vec4(0.0), vec3(0.0));

float luma(Signal s) { return kIsDirectional ? s.value.w : s.value.x; }

// eps on both sides: black stays black instead of 0 / 0.
Signal changeLuma(Signal s, float newLuma)
{
    float scale = (newLuma + NRD_LUMA_EPS) / (luma(s) + NRD_LUMA_EPS);
    if (kIsOcclusion) return Signal(vec4(newLuma, 0.0, 0.0, newLuma), s.axis);
    return Signal(vec4(s.value.xyz * scale, kIsDirectional ? newLuma : s.value.w), s.axis * scale);
}

// RELAX keeps variances over the squared luma, so that no radiance overflows a half float.
Signal withVariance(Signal s, float variance)
{
    s.value.w = min(variance / max(square(luma(s)), 1e-12), NRD_FP16_MAX);
    return s;
}

Signal capLuma(Signal s, float cap) { return luma(s) > cap ? changeLuma(s, cap) : s; }

// Selected, not multiplied: what a weight of 0 rejects may hold anything.
Signal addWeighted(Signal sum, Signal s, float weight)
{
    if (!(weight > 0.0)) return sum;
    return Signal(sum.value + s.value * weight, sum.axis + s.axis * weight);
}

Signal scaled(Signal s, float scale) { return Signal(s.value * scale, s.axis * scale); }

Signal mixSignals(Signal a, Signal b, float weight, float hitDistWeight)
{
    vec4 value = vec4(mix(a.value.xyz, b.value.xyz, weight), mix(a.value.w, b.value.w, hitDistWeight));
    return Signal(value, mix(a.axis, b.axis, weight));
}

// Catmull-Rom has negative lobes; negative energy left in the chroma circulates as coloured speckle.
vec4 clampNegatives(vec4 value)
{
    if (kIsOcclusion) return vec4(saturate(value.x), 0.0, 0.0, saturate(value.x));
    if (kIsDirectional) return vec4(clamp(value.xyz, -1.0, 1.0), saturate(value.w));
    float w = kIsRelax ? max(value.w, 0.0) : saturate(value.w);
    return vec4(NRD_LinearToYCoCg(NRD_YCoCgToLinear(value.xyz)), w);
}

//----------------------------------------------------------------------------------------------------------------------
// As the application hands it over

// Noisy input may be anything; what is not finite counts as "no sample".
vec4 sanitize(vec4 value, out bool isValid)
{
    if (kIsOcclusion) value = vec4(value.x, 0.0, 0.0, value.x);
    isValid = NRD_IsRadianceFinite(value.xyz) && NRD_IsFinite(value.w);
    if (!isValid) return vec4(0.0);
    if (kIsBounded) return vec4(clamp(value.xyz, -1.0, 1.0), saturate(value.w));
    if (kIsRelax)
        return vec4(NRD_LinearToYCoCg(clamp(value.xyz, 0.0, NRD_FP16_MAX)), clamp(value.w, 0.0, NRD_FP16_MAX));
    return clamp(value, vec4(0.0, -NRD_FP16_MAX, -NRD_FP16_MAX, 0.0), vec4(vec3(NRD_FP16_MAX), 1.0));
}

// A direction that is not finite is none, and none is longer than its luma.
vec3 sanitizeAxis(vec3 axis, float Y)
{
    if (!NRD_IsRadianceFinite(axis)) return vec3(0.0);
    axis = clamp(axis, -NRD_FP16_MAX, NRD_FP16_MAX);
    return axis * min(1.0, Y * inversesqrt(max(dot(axis, axis), 1e-20)));
}

// value: of the first texture, sane.
Signal withInputAxis(vec4 value, texture2D second, ivec2 texel)
{
    return Signal(value, kIsSh ? sanitizeAxis(texelFetch(second, texel, 0).xyz, value.x) : vec3(0.0));
}

Signal readInput(texture2D t, texture2D second, ivec2 texel, out bool isValid)
{
    return withInputAxis(sanitize(texelFetch(t, texel, 0), isValid), second, texel);
}

//----------------------------------------------------------------------------------------------------------------------
// Inside. Axes are kept relative to luma.

vec4 decodeValue(vec4 stored) { return kIsOcclusion ? vec4(stored.x, 0.0, 0.0, stored.x) : stored; }

Signal readSignal(texture2D t, texture2D second, ivec2 texel)
{
    vec4 value = decodeValue(texelFetch(t, texel, 0));
    return Signal(value, kIsSh ? decodeAxis(texelFetch(second, texel, 0).xyz) * value.x : vec3(0.0));
}

vec4 encodeValue(Signal s) { return kIsBounded ? s.value : roundToHalf(s.value); }

vec4 encodeAxis(Signal s, ivec2 pixel)
{
    uint seed = seedPixel(pixel, g.frameIndex);
    vec3 dither = vec3(nextRandom(seed), nextRandom(seed), nextRandom(seed));
    return vec4(encodeAxis(s.axis / max(s.value.x, NRD_LUMA_EPS), dither), 0.0);
}

void storeSignal(writeonly image2D t, writeonly image2D second, ivec2 pixel, Signal s)
{
    imageStore(t, pixel, encodeValue(s));
    if (kIsSh) imageStore(second, pixel, encodeAxis(s, pixel));
}

// As the application receives it: with the axis in units of radiance again, or with the history length.
void storeOutput(writeonly image2D t, writeonly image2D second, ivec2 pixel, Signal s, float n)
{
    if (kIsRelax) s.value = vec4(kIsSh ? s.value.xyz : NRD_YCoCgToLinear(s.value.xyz), n);
    if (!kIsRelax && !kIsBounded && g.returnHistoryLength != 0u) s.value.w = n;
    imageStore(t, pixel, encodeValue(s));
    if (kIsSh) imageStore(second, pixel, roundToHalf(vec4(s.axis, 0.0)));
}

#endif
