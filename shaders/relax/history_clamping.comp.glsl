// Fills pixels with a short history from a wide sparse neighbourhood, bounds the long history by statistics of the
// short one, and antilag: both move towards the noisy present where they disagree with it by more than noise explains.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "spatial_filter.glsl"

layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Length;
#define FIRST_OUT (5 + SIGNAL_NUM)
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Diffuse;
#if IS_SH
layout(set = SET_RESOURCES, binding = 4 + LOBE_NUM) uniform texture2D gIn_DiffuseSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_DiffuseSh;
#endif
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 3 + LOBE_NUM) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
#if IS_SH
layout(set = SET_RESOURCES, binding = 3 + 2 * LOBE_NUM) uniform texture2D gIn_SpecularSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2 * LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularSh;
#endif
#endif
layout(set = SET_RESOURCES, binding = 4 + SIGNAL_NUM) uniform texture2D gIn_Fast; // per lobe: fast, noisy
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM) uniform writeonly image2D gOut_Fast;
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM + 1) uniform writeonly uimage2D gOut_PrevLength;
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM + 2) uniform writeonly image2D gOut_PrevViewZ;
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM + 3) uniform writeonly image2D gOut_PrevNormalRoughness;

#define PAIR_NUM (LOBE_NUM + 1) // per lobe: fast, noisy; then what the fast ones differ from the long history by
#include "luma_rows.glsl"

const int kChange = LOBE_NUM;
const float kRelitFrameNum = 4.0; // what a mean over 5x5 noisy pixels is worth

void readLumas(ivec2 pixel, out vec2 lumas[PAIR_NUM])
{
    vec4 stored = texelFetch(gIn_Fast, pixel, 0);
    lumas[0] = stored.xy;
    if (LOBE_NUM == 2) lumas[LOBE_NUM - 1] = stored.zw;
    lumas[kChange] = stored.xz - slowLumas(pixel);
}

// Valid texels by row of the window, and what of the 25 is missing.
struct Counts
{
    float rows[5];
    float missing;
};

Counts countTexels()
{
    Counts counts;
    counts.missing = 25.0;
    [[unroll]] for (int y = 0; y < 5; y++)
    {
        counts.rows[y] = rowCount(ivec2(gl_LocalInvocationID.xy) + ivec2(0, y));
        counts.missing -= counts.rows[y];
    }
    return counts;
}

// What is out of range counts as the centre. Squares of parts add up with those of their means.
Spread measure(int pair, Counts counts)
{
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    vec2 centre = texelAt(pair, local + kRadius), sum = vec2(0.0), means[5];
    [[unroll]] for (int y = 0; y < 5; y++)
    {
        means[y] = rowMean(pair, local + ivec2(0, y));
        sum += counts.rows[y] * (means[y] - centre);
    }
    vec2 mean = centre + sum / 25.0;
    vec2 squares = counts.missing * (centre - mean) * (centre - mean);
    [[unroll]] for (int y = 0; y < 5; y++)
        squares += rowSquares(pair, local + ivec2(0, y)) + counts.rows[y] * (means[y] - mean) * (means[y] - mean);
    return Spread(mean, sqrt(squares / 25.0));
}

struct Moments
{
    vec4 mean; // fast and noisy of one lobe, then of the other
    vec4 sigma;
    vec2 slow;        // mean of the long history, per lobe
    vec2 changeSigma; // of what the short history differs from it by
    // Below 1 where less of the window is in range than at the picture's corner: a pixel alone in the sky is its own
    // neighbourhood, whose noise is no change.
    float share;
};

Moments measureLumas()
{
    Counts counts = countTexels();
    Spread change = measure(kChange, counts), first = measure(0, counts), second = first;
    if (LOBE_NUM == 2) second = measure(LOBE_NUM - 1, counts);
    vec4 mean = vec4(first.mean, second.mean);
    return Moments(mean, vec4(first.sigma, second.sigma), mean.xz - change.mean, change.sigma,
                   min((25.0 - counts.missing) / 9.0, 1.0));
}

float fixTapWeight(Pixel p, Lobe lobe, bool isSpecular, ivec2 pixel, Weights w)
{
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0));
    float weight = soft(planeDistance(p.plane, vec2(pixel), viewZ));
    weight *= isSpecular ? heavy(angleBetween(p.guide.N, guide.N) * w.normal)
                         : pow(max(dot(p.guide.N, guide.N), 0.01), g.relaxFixNormalPower);
    if (isSpecular) weight *= soft(abs(guide.roughness - p.guide.roughness) * w.roughness);
    bool isUsed = isInRange(viewZ) && isSameMaterial(p.guide.materialID, guide.materialID, lobe.minMaterial);
    return isUsed ? weight : 0.0;
}

