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

#include "luma_window.glsl"

const float kRelitFrameNum = 4.0; // what a mean over 5x5 noisy pixels is worth

// A group may hold only a small share of a multiprocessor's shared memory, or too few of them run side by side to hide
// latencies. So lumas are kept as the half floats they are stored as.
shared uvec2 sLumas[kHalo.y][kHalo.x]; // per lobe: fast, noisy
shared uint sSlow[kHalo.y][kHalo.x];   // both lobes

// Unrolled and without a branch, so that all reads are under way at once; the last texel is loaded repeatedly.
void loadLumas(ivec2 group)
{
    const int kNum = kHalo.x * kHalo.y;
    [[unroll]] for (int first = 0; first < kNum; first += 128)
    {
        int i = min(first + int(gl_LocalInvocationIndex), kNum - 1);
        ivec2 local = ivec2(i % kHalo.x, i / kHalo.x);
        ivec2 pixel = group + local - kRadius;
        ivec2 inside = clampToRect(pixel);
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(inside), 0).x);
        vec4 lumas = texelFetch(gIn_Fast, inside, 0);
        lumas = pixel == inside && isInRange(viewZ) ? lumas : vec4(kInvalid);
        sLumas[local.y][local.x] = uvec2(packHalf2x16(lumas.xy), packHalf2x16(lumas.zw));
        sSlow[local.y][local.x] = packHalf2x16(slowLumas(inside));
    }
}

// Measured at a time: fast and noisy of one lobe, or what the fast one of both differs from the long history by.
const int kChange = 2;

vec2 valueAt(int kind, ivec2 at)
{
    uvec2 lumas = sLumas[at.y][at.x];
    if (kind != kChange) return unpackHalf2x16(lumas[kind]);
    return vec2(unpackHalf2x16(lumas.x).x, unpackHalf2x16(lumas.y).x) - unpackHalf2x16(sSlow[at.y][at.x]);
}

bool isValid(ivec2 at) { return unpackHalf2x16(sLumas[at.y][at.x].x).x != kInvalid; }

struct Spread
{
    vec2 mean;
    vec2 squares; // of differences from the mean
};

// Of the five valid texels, or less, of a row; mean, then squares.
shared vec4 sRows[kHalo.y][8];
shared float sCount[kHalo.y][8];

// Differences from the row's own mean: sums of squares have no digits left for a variance on bright flat walls.
void measureRow(int kind, ivec2 first)
{
    vec2 mean = vec2(0.0), squares = vec2(0.0);
    float count = 0.0;
    for (int x = 0; x < 5; x++)
    {
        ivec2 at = first + ivec2(x, 0);
        if (!isValid(at)) continue;
        mean += valueAt(kind, at);
        count += 1.0;
    }
    mean /= max(count, 1.0);
    for (int x = 0; x < 5; x++)
    {
        ivec2 at = first + ivec2(x, 0);
        vec2 difference = valueAt(kind, at) - mean;
        if (isValid(at)) squares += difference * difference;
    }
    sRows[first.y][first.x] = vec4(mean, squares);
    sCount[first.y][first.x] = count;
}

// 5x5; what is out of range counts as the centre. Squares of parts add up with those of their means. Has barriers: what
// is measured takes the place of what was measured before.
Spread measure(int kind)
{
    barrier();
    for (int i = int(gl_LocalInvocationIndex); i < 8 * kHalo.y; i += 128) measureRow(kind, ivec2(i % 8, i / 8));
    barrier();
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    vec2 centre = valueAt(kind, local + kRadius);
    vec2 sum = vec2(0.0);
    float missing = 25.0;
    for (int y = 0; y < 5; y++)
    {
        float count = sCount[local.y + y][local.x];
        sum += count * (sRows[local.y + y][local.x].xy - centre);
        missing -= count;
    }
    vec2 mean = centre + sum / 25.0;
    vec2 squares = missing * (centre - mean) * (centre - mean);
    for (int y = 0; y < 5; y++)
    {
        vec4 row = sRows[local.y + y][local.x];
        squares += row.zw + sCount[local.y + y][local.x] * (row.xy - mean) * (row.xy - mean);
    }
    return Spread(mean, squares);
}

struct Moments
{
    vec4 mean; // fast and noisy of one lobe, then of the other
    vec4 sigma;
    vec2 slow;        // mean of the long history, per lobe
    vec2 changeSigma; // of what the short history differs from it by
};

