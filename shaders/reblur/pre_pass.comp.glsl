// Spatial reuse before accumulation: lowers the variance of the input, drops what is not finite, and finds the
// distance of the nearest reflected surface for tracking.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "spatial_filter.glsl"
#include "random.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = 3 + LOBE_NUM) uniform writeonly image2D gOut_Diffuse;
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 2 + LOBE_NUM) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = 2 + 2 * LOBE_NUM) uniform writeonly image2D gOut_Specular;
layout(set = SET_RESOURCES, binding = 3 + 2 * LOBE_NUM) uniform writeonly image2D gOut_TrackNew;
#endif

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

vec4 prefilter(texture2D signal, Pixel p, Lobe lobe, bool isSpecular, ivec2 position, out float tracking)
{
    bool isValid;
    vec4 centre = sanitize(texelFetch(signal, position, 0), isValid);
    float hitDist = getHitDist(centre.w, p.viewZ, lobe.roughness);
    tracking = hitDist;
    if (lobe.maxRadius == 0.0) return centre;

    float radius = blurRadius(lobe, 1.0, hitDistFactor(hitDist, p.frustumSize), 1.0);
    if (isSpecular) radius = limitSpecularRadius(p, lobe, hitDist, radius);
    float minHitDist = g.minHitDistanceWeight * kFractionScale * NRD_GetLobeSpread(lobe.roughness, 0.5);
    Weights w = makeWeights(p, lobe, isSpecular, kNarrowing, kFractionScale, minHitDist);
    w.hitDist = kHitDistScale;
    uint seed = seedPixel(position, g.frameIndex);
    float nearest = hitDist > 0.0 ? hitDist : 1e30;
    vec4 sum = centre;
    float weightSum = isValid ? 1.0 : 0.0;
    for (int i = 0; i < 8; i++)
    {
        vec2 uv = p.uv + rotateTap(g.rotatorPrePass, kTaps[i].xy) * radius * g.rectSizeInv;
        Tap tap = readTap(gIn_ViewZ, gIn_NormalRoughness, p, lobe, w, uv, kTaps[i].z);
        bool isTapValid;
        vec4 value = sanitize(texelFetch(signal, tap.pixel, 0), isTapValid);
        float weight = isTapValid ? tap.weight : 0.0;
        if (isSpecular)
        {
            float tapHitDist = getHitDist(value.w, tap.viewZ, tap.guide.roughness);
            // A stochastic minimum: the nearest reflected surface wins, dissimilar and grazing taps rarely count.
            if (tapHitDist > 0.0 && nextRandom(seed) < weight * p.NoV) nearest = min(nearest, tapHitDist);
            weight *= g.isPrepassTrackingOnly != 0u
                          ? 0.0
                          : contactGuard(lobe.roughness, tapHitDist, hitDist, distance(tap.Xv, p.Xv));
        }
        weight *= hitDistWeight(w, centre.w, value.w);
        sum += weight > 0.0 ? value * weight : vec4(0.0);
        weightSum += weight;
    }
    tracking = nearest == 1e30 ? 0.0 : nearest;
    return weightSum > 0.0 ? sum / weightSum : vec4(0.0);
}

void main()
{
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (texelFetch(gIn_Tiles, ivec2(gl_WorkGroupID.xy), 0).x > 0.5 || !isInRect(position)) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(position), 0).x);
    if (!isInRange(viewZ)) return;
    Pixel p = makePixel(position, viewZ, decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(position), 0)));
    float tracking;
#if HAS_DIFFUSE
    Lobe diffuse = Lobe(1.0, g.minMaterialForDiffuse, g.diffusePrepassRadius);
    vec4 diffuseSignal = prefilter(gIn_Diffuse, p, diffuse, false, position, tracking);
    imageStore(gOut_Diffuse, position, roundToHalf(diffuseSignal));
#endif
#if HAS_SPECULAR
    Lobe specular = Lobe(p.guide.roughness, g.minMaterialForSpecular, g.specularPrepassRadius);
    vec4 specularSignal = prefilter(gIn_Specular, p, specular, true, position, tracking);
    imageStore(gOut_Specular, position, roundToHalf(specularSignal));
    imageStore(gOut_TrackNew, position, vec4(min(tracking, kTrackingMax)));
#endif
}