// Strides of 7, 5, 4, 3 pixels for histories of 1 to 4 frames.
Signal fixHistory(texture2D t, texture2D second, Pixel p, Lobe lobe, bool isSpecular, ivec2 position, float n)
{
    Signal centre = readSignal(t, second, position);
    if (n >= g.historyFixFrameNum) return centre;
    bool isAlternate = kHasMaterialTest && p.guide.materialID == g.historyFixAlternateMaterialID;
    float base = isAlternate ? g.historyFixAlternateStride : g.historyFixStride;
    int stride = int(base / (2.0 + n) + 0.5);
    Weights w = makeWeights(p, lobe, isSpecular, 1.0, 1.0, 0.0);
    int channel = isSpecular ? kSpecularChannel : 0;
    Signal sum = scaled(centre, 1.0 + n);
    float weightSum = 1.0 + n;
    // Row by row, without a branch round a read, so that those of a row are under way at once.
    [[dont_unroll]] for (int y = -2; y <= 2; y++)
    [[unroll]] for (int x = -2; x <= 2; x++)
    {
        ivec2 pixel = mirrorPixel(position + ivec2(x, y) * stride);
        bool isTap = x != 0 || y != 0;
        float weight = fixTapWeight(p, lobe, isSpecular, pixel, w);
        weight *= isTap ? 1.0 + unpackLengths(texelFetch(gIn_Length, pixel, 0).xy)[channel] : 0.0;
        sum = addWeighted(sum, readSignal(t, second, pixel), weight);
        weightSum += weight > 0.0 ? weight : 0.0; // not NaN
    }
    return scaled(sum, 1.0 / weightSum);
}

// Rank-conditioned rank selection over 3x3: what is brighter, or darker, than all of its like is an outlier.
Signal suppressFirefly(texture2D t, Pixel p, Lobe lobe, ivec2 position, Signal signal)
{
    float low = 1e30, high = -1.0, highest = -1.0;
    for (int i = 0; i < 9; i++)
    {
        ivec2 pixel = position + ivec2(i % 3, i / 3) - 1;
        if (i == 4 || clampToRect(pixel) != pixel) continue;
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
        Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0));
        bool isLike = isInRange(viewZ) && dot(guide.N, p.guide.N) > 0.99 &&
                      planeDistance(p.plane, vec2(pixel), viewZ) < 1.0 &&
                      isSameMaterial(p.guide.materialID, guide.materialID, lobe.minMaterial);
        float Y = texelFetch(t, pixel, 0).x;
        if (isInRange(viewZ)) highest = max(highest, Y);
        if (!isLike) continue;
        low = min(low, Y);
        high = max(high, Y);
    }
    // Without its like a pixel has nothing that would spread a firefly either.
    if (high < 0.0) return highest < 0.0 ? signal : capLuma(signal, highest);
    return changeLuma(signal, clamp(luma(signal), low, high));
}

struct Lumas
{
    float slow;
    float fast;
};

float moveTowards(float value, float target, float amount)
{
    return value + clamp(target - value, -amount, amount);
}

// The share of the way from the slow to the fast history that clamping took.
float pullOf(float slow, float clamped, float fast)
{
    float way = fast - slow;
    return abs(way) > kEps ? saturate((clamped - slow) / way) : 0.0;
}

// How far a difference of means is more than noise, by its standard error; neighbours that share samples count as 16 of
// the 25 pixels.
float excessAmount(float difference, float sigma, float noisySigma, float share)
{
    float noise = inversesqrt(max(16.0 * share, 1.0)) * (g.relaxAntilag.y * sigma + g.relaxAntilag.z * noisySigma) + kEps;
    return saturate(2.0 * g.relaxAntilag.w * max(abs(difference) / noise - 1.0, 0.0));
}

// By how much light has changed, as means of 5x5 pixels show it, in which detail cancels out. A great change shows in
// the noisy present at once, a smaller one in the fast history later. Samples vary as much as they did over time,
// sampleSigma: where rare ones carry the light, a window without any is dark and calm, and no change.
float changeAmount(int lobe, float sampleSigma, Moments m)
{
    float noisySigma = max(m.sigma[2 * lobe + 1], sampleSigma);
    // In the dark nothing is noisy. If that alone made it easier to go dark than to light up, what blinks would lose up
    // to half of its energy; a quarter of what samples vary by keeps it, and costs a frame when a light goes off.
    float presentSigma = max(m.sigma[2 * lobe + 1], mix(1.0, 0.25, m.share) * sampleSigma);
    return max(excessAmount(m.mean[2 * lobe] - m.slow[lobe], m.changeSigma[lobe], presentSigma, m.share),
               excessAmount(m.mean[2 * lobe + 1] - m.slow[lobe], noisySigma, noisySigma, m.share));
}

