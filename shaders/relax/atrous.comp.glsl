// One step of the edge-avoiding wavelet (Dammertz et al. 2010), steered by variance (Schied et al. 2017). The last
// step writes the outputs.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "bindings.h"

layout(constant_id = SPEC_STEP) const int kStep = 0;
#include "edge_stops.glsl"

layout(constant_id = SPEC_IS_LAST) const bool kIsLast = false;

layout(local_size_x = 8, local_size_y = 16) in;
#define FIRST_SIGNAL (4 + LOBE_NUM + HAS_SPECULAR)
#define FIRST_OUT (FIRST_SIGNAL + SIGNAL_NUM)
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Length;
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_DiffuseConfidence;
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Diffuse;
#if IS_SH
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM) uniform texture2D gIn_DiffuseSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_DiffuseSh;
#endif
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 3 + LOBE_NUM) uniform texture2D gIn_SpecularConfidence;
layout(set = SET_RESOURCES, binding = 4 + LOBE_NUM) uniform texture2D gIn_Confidence; // in the reprojection
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM - 1) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
#if IS_SH
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + 2 * LOBE_NUM - 1) uniform texture2D gIn_SpecularSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2 * LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularSh;
#endif
#endif

const float kCentreWeight = 0.2, kNeighbourWeight = 0.16;

// Four neighbours, on the axes and on the diagonals by turns. All eight in each step cost twice the time for 0.2 dB.
ivec2 tapOffset(int i)
{
    ivec2 axis = i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5);
    return kStep % 2 == 0 ? axis : ivec2(axis.x - axis.y, axis.x + axis.y);
}

// Variance of what is stored, not of a sample: a mean of n samples has an n-th of it.
float varianceOf(Signal s) { return s.value.w * square(luma(s)); }

// What is read of the pixels that are mixed in.
struct Taps
{
    Neighbour others[4];
    float kernels[4];
};

Neighbour readNeighbour(Pixel p, ivec2 pixel)
{
    return makeNeighbour(p, pixel, decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x),
                         decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0)));
}

// Of the centre; smoothed over the taps, since a variance of few samples is noise itself.
float smoothedVariance(Signal centre, Signal values[4], Taps taps)
{
    float sum = varianceOf(centre), count = 1.0;
    [[unroll]] for (int i = 0; i < 4; i++)
    {
        sum += taps.others[i].isInRange ? varianceOf(values[i]) : 0.0;
        count += taps.others[i].isInRange ? 1.0 : 0.0;
    }
    return sum / count;
}

// White noise breaks the ringing that a lattice with gaps leaves.
ivec2 jitter(ivec2 position)
{
    int step = 1 << kStep;
    if (step <= 4) return ivec2(0);
    uint seed = seedPixel(position, g.frameIndex + uint(kStep));
    vec2 u = vec2(nextRandom(seed), nextRandom(seed));
    return ivec2(float(step) * (u - 0.5) * 0.5);
}

float doubtOf(texture2D confidences, vec2 uv)
{
    if (!kHasConfidence) return 0.0;
    float given = textureLod(sampler2D(confidences, gLinearClamp), uv, 0.0).x;
    return saturate(g.relaxDoubt.x * (1.0 - given));
}

// One lobe of one pixel.
struct Filter
{
    Lobe lobe;
    Stops stops;
    float luma;
    float variance;
    Signal sum;
    float varianceSum;
    float weightSum;
};

Filter startFilter(Signal centre, Lobe lobe, Stops stops, float phi, float variance)
{
    stops.luma = 1.0 / max(phi * sqrt(variance), 1e-4 * luma(centre) + 1e-7);
    float own = kCentreWeight;
    return Filter(lobe, stops, luma(centre), variance, scaled(centre, own), variance * own * own, own);
}

