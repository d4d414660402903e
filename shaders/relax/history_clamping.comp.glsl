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
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM + 2) uniform writeonly image2D gOut_PrevDepth;
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM + 3) uniform writeonly image2D gOut_PrevNormalRoughness;

// Of a lobe: the fast history, the new sample, and what the fast history differs from the long one by.
#define CHANNELS_PER_LOBE 3
#define CHANNEL_NUM (LOBE_NUM * CHANNELS_PER_LOBE)
#include "luma_window.glsl"
#include "sparse_fill.glsl"
#include "keep_surface.glsl"

const float kRelitFrameNum = 4.0; // what a mean over noisy pixels of a window is worth

vec4 gatherFast(vec2 uv, int component)
{
    // The component must be a constant.
    if (component == 0) return gatherOrder(textureGather(sampler2D(gIn_Fast, gNearestClamp), uv, 0));
    if (component == 1) return gatherOrder(textureGather(sampler2D(gIn_Fast, gNearestClamp), uv, 1));
    if (component == 2) return gatherOrder(textureGather(sampler2D(gIn_Fast, gNearestClamp), uv, 2));
    return gatherOrder(textureGather(sampler2D(gIn_Fast, gNearestClamp), uv, 3));
}

void readLobe(inout Quad quad, int lobe, texture2D slow, vec2 uv)
{
    int first = lobe * CHANNELS_PER_LOBE;
    quad.channels[first] = gatherFast(uv, 2 * lobe);
    quad.channels[first + 1] = gatherFast(uv, 2 * lobe + 1);
    quad.channels[first + 2] = quad.channels[first] - gatherOrder(textureGather(sampler2D(slow, gNearestClamp), uv));
}

Quad readQuad(vec2 uv)
{
    Quad quad;
#if HAS_DIFFUSE
    readLobe(quad, 0, gIn_Diffuse, uv);
#endif
#if HAS_SPECULAR
    readLobe(quad, kSpecularChannel, gIn_Specular, uv);
#endif
    return quad;
}

// Of one lobe, over the window.
struct Moments
{
    Spread fast;
    Spread noisy;
    float slow;        // mean of the long history
    float changeSigma; // of what the short history differs from it by
    // Below 1 where less of the window is in range than at the picture's corner: a pixel alone in the sky is its own
    // neighbourhood, whose noise is no change.
    float share;
};

// own: fast and noisy luma of this pixel.
Moments measureLobe(int lobe, vec2 own, float slow)
{
    int first = lobe * CHANNELS_PER_LOBE;
    Spread fast = windowOf(first), noisy = windowOf(first + 1), change = windowOf(first + 2);
    float share = min(fast.count / 16.0, 1.0);
    fast = filled(fast, kWindowSize, own.x);
    noisy = filled(noisy, kWindowSize, own.y);
    change = filled(change, kWindowSize, own.x - slow);
    return Moments(fast, noisy, fast.mean - change.mean, sigmaOf(change), share);
}

float fillWeight(Fill f, ivec2 offset, ivec2 pixel, Signal value)
{
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0)), own = f.p.guide;
    float weight = soft(planeDistance(f.p.plane, vec2(pixel), viewZ));
    weight *= f.isSpecular ? heavy(angleBetween(own.N, guide.N) * f.w.normal)
                           : pow(max(dot(own.N, guide.N), 0.01), g.relaxFixNormalPower);
    if (f.isSpecular) weight *= soft(abs(guide.roughness - own.roughness) * f.w.roughness);
    bool isUsed = isInRange(viewZ) && isSameMaterial(own.materialID, guide.materialID, f.lobe.minMaterial);
    return isUsed ? weight : 0.0;
}

