// Spatial reuse before accumulation: completes what the application left out, lowers the variance of the input, drops
// what is not finite, and finds the distance of the nearest reflected surface for tracking.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "spatial_filter.glsl"
#include "checkerboard.glsl"

#define HAS_CAP (1 - IS_BOUNDED)
#define FIRST_OUT (3 + SIGNAL_NUM + 2 * HAS_CAP)
layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Diffuse;
#if IS_SH
layout(set = SET_RESOURCES, binding = 3 + LOBE_NUM) uniform texture2D gIn_DiffuseSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_DiffuseSh;
#endif
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 2 + LOBE_NUM) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
#if IS_SH
layout(set = SET_RESOURCES, binding = 2 + 2 * LOBE_NUM) uniform texture2D gIn_SpecularSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2 * LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularSh;
#endif
#if IS_BOUNDED == 0
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM) uniform writeonly image2D gOut_TrackNew;
#endif
#endif
#if HAS_CAP
layout(set = SET_RESOURCES, binding = 3 + SIGNAL_NUM) uniform texture2D gIn_Cap;
layout(set = SET_RESOURCES, binding = 4 + SIGNAL_NUM) uniform utexture2D gIn_Cut;
#include "read_cap.glsl"
#endif

#include "complete_input.glsl"

// Four taps, over which eight gain 0.1 dB. RELAX's rank filter, where it is on, would cut what four leave standing.
const bool kHasAllTaps = kIsRelax && kHasAntiFirefly;
const int kTapNum = kHasAllTaps ? 8 : 4;
const float kTapRadius = kHasAllTaps ? 1.0 : 0.8; // share of the radius
const float kNarrowing = 1.0 / 11.0;
const float kFractionScale = 2.0;
// Hit distances are noise here. A strict weight starves samples with rare distances, which are the bright ones where
// the light is small: that loses energy.
const float kHitDistScale = 2.0;

// Keeps the kernel inside 30 % of the lobe's footprint at the distance of the image: no halos round sharp reflections.
float limitSpecularRadius(Pixel p, Lobe lobe, float hitDist, float radius)
{
    float factor = dominantFactor(p.NoV, lobe.roughness);
    float NoD = abs(dot(p.Nv, dominantDirection(p.Nv, p.Vv, factor)));
    float footprint = hitDist * NoD * lobeTangent(lobe.roughness, 0.3);
    return min(radius, footprint / getPixelSize(p.viewZ + hitDist * factor));
}

// Taps whose reflected point is nearer than they are to the centre lie at a contact and must not bleed. The root keeps
// more of the energy of ordinary taps: without it glossy metal lost 1 dB.
float contactGuard(float roughness, float tapHitDist, float centreHitDist, float distance)
{
    return mix(sqrt(saturate(tapHitDist / (distance + kEps + centreHitDist))), 1.0, ramp(0.5, 1.0, roughness));
}

// What taps gathered. Those without a sample carry the zeros that balance the brightness of the others, so they must
// count as much as those do on average: less would add energy, more would lose it.
struct TapSums
{
    Signal known;
    Signal unknown;
    float knownWeight;
    float knownShare; // of the weight above, what it is before hit distances are looked at
    float unknownShare;
};

// share: by geometry; affinity: by hit distance, of no meaning where there is none.
void addTap(inout TapSums sums, Signal value, float share, float affinity, bool isKnown)
{
    if (isKnown)
    {
        sums.known = addWeighted(sums.known, value, share * affinity);
        sums.knownWeight += max(share * affinity, 0.0);
        sums.knownShare += max(share, 0.0);
    }
    else if (!kIsBounded) // hit distances are the signal there: nothing is known at all
    {
        sums.unknown = addWeighted(sums.unknown, value, share);
        sums.unknownShare += max(share, 0.0);
    }
}

// With the centre, if it takes part.
Signal resolveTaps(TapSums sums, Signal own, Centre centre)
{
    float affinity = sums.knownShare > 0.0 ? sums.knownWeight / sums.knownShare : 1.0;
    Signal sum = centre.isValid ? own : kNoSignal;
    sum = addWeighted(addWeighted(sum, sums.known, 1.0), sums.unknown, affinity);
    float weightSum = (centre.isValid ? 1.0 : 0.0) + sums.knownWeight + sums.unknownShare * affinity;
    if (weightSum > 0.0) return scaled(sum, 1.0 / weightSum);
    if (!kIsBounded && !centre.isFound) own.value.w = kNoSample;
    return own;
}

struct Filtered
{
    Signal signal;
    float tracking; // world units, 0 = unknown
};

