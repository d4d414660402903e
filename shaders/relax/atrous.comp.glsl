// One step of the edge-avoiding wavelet (Dammertz et al. 2010), steered by variance (Schied et al. 2017). The first
// step estimates the variance of short histories from their neighbourhood; the last one writes the outputs.
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

// The first step looks at its neighbours' guides twice, for the variance and to filter, so a group decodes them once.
// Signals, and guides at larger strides, come faster through the texture cache.
const bool kAreGuidesShared = kStep == 0 && !kIsSoftware;
const ivec2 kGroup = ivec2(8, 16);
const int kHalo = 2;
const ivec2 kArea = kGroup + 2 * kHalo;
const int kAreaSize = kAreGuidesShared ? kArea.x * kArea.y : 1;

shared vec4 sNormalViewZ[kAreaSize];
shared vec2 sRoughnessMaterial[kAreaSize];

struct Texel
{
    float viewZ;
    Guide guide;
};

ivec2 areaCorner() { return ivec2(gl_WorkGroupID.xy) * kGroup - kHalo; }

Texel fetchTexel(ivec2 pixel)
{
    return Texel(decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x),
                 decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0)));
}

void shareGuides()
{
    for (int i = int(gl_LocalInvocationIndex); i < kAreaSize; i += kGroup.x * kGroup.y)
    {
        Texel texel = fetchTexel(clampToRect(areaCorner() + ivec2(i % kArea.x, i / kArea.x)));
        sNormalViewZ[i] = vec4(texel.guide.N, texel.viewZ);
        sRoughnessMaterial[i] = vec2(texel.guide.roughness, texel.guide.materialID);
    }
    barrier();
}

// Of a pixel in the rectangle.
Texel texelAt(ivec2 pixel)
{
    if (!kAreGuidesShared) return fetchTexel(pixel);
    ivec2 local = pixel - areaCorner();
    int i = local.y * kArea.x + local.x;
    return Texel(sNormalViewZ[i].w, Guide(sNormalViewZ[i].xyz, sRoughnessMaterial[i].x, uint(sRoughnessMaterial[i].y)));
}

// Variance of what is stored, not of a sample: a mean of n samples has an n-th of it.
float varianceOf(Signal s) { return s.value.w * square(luma(s)); }

Neighbour readNeighbour(Pixel p, ivec2 pixel)
{
    Texel texel = texelAt(pixel);
    return makeNeighbour(p, pixel, texel.viewZ, texel.guide);
}

// Of the centre; smoothed over 3x3, since a variance of few samples is noise itself.
float smoothedVariance(texture2D t, ivec2 position)
{
    float sum = 0.0, weightSum = 0.0;
    for (int i = 0; i < 9; i++)
    {
        ivec2 offset = ivec2(i % 3, i / 3) - 1;
        ivec2 pixel = clampToRect(position + offset);
        if (!isInRange(texelAt(pixel).viewZ)) continue;
        vec4 stored = texelFetch(t, pixel, 0);
        float weight = 1.0 / float(1 << (abs(offset.x) + abs(offset.y)));
        sum += stored.w * stored.x * stored.x * weight;
        weightSum += weight;
    }
    return sum / max(weightSum, kEps);
}

// Too few frames for a variance over time: one over 5x5 pixels, raised for what so few may miss.
float spatialVariance(texture2D t, Pixel p, Lobe lobe, bool isSpecular, ivec2 position, Stops stops)
{
    float mean = 0.0, square_ = 0.0, weightSum = 0.0;
    for (int i = 0; i < 25; i++)
    {
        ivec2 pixel = clampToRect(position + ivec2(i % 5, i / 5) - 2);
        float weight = tapWeight(p, lobe, isSpecular, readNeighbour(p, pixel), stops);
        float Y = weight > 0.0 ? texelFetch(t, pixel, 0).x : 0.0;
        mean += Y * weight;
        square_ += Y * Y * weight;
        weightSum += weight;
    }
    mean /= max(weightSum, kEps);
    return max(square_ / max(weightSum, kEps) - mean * mean, 0.0);
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

Filter startFilter(texture2D t, texture2D second, Pixel p, Lobe lobe, bool isSpecular, ivec2 position, float n,
                   Stops stops)
{
    Signal centre = readSignal(t, second, position);
    float variance = varianceOf(centre);
    if (kStep == 0)
    {
        bool isShort = n + 1.0 < g.relaxSpatialVarianceFrameNum;
        variance = isShort ? spatialVariance(t, p, lobe, isSpecular, position, stops) * max(1.0, 4.0 / (n + 2.0))
                           : smoothedVariance(t, position);
    }
    float phi = isSpecular ? g.relaxPhi.y : g.relaxPhi.x;
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
    float variance = f.varianceSum / (f.weightSum * f.weightSum);
    result.value.w = min(variance / max(square(luma(result)), 1e-12), NRD_FP16_MAX);
    return result;
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
    ivec2 tile = ivec2(gl_WorkGroupID.xy) * kGroup / TILE_SIZE;
    if (texelFetch(gIn_Tiles, tile, 0).x > 0.5) return; // the same for the whole group
    if (kAreGuidesShared) shareGuides();
    if (!isInRect(position)) return;
    Texel texel = texelAt(position);
    if (!isInRange(texel.viewZ)) return;
    Pixel p = makePixel(position, texel.viewZ, texel.guide);
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
#if HAS_DIFFUSE
    Lobe diffuseLobe = Lobe(1.0, g.minMaterialForDiffuse, 0.0);
    Stops diffuseStops = makeStops(p, diffuseLobe, false, n.x, 1.0, doubtOf(gIn_DiffuseConfidence, p.uv));
    Filter diffuse = startFilter(gIn_Diffuse, gIn_DiffuseSh, p, diffuseLobe, false, position, n.x, diffuseStops);
#endif
#if HAS_SPECULAR
    Lobe specularLobe = Lobe(p.guide.roughness, g.minMaterialForSpecular, 0.0);
    float nSpecular = n[kSpecularChannel];
    float confidence = texelFetch(gIn_Confidence, position, 0).x;
    Stops stops = makeStops(p, specularLobe, true, nSpecular, confidence, doubtOf(gIn_SpecularConfidence, p.uv));
    Filter specular = startFilter(gIn_Specular, gIn_SpecularSh, p, specularLobe, true, position, nSpecular, stops);
#endif
    ivec2 shift = jitter(position);
    // Unrolled and without a branch, so that the reads of all taps are under way at once.
    [[unroll]] for (int i = 0; i < 4; i++)
    {
        ivec2 pixel = position + tapOffset(i) * (1 << kStep) + shift;
        ivec2 inside = clampToRect(pixel);
        float kernel = inside == pixel ? kNeighbourWeight : 0.0;
        Neighbour other = readNeighbour(p, inside);
#if HAS_DIFFUSE
        addTap(diffuse, readSignal(gIn_Diffuse, gIn_DiffuseSh, inside), p, false, other, kernel);
#endif
#if HAS_SPECULAR
        addTap(specular, readSignal(gIn_Specular, gIn_SpecularSh, inside), p, true, other, kernel);
#endif
    }
#if HAS_DIFFUSE
    store(gOut_Diffuse, gOut_DiffuseSh, position, finish(diffuse), n.x);
#endif
#if HAS_SPECULAR
    store(gOut_Specular, gOut_SpecularSh, position, finish(specular), nSpecular);
#endif
}