// Strides of 7, 5, 4, 3 pixels for histories of 1 to 4 frames.
Signal fixHistory(texture2D t, texture2D second, Signal centre, Pixel p, Lobe lobe, bool isSpecular, float n)
{
    bool isAlternate = kHasMaterialTest && p.guide.materialID == g.historyFixAlternateMaterialID;
    float base = isAlternate ? g.historyFixAlternateStride : g.historyFixStride;
    int stride = int(base / (2.0 + n) + 0.5);
    Weights w = makeWeights(p, lobe, isSpecular, 1.0, 1.0, 0.0);
    return fillSparsely(Fill(p, lobe, isSpecular, w, 0.0, stride), t, second, centre, n);
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

// What a mean over the window's 36 pixels, which share samples or an error of the renderer, is taken to be worth.
const float kIndependentNum = 16.0;
const float kIndependentNoisyNum = 13.0;

// How far a difference of means is more than noise, by its standard error.
float excessAmount(float difference, float sigma, float noisySigma, float number)
{
    float noise = inversesqrt(max(number, 1.0)) * (g.relaxAntilag.y * sigma + g.relaxAntilag.z * noisySigma) + kEps;
    return saturate(2.0 * g.relaxAntilag.w * max(abs(difference) / noise - 1.0, 0.0));
}

// By how much light has changed, as means of a window show it, in which detail cancels out. A great change shows in the
// noisy present at once, a smaller one in the fast history later. Samples vary as much as they did over time,
// sampleSigma: where rare ones carry the light, a window without any is dark and calm, and no change.
float changeAmount(float sampleSigma, Moments m)
{
    float own = sigmaOf(m.noisy), noisySigma = max(own, sampleSigma);
    // In the dark nothing is noisy. If that alone made it easier to go dark than to light up, what blinks would lose up
    // to half of its energy; a third of what samples vary by keeps it, and costs a frame when a light goes off.
    float presentSigma = max(own, mix(1.0, 0.3, m.share) * sampleSigma);
    return max(excessAmount(m.fast.mean - m.slow, m.changeSigma, presentSigma, kIndependentNum * m.share),
               excessAmount(m.noisy.mean - m.slow, noisySigma, noisySigma, kIndependentNoisyNum * m.share));
}

// A history under the light that its neighbourhood has now: dimmed or raised as a whole, so that detail stays and noise
// is that of a mean over the window.
float relight(float slow, Moments m)
{
    float before = m.slow, now = m.noisy.mean;
    return now < before ? slow * now / before : slow + now - before;
}

Lumas bound(bool isSpecular, float slow, float fast, float amount, Moments m)
{
    float mean = m.fast.mean, reach = sigmaOf(m.fast) * g.fastClampSigmaScale;
    // Widened to the centre's own fast value, which keeps bright details alive.
    float clamped = clamp(slow, min(mean - reach, fast), max(mean + reach, fast));
    int i = isSpecular ? 1 : 0;
    if (g.maxFastAccumulatedFrameNum[i] >= g.maxAccumulatedFrameNum[i]) clamped = slow; // nothing to bound it with
    float pull = pullOf(slow, clamped, fast);

    float present = m.noisy.mean;
    float push = 10.0 * g.relaxAntilag.x * abs(fast - slow) * pull * (isSpecular ? 0.33 : 1.0) * m.share;
    float lit = relight(slow, m);
    return Lumas(mix(moveTowards(clamped, present, push), lit, amount),
                 mix(moveTowards(fast, present, push), lit, amount));
}

// own: fast and noisy luma of this pixel. Returns the fast history to keep. The variance stays while the mean moves.
float boundSignal(inout Signal signal, int lobe, bool isSpecular, inout float n, vec2 own, float stored)
{
    float slow = luma(signal);
    if (n < g.historyFixFrameNum) return slow; // what was just filled in is the best there is
    Moments m = measureLobe(lobe, own, stored);
    float amount = changeAmount(slow * sqrt(signal.value.w), m);
    Lumas lumas = bound(isSpecular, slow, own.x, amount, m);
    float variance = signal.value.w * square(max(slow, lumas.slow));
    signal = withVariance(changeLuma(signal, lumas.slow), variance);
    n = mix(n, min(n, kRelitFrameNum), amount);
    return lumas.fast;
}

// Too few frames for a variance over time: that of the fast history over the window, raised for what so few may miss,
// less what the fix has averaged.
const float kFixedShare = 1.0 / 8.0;

float spatialVariance(Spread fast, float n)
{
    float sigma = sigmaOf(fast);
    return sigma * sigma * kFixedShare * max(1.0, 4.0 / (n + 2.0));
}

// Returns the fast history to keep.
float processLobe(texture2D t, texture2D second, writeonly image2D result, writeonly image2D resultSh, int lobe,
                  bool isSpecular, ivec2 position, float viewZ, Guide guide, vec2 own, inout float n)
{
    Signal signal = readSignal(t, second, position);
    float stored = luma(signal);
    bool isShort = n < g.historyFixFrameNum;
    if (isShort || kHasAntiFirefly)
    {
        Pixel p = makePixel(position, viewZ, guide);
        Lobe filtered = isSpecular ? Lobe(guide.roughness, g.minMaterialForSpecular, 0.0)
                                   : Lobe(1.0, g.minMaterialForDiffuse, 0.0);
        if (isShort) signal = fixHistory(t, second, signal, p, filtered, isSpecular, n);
        if (kHasAntiFirefly) signal = suppressFirefly(t, p, filtered, position, signal);
    }
    if (n + 1.0 < g.relaxSpatialVarianceFrameNum)
        signal = withVariance(signal, spatialVariance(windowOf(lobe * CHANNELS_PER_LOBE), n));
    float fast = boundSignal(signal, lobe, isSpecular, n, own, stored);
    storeSignal(result, resultSh, position, signal);
    return fast;
}

void main()
{
    ivec2 group = ivec2(gl_WorkGroupID.xy) * ivec2(8, 16);
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    float storedViewZ = texelFetch(gIn_ViewZ, guideTexel(clampToRect(position)), 0).x;
    float viewZ = decodeViewZ(storedViewZ);
    bool isUsed = isInRect(position) && isInRange(viewZ);
    // Before any exit: a stale depth in sky would let the next frame accept garbage.
    if (isInRect(position) && !isUsed) forgetSurface(position);
    if (texelFetch(gIn_Tiles, group / TILE_SIZE, 0).x > 0.5) return; // the same for the whole group
    measureWindows(group);
    if (!isUsed) return;
    vec4 packedGuide = texelFetch(gIn_NormalRoughness, guideTexel(position), 0);
    Guide guide = decodeGuide(packedGuide);
    keepSurface(position, storedViewZ, packedGuide, guide);
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
    vec4 own = texelFetch(gIn_Fast, position, 0);
    vec2 fast = vec2(0.0);
#if HAS_DIFFUSE
    fast.x = processLobe(gIn_Diffuse, gIn_DiffuseSh, gOut_Diffuse, gOut_DiffuseSh, 0, false, position, viewZ, guide,
                         own.xy, n.x);
#endif
#if HAS_SPECULAR
    const int c = kSpecularChannel;
    vec2 ownSpecular = LOBE_NUM == 2 ? own.zw : own.xy;
    fast[c] = processLobe(gIn_Specular, gIn_SpecularSh, gOut_Specular, gOut_SpecularSh, c, true, position, viewZ,
                          guide, ownSpecular, n[c]);
#endif
    imageStore(gOut_Fast, position, roundToHalf(vec4(fast, 0.0, 0.0)));
    imageStore(gOut_PrevLength, position, uvec4(packLengthWord(n + 1.0)));
}