Filtered prefilter(texture2D t, texture2D second, Pixel p, Lobe lobe, bool isSpecular, Centre centre,
                   float maxLuma)
{
    float hitDist = getHitDist(centre.hitDist, p.viewZ, lobe.roughness);
    Signal own = capLuma(centre.signal, maxLuma);
    own.value.w = centre.hitDist;
    if (kIsOcclusion) own.value.x = centre.hitDist;
    if (lobe.maxRadius == 0.0 && centre.isValid) return Filtered(own, hitDist);

    float radius = blurRadius(lobe, hitDistFactor(hitDist, p.frustumSize), 1.0);
    if (isSpecular) radius = limitSpecularRadius(p, lobe, hitDist, radius);
    float minHitDist = g.minHitDistanceWeight * kFractionScale * NRD_GetLobeSpread(lobe.roughness, 0.5);
    Weights w = makeWeights(p, lobe, isSpecular, kNarrowing, kFractionScale, minHitDist);
    w.hitDist = kHitDistScale;
    uint seed = seedPixel(centre.pixel, g.frameIndex);
    float nearest = hitDist > 0.0 ? hitDist : 1e30;
    vec4 axes = g.rotatorPrePass * (radius * kTapRadius);
    TapSums sums = TapSums(kNoSignal, kNoSignal, 0.0, 0.0, 0.0);
    for (int i = 0; i < kTapNum; i++)
    {
        bool isInside;
        vec2 position = snapToData(p.position + rotateTap(axes, kTaps[i].xy), isSpecular, i, isInside);
        Tap tap = readTap(gIn_ViewZ, gIn_NormalRoughness, p, lobe, isSpecular, w, position,
                          kHasAllTaps ? kTaps[i].z : 1.0, true);
        bool isTapValid;
        Signal value = capLuma(readInput(t, second, inputTexel(tap.pixel), isTapValid), maxLuma);
        float share = isTapValid && isInside ? tap.weight : 0.0;
        float affinity = hitDistWeight(w, centre.hitDist, value.value.w);
        if (isSpecular)
        {
            float tapHitDist = getHitDist(value.value.w, tap.viewZ, tap.guide.roughness);
            // A stochastic minimum: the nearest reflected surface wins, dissimilar and grazing taps rarely count.
            if (tapHitDist > 0.0 && nextRandom(seed) < share * p.NoV) nearest = min(nearest, tapHitDist);
            affinity *= contactGuard(lobe.roughness, tapHitDist, hitDist, distance(viewPosition(tap), p.Xv));
            if (g.isPrepassTrackingOnly != 0u) share = 0.0;
        }
        bool isKnown = value.value.w > 0.0 || g.reconstructionRadius == 0;
        if (value.value.w == 0.0) value.value.w = centre.hitDist; // unknown, not near
        addTap(sums, value, share, affinity, isKnown);
    }
    float tracking = nearest == 1e30 ? 0.0 : nearest;
    return Filtered(resolveTaps(sums, own, centre), tracking);
}

void main()
{
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    ivec2 tile = position / TILE_SIZE;
    if (texelFetch(gIn_Tiles, tile, 0).x > 0.5 || !isInRect(position)) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(position), 0).x);
    if (!isInRange(viewZ)) return;
    vec2 cap = vec2(NRD_FP16_MAX);
#if HAS_CAP
    if (kHasAntiFirefly) cap = readTileCap(tile);
#endif
    Pixel p = makePixel(position, viewZ, decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(position), 0)));
#if HAS_DIFFUSE
    // Where the hit distance is the signal, a radius that follows its noise spreads the large values and keeps the small
    // ones: occlusion comes out 3 % too dark.
    Lobe diffuse = Lobe(1.0, g.minMaterialForDiffuse, kIsBounded ? 0.0 : g.diffusePrepassRadius);
    Centre diffuseCentre = completeCentre(gIn_Diffuse, gIn_DiffuseSh, p, diffuse, false, position);
    Filtered filteredDiffuse = prefilter(gIn_Diffuse, gIn_DiffuseSh, p, diffuse, false, diffuseCentre, cap.x);
    storeSignal(gOut_Diffuse, gOut_DiffuseSh, position, filteredDiffuse.signal);
#endif
#if HAS_SPECULAR
    const int c = kSpecularChannel;
    Lobe specular = Lobe(p.guide.roughness, g.minMaterialForSpecular, kIsBounded ? 0.0 : g.specularPrepassRadius);
    Centre specularCentre = completeCentre(gIn_Specular, gIn_SpecularSh, p, specular, true, position);
    Filtered filteredSpecular = prefilter(gIn_Specular, gIn_SpecularSh, p, specular, true, specularCentre, cap[c]);
    storeSignal(gOut_Specular, gOut_SpecularSh, position, filteredSpecular.signal);
#if IS_BOUNDED == 0
    imageStore(gOut_TrackNew, position, vec4(min(filteredSpecular.tracking, kTrackingMax)));
#endif
#endif
}