// A history under the light that its neighbourhood has now: dimmed or raised as a whole, so that detail stays and noise
// is that of a mean over 5x5 pixels.
float relight(float slow, int lobe, Moments m)
{
    float before = m.slow[lobe], now = m.mean[2 * lobe + 1];
    return now < before ? slow * now / before : slow + now - before;
}

Lumas bound(int lobe, bool isSpecular, float slow, float amount, Moments m)
{
    ivec2 local = ivec2(gl_LocalInvocationID.xy) + kRadius;
    float fast = texelAt(lobe, local).x;
    float mean = m.mean[2 * lobe], sigma = m.sigma[2 * lobe] * g.fastClampSigmaScale;
    // Widened to the centre's own fast value, which keeps bright details alive.
    float clamped = clamp(slow, min(mean - sigma, fast), max(mean + sigma, fast));
    int i = isSpecular ? 1 : 0;
    if (g.maxFastAccumulatedFrameNum[i] >= g.maxAccumulatedFrameNum[i]) clamped = slow; // nothing to bound it with
    float pull = pullOf(slow, clamped, fast);

    float present = m.mean[2 * lobe + 1];
    float push = 10.0 * g.relaxAntilag.x * abs(fast - slow) * pull * (isSpecular ? 0.33 : 1.0) * m.share;
    float lit = relight(slow, lobe, m);
    return Lumas(mix(moveTowards(clamped, present, push), lit, amount),
                 mix(moveTowards(fast, present, push), lit, amount));
}

// Returns the fast history to keep. The variance stays while the mean moves.
float boundSignal(inout Signal signal, int lobe, bool isSpecular, inout float n, Moments m)
{
    float slow = luma(signal);
    if (n < g.historyFixFrameNum) return slow; // what was just filled in is the best there is
    float amount = changeAmount(lobe, slow * sqrt(signal.value.w), m);
    Lumas lumas = bound(lobe, isSpecular, slow, amount, m);
    float variance = signal.value.w * square(max(slow, lumas.slow));
    signal = changeLuma(signal, lumas.slow);
    signal.value.w = min(variance / max(square(lumas.slow), 1e-12), NRD_FP16_MAX);
    n = mix(n, min(n, kRelitFrameNum), amount);
    return lumas.fast;
}

void main()
{
    ivec2 group = ivec2(gl_WorkGroupID.xy) * ivec2(8, 16);
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    bool isInside = isInRect(position);
    float storedViewZ = texelFetch(gIn_ViewZ, guideTexel(clampToRect(position)), 0).x;
    // Copied before any exit: a stale depth in sky would let the next frame accept garbage.
    if (isInside) imageStore(gOut_PrevViewZ, position, vec4(storedForNext(storedViewZ)));
    if (texelFetch(gIn_Tiles, group / TILE_SIZE, 0).x > 0.5) return; // the same for the whole group
    measureRows(group);
    float viewZ = decodeViewZ(storedViewZ);
    if (!isInside || !isInRange(viewZ)) return;
    vec4 packedGuide = texelFetch(gIn_NormalRoughness, guideTexel(position), 0);
    imageStore(gOut_PrevNormalRoughness, position, packedGuide);
    Pixel p = makePixel(position, viewZ, decodeGuide(packedGuide));
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
#if HAS_DIFFUSE
    Lobe diffuseLobe = Lobe(1.0, g.minMaterialForDiffuse, 0.0);
    Signal diffuse = fixHistory(gIn_Diffuse, gIn_DiffuseSh, p, diffuseLobe, false, position, n.x);
    if (kHasAntiFirefly) diffuse = suppressFirefly(gIn_Diffuse, p, diffuseLobe, position, diffuse);
#endif
#if HAS_SPECULAR
    const int c = kSpecularChannel;
    Lobe specularLobe = Lobe(p.guide.roughness, g.minMaterialForSpecular, 0.0);
    Signal specular = fixHistory(gIn_Specular, gIn_SpecularSh, p, specularLobe, true, position, n[c]);
    if (kHasAntiFirefly) specular = suppressFirefly(gIn_Specular, p, specularLobe, position, specular);
#endif
    Moments m = measureLumas();
    vec2 fast = vec2(0.0);
#if HAS_DIFFUSE
    fast.x = boundSignal(diffuse, 0, false, n.x, m);
    storeSignal(gOut_Diffuse, gOut_DiffuseSh, position, diffuse);
#endif
#if HAS_SPECULAR
    fast[c] = boundSignal(specular, c, true, n[c], m);
    storeSignal(gOut_Specular, gOut_SpecularSh, position, specular);
#endif
    imageStore(gOut_Fast, position, roundToHalf(vec4(fast, 0.0, 0.0)));
    imageStore(gOut_PrevLength, position, uvec4(packLengthWord(n + 1.0)));
}
