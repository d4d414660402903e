// Fills pixels with a short history from a wide sparse neighbourhood. Needs gIn_ViewZ, gIn_NormalRoughness, gIn_Length.
#ifndef HISTORY_FIX_GLSL
#define HISTORY_FIX_GLSL
#include "sparse_fill.glsl"

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

// The 5x5 without corners.
float fillWeight(Fill f, ivec2 offset, ivec2 pixel, Signal value)
{
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0)), own = f.p.guide;
    float weight = heavy(angleBetween(own.N, guide.N) * f.w.normal);
    weight *= soft(planeDistance(f.p.plane, vec2(pixel), viewZ));
    if (f.isSpecular) weight *= heavy(abs(square(guide.roughness) - square(own.roughness)) * f.w.roughness);
    weight *= heavy(abs(value.value.w - f.hitDist) * f.w.hitDist);
    bool isUsed = isInRange(viewZ) && isSameMaterial(own.materialID, guide.materialID, f.lobe.minMaterial);
    bool isCorner = offset.x * offset.x + offset.y * offset.y == 8;
    return isUsed && !isCorner ? weight : 0.0;
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
    return fillSparsely(Fill(p, lobe, isSpecular, w, reference, step), t, second, centre, n);
}

#endif