Moments measureLumas()
{
    Spread change = measure(kChange), first = measure(0), second = first;
    if (LOBE_NUM == 2) second = measure(1);
    vec4 mean = vec4(first.mean, second.mean);
    return Moments(mean, sqrt(vec4(first.squares, second.squares) / 25.0), mean.xz - change.mean,
                   sqrt(change.squares / 25.0));
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

// Below 1 where less of the window is in range than at the picture's corner: a pixel alone in the sky is its own
// neighbourhood, whose noise is no change. Counted again, which costs less than a register for the whole shader.
float windowShare()
{
    float count = 0.0;
    for (int y = 0; y < 5; y++) count += sCount[gl_LocalInvocationID.y + y][gl_LocalInvocationID.x];
    return min(count / 9.0, 1.0);
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
float changeAmount(int lobe, float sampleSigma, Moments m, float share)
{
    float noisySigma = max(m.sigma[2 * lobe + 1], sampleSigma);
    // In the dark nothing is noisy. If that alone made it easier to go dark than to light up, what blinks would lose up
    // to half of its energy; a quarter of what samples vary by keeps it, and costs a frame when a light goes off.
    float presentSigma = max(m.sigma[2 * lobe + 1], mix(1.0, 0.25, share) * sampleSigma);
    return max(excessAmount(m.mean[2 * lobe] - m.slow[lobe], m.changeSigma[lobe], presentSigma, share),
               excessAmount(m.mean[2 * lobe + 1] - m.slow[lobe], noisySigma, noisySigma, share));
}

// A history under the light that its neighbourhood has now: dimmed or raised as a whole, so that detail stays and noise
// is that of a mean over 5x5 pixels.
float relight(float slow, int lobe, Moments m)
{
    float before = m.slow[lobe], now = m.mean[2 * lobe + 1];
    return now < before ? slow * now / before : slow + now - before;
}

Lumas bound(int lobe, bool isSpecular, float slow, float amount, Moments m, float share)
{
    ivec2 local = ivec2(gl_LocalInvocationID.xy) + kRadius;
    float fast = valueAt(lobe, local).x;
    float mean = m.mean[2 * lobe], sigma = m.sigma[2 * lobe] * g.fastClampSigmaScale;
    // Widened to the centre's own fast value, which keeps bright details alive.
    float clamped = clamp(slow, min(mean - sigma, fast), max(mean + sigma, fast));
    int i = isSpecular ? 1 : 0;
    if (g.maxFastAccumulatedFrameNum[i] >= g.maxAccumulatedFrameNum[i]) clamped = slow; // nothing to bound it with
    float pull = pullOf(slow, clamped, fast);

    float present = m.mean[2 * lobe + 1];
    float push = 10.0 * g.relaxAntilag.x * abs(fast - slow) * pull * (isSpecular ? 0.33 : 1.0) * share;
    float lit = relight(slow, lobe, m);
    return Lumas(mix(moveTowards(clamped, present, push), lit, amount),
                 mix(moveTowards(fast, present, push), lit, amount));
}

// Returns the fast history to keep. The variance stays while the mean moves.
float boundSignal(inout Signal signal, int lobe, bool isSpecular, inout float n, Moments m)
{
    float slow = luma(signal);
    if (n < g.historyFixFrameNum) return slow; // what was just filled in is the best there is
    float share = windowShare();
    float amount = changeAmount(lobe, slow * sqrt(signal.value.w), m, share);
    Lumas lumas = bound(lobe, isSpecular, slow, amount, m, share);
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
    loadLumas(group);
    Moments m = measureLumas();
    float viewZ = decodeViewZ(storedViewZ);
    if (!isInside || !isInRange(viewZ)) return;
    vec4 packedGuide = texelFetch(gIn_NormalRoughness, guideTexel(position), 0);
    imageStore(gOut_PrevNormalRoughness, position, packedGuide);
    Pixel p = makePixel(position, viewZ, decodeGuide(packedGuide));
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
    vec2 fast = vec2(0.0);
#if HAS_DIFFUSE
    Lobe diffuseLobe = Lobe(1.0, g.minMaterialForDiffuse, 0.0);
    Signal diffuse = fixHistory(gIn_Diffuse, gIn_DiffuseSh, p, diffuseLobe, false, position, n.x);
    if (kHasAntiFirefly) diffuse = suppressFirefly(gIn_Diffuse, p, diffuseLobe, position, diffuse);
    fast.x = boundSignal(diffuse, 0, false, n.x, m);
    storeSignal(gOut_Diffuse, gOut_DiffuseSh, position, diffuse);
#endif
#if HAS_SPECULAR
    const int c = kSpecularChannel;
    Lobe specularLobe = Lobe(p.guide.roughness, g.minMaterialForSpecular, 0.0);
    Signal specular = fixHistory(gIn_Specular, gIn_SpecularSh, p, specularLobe, true, position, n[c]);
    if (kHasAntiFirefly) specular = suppressFirefly(gIn_Specular, p, specularLobe, position, specular);
    fast[c] = boundSignal(specular, c, true, n[c], m);
    storeSignal(gOut_Specular, gOut_SpecularSh, position, specular);
#endif
    imageStore(gOut_Fast, position, roundToHalf(vec4(fast, 0.0, 0.0)));
    imageStore(gOut_PrevLength, position, uvec4(packLengthWord(n + 1.0)));
}