// Selects instead of branches; a value of no weight may be anything.
void addTap(inout Filter f, Signal value, Pixel p, bool isSpecular, Neighbour other, float kernel)
{
    float weight = kernel * tapWeight(p, f.lobe, isSpecular, other, f.stops);
    weight = weight > 1e-4 ? weight * lumaStop(f.luma, luma(value), f.stops) : 0.0;
    float tapVariance = kStep == 0 ? f.variance : varianceOf(value);
    f.sum = addWeighted(f.sum, value, weight);
    f.varianceSum += weight > 0.0 ? tapVariance * weight * weight : 0.0;
    f.weightSum += weight;
}

Signal finish(Filter f)
{
    Signal result = scaled(f.sum, 1.0 / f.weightSum);
    return withVariance(result, f.varianceSum / (f.weightSum * f.weightSum));
}

// values: of the taps. stops: but for luma.
Signal filterLobe(Signal centre, Signal values[4], Taps taps, Pixel p, Lobe lobe, bool isSpecular, Stops stops)
{
    float variance = kStep == 0 ? smoothedVariance(centre, values, taps) : varianceOf(centre);
    Filter f = startFilter(centre, lobe, stops, isSpecular ? g.relaxPhi.y : g.relaxPhi.x, variance);
    [[unroll]] for (int i = 0; i < 4; i++) addTap(f, values[i], p, isSpecular, taps.others[i], taps.kernels[i]);
    return finish(f);
}

void store(writeonly image2D t, writeonly image2D second, ivec2 position, Signal signal, float n)
{
    if (kIsLast)
        storeOutput(t, second, position, signal, n);
    else
        storeSignal(t, second, position, signal);
}

void main()
{
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (texelFetch(gIn_Tiles, position / TILE_SIZE, 0).x > 0.5 || !isInRect(position)) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(position), 0).x);
    if (!isInRange(viewZ)) return;
    Pixel p = makePixel(position, viewZ, decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(position), 0)));
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
    Taps taps;
    Signal diffuseTaps[4], specularTaps[4];
    ivec2 shift = jitter(position);
    // Unrolled and without a branch, so that the reads of all taps are under way at once.
    [[unroll]] for (int i = 0; i < 4; i++)
    {
        ivec2 pixel = position + tapOffset(i) * (1 << kStep) + shift;
        ivec2 inside = clampToRect(pixel);
        taps.kernels[i] = inside == pixel ? kNeighbourWeight : 0.0;
        taps.others[i] = readNeighbour(p, inside);
#if HAS_DIFFUSE
        diffuseTaps[i] = readSignal(gIn_Diffuse, gIn_DiffuseSh, inside);
#endif
#if HAS_SPECULAR
        specularTaps[i] = readSignal(gIn_Specular, gIn_SpecularSh, inside);
#endif
    }
#if HAS_DIFFUSE
    Lobe diffuseLobe = Lobe(1.0, g.minMaterialForDiffuse, 0.0);
    Stops diffuseStops = makeStops(p, diffuseLobe, false, n.x, 1.0, doubtOf(gIn_DiffuseConfidence, p.uv));
    Signal diffuse = readSignal(gIn_Diffuse, gIn_DiffuseSh, position);
    diffuse = filterLobe(diffuse, diffuseTaps, taps, p, diffuseLobe, false, diffuseStops);
    store(gOut_Diffuse, gOut_DiffuseSh, position, diffuse, n.x);
#endif
#if HAS_SPECULAR
    Lobe specularLobe = Lobe(p.guide.roughness, g.minMaterialForSpecular, 0.0);
    float nSpecular = n[kSpecularChannel];
    float confidence = texelFetch(gIn_Confidence, position, 0).x;
    Stops stops = makeStops(p, specularLobe, true, nSpecular, confidence, doubtOf(gIn_SpecularConfidence, p.uv));
    Signal specular = readSignal(gIn_Specular, gIn_SpecularSh, position);
    specular = filterLobe(specular, specularTaps, taps, p, specularLobe, true, stops);
    store(gOut_Specular, gOut_SpecularSh, position, specular, nSpecular);
#endif
}
