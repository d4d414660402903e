// Fills pixels with a short history from a wide sparse neighbourhood. Needs gIn_ViewZ, gIn_NormalRoughness, gIn_Length.
#ifndef HISTORY_FIX_GLSL
#define HISTORY_FIX_GLSL
#include "spatial_filter.glsl"

// Which share of a pixel and its 2x2 partners needs the fix: a smaller stride where they are stable.
vec2 fixAmount(ivec2 position, vec2 n)
{
    vec2 own = vec2(lessThan(n, vec2(g.historyFixFrameNum)));
    vec2 sum = own;
    for (int i = 0; i < 2; i++)
    {
        ivec2 partner = clampToRect(position ^ ivec2(1 - i, i));
        if (!isInRange(decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(partner), 0).x))) continue;
        sum += vec2(lessThan(unpackLengths(texelFetch(gIn_Length, partner, 0).xy), vec2(g.historyFixFrameNum)));
    }
    return min(own, sum * (1.0 / 3.0));
}

float fixTapWeight(Pixel p, Lobe lobe, bool isSpecular, ivec2 pixel, Weights w)
{
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0));
    float weight = heavy(angleBetween(p.guide.N, guide.N) * w.normal);
    weight *= soft(planeDistance(p.plane, vec2(pixel), viewZ));
    if (isSpecular) weight *= heavy(abs(square(guide.roughness) - square(p.guide.roughness)) * w.roughness);
    bool isUsed = isInRange(viewZ) && isSameMaterial(p.guide.materialID, guide.materialID, lobe.minMaterial);
    return isUsed ? weight : 0.0;
}

// What a tap is compared with.
struct Fix
{
    Pixel p;
    Lobe lobe;
    bool isSpecular;
    Weights w;
    float hitDist; // normalised
    int step;
    Signal sum;
    float weightSum;
};

// 5x5 grid without corners and centre; taps that already have history count for more.
void addFixTap(inout Fix f, texture2D t, texture2D second, ivec2 offset)
{
    bool isTap = offset.x * offset.x + offset.y * offset.y != 8 && offset != ivec2(0);
    ivec2 pixel = mirrorPixel(ivec2(f.p.position) + offset * f.step);
    float weight = fixTapWeight(f.p, f.lobe, f.isSpecular, pixel, f.w);
    Signal value = readSignal(t, second, pixel);
    weight *= heavy(abs(value.value.w - f.hitDist) * f.w.hitDist);
    vec2 n = unpackLengths(texelFetch(gIn_Length, pixel, 0).xy);
    weight *= isTap ? 1.0 + n[f.isSpecular ? kSpecularChannel : 0] : 0.0;
    f.sum = addWeighted(f.sum, value, weight);
    f.weightSum += weight > 0.0 ? weight : 0.0; // not NaN
}

Signal fixHistory(texture2D t, texture2D second, Signal centre, Pixel p, Lobe lobe, bool isSpecular, float n,
                  float amount, float tracking)
{
    float alpha = newSampleWeight(n);
    float spread = NRD_GetLobeSpread(lobe.roughness, 0.25);
    float hitDist = getHitDist(centre.value.w, p.viewZ, lobe.roughness);
    // Tracking distance guides sharp lobes better, but as a minimum it is too small for rough ones.
    if (isSpecular && !kIsBounded) hitDist = mix(tracking, hitDist, spread);
    float reference = REBLUR_FrontEnd_GetNormHitDist(hitDist, p.viewZ, g.hitDistanceParameters.xyz, lobe.roughness);
    bool isAlternate = kHasMaterialTest && p.guide.materialID == g.historyFixAlternateMaterialID;
    float stride = 0.5 * amount * (isAlternate ? g.historyFixAlternateStride : g.historyFixStride);
    stride *= mix(0.25 + 0.75 * sqrt(hitDistFactor(hitDist, p.frustumSize)), 1.0, alpha);
    if (isSpecular) stride *= mix(0.25, 1.0, spread);
    int step = int(stride + 0.5);
    if (step == 0) return centre;

    Weights w = makeWeights(p, lobe, isSpecular, alpha, 1.0, 0.0);
    float m = square(lobe.roughness);
    w.roughness = 1.0 / mix(0.01, 1.0, mix(m * m, m, saturate(sqrt(g.roughnessFraction))));
    Fix f = Fix(p, lobe, isSpecular, w, reference, step, scaled(centre, 1.0 + n), 1.0 + n);
    if (kIsSoftware)
    {
        // A processor runs through the body of a loop once even where there is nothing to fix.
        [[dont_unroll]] for (int i = 0; i < 25; i++) addFixTap(f, t, second, ivec2(i % 5, i / 5) - 2);
    }
    else
    {
        // Row by row, without a branch round a read, so that those of a row are under way at once.
        [[dont_unroll]] for (int y = -2; y <= 2; y++)
        [[unroll]] for (int x = -2; x <= 2; x++) addFixTap(f, t, second, ivec2(x, y));
    }
    return scaled(f.sum, 1.0 / f.weightSum);
}

#endif
