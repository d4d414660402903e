// Stabilises luma against a clamped history, measures lag and shortens the history where it disagrees with the present.
// The history was read by temporal accumulation, at the place it chose. What is denoised may lie in the output, whose
// place the result takes, so every pixel reads its own alone, and the next frame's history gets it from here.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "denoiser.glsl"

layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_Length;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_StabHistory;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_StabWeight;
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_BlurLuma;
#define FIRST_SIGNAL 5
#define FIRST_OUT (FIRST_SIGNAL + SIGNAL_NUM + HAS_SPECULAR)
#define FIRST_HISTORY (FIRST_OUT + SIGNAL_NUM)
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY) uniform writeonly image2D gOut_DiffuseHistory;
#if IS_SH
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM) uniform texture2D gIn_DiffuseSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_DiffuseSh;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY + LOBE_NUM) uniform writeonly image2D gOut_DiffuseHistorySh;
#endif
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM - 1) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + SIGNAL_NUM) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY + LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularHistory;
#if IS_SH
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + 2 * LOBE_NUM - 1) uniform texture2D gIn_SpecularSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2 * LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularSh;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY + 2 * LOBE_NUM - 1)
uniform writeonly image2D gOut_SpecularHistorySh;
#endif
#endif
layout(set = SET_RESOURCES, binding = FIRST_HISTORY + SIGNAL_NUM) uniform writeonly image2D gOut_Stab;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY + SIGNAL_NUM + 1) uniform writeonly uimage2D gOut_PrevLength;

const ivec2 kHalo = ivec2(10, 18);
shared vec2 sLuma[kHalo.y][kHalo.x]; // per lobe

vec2 readLuma(ivec2 pixel)
{
    ivec2 inside = clampToRect(pixel);
    vec2 lumas = texelFetch(gIn_BlurLuma, inside, 0).xy;
    return pixel == inside ? lumas : vec2(kNoLuma);
}

void loadLuma(ivec2 group)
{
    for (int i = int(gl_LocalInvocationIndex); i < kHalo.x * kHalo.y; i += 128)
    {
        ivec2 local = ivec2(i % kHalo.x, i / kHalo.x);
        sLuma[local.y][local.x] = readLuma(group + local - 1);
    }
}

// A processor suspends and resumes every invocation at a barrier: it is quicker to read again.
vec2 lumaAt(ivec2 offset)
{
    if (kIsSoftware) return readLuma(ivec2(gl_GlobalInvocationID.xy) + offset);
    ivec2 local = ivec2(gl_LocalInvocationID.xy) + 1 + offset;
    return sLuma[local.y][local.x];
}

struct Box
{
    float mean;
    float sigma;
};

Box lumaBox(int lobe)
{
    float centre = lumaAt(ivec2(0))[lobe];
    float sum = 0.0, sumSquared = 0.0;
    for (int i = 0; i < 9; i++)
    {
        float value = lumaAt(ivec2(i % 3, i / 3) - 1)[lobe];
        value = value == kNoLuma ? centre : value;
        sum += value;
        sumSquared += value * value;
    }
    float mean = sum / 9.0;
    return Box(mean, sqrt(abs(sumSquared / 9.0 - square(mean))));
}

struct Stabilized
{
    float luma;
    float n; // frames, after antilag
};

// quality: of the footprint the history was read from. strength: share of the history a lobe of this roughness takes.
Stabilized stabilize(int lobe, float luma, float history, float quality, float n, float strength)
{
    Box box = lumaBox(lobe);
    // Blobs the history fix left behind.
    if (n < g.historyFixFrameNum) luma = min(luma, box.mean * (1.2 + 1.0 / (1.0 + n)));
    float reach = box.sigma * g.antilagSigmaScale;
    float clamped = clamp(history, box.mean - reach, box.mean + reach);
    float difference = abs(history - clamped) / (max(history, clamped) + kEps);
    // At high frame rates a single frame's difference means less.
    float tolerance = g.antilagSensitivity * square(g.frameRateScale);
    float antilag = 1.0 / (1.0 + difference * quality * n / tolerance);
    if (g.stabilizationStrength == 0.0) antilag = 1.0; // no stabilised history yet: nothing to compare with

    float trust = quality * (1.0 - convergence(n));
    float width = box.sigma * (1.0 + 3.0 * g.frameRateScale * trust);
    history = clamp(history, box.mean - width, box.mean + width);
    Stabilized result;
    result.luma = mix(luma, history, min(trust * antilag * strength, g.stabilizationStrength));
    // Never below the history fix, or that would run again.
    result.n = mix(min(n, g.historyFixFrameNum), n, antilag);
    return result;
}

float specularStrength(Guide guide)
{
    float response = smooth01(max(guide.roughness, 1e-3) / max(g.responsiveRoughnessThreshold, 1e-3));
    float strength = mix(NRD_GetLobeSpread(guide.roughness, 0.25), 1.0, 0.5 + 0.5 * response);
    bool isStrand = kHasMaterialTest && guide.materialID == g.strandMaterialID;
    return isStrand ? min(strength, 0.5) : strength;
}

// As it is, since a signal encoded once more would be dithered once more.
void copyTexel(texture2D from, writeonly image2D to, ivec2 position)
{
    imageStore(to, position, texelFetch(from, position, 0));
}

void main()
{
    ivec2 group = ivec2(gl_WorkGroupID.xy) * ivec2(8, 16);
    if (texelFetch(gIn_Tiles, group / TILE_SIZE, 0).x > 0.5) return; // the same for the whole group
    if (kHasStabilization && !kIsSoftware)
    {
        loadLuma(group);
        barrier();
    }
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(position)) return;
    if (texelFetch(gIn_BlurLuma, position, 0).x == kNoLuma) return; // out of range
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
    vec2 history = texelFetch(gIn_StabHistory, position, 0).xy;
    vec2 quality = texelFetch(gIn_StabWeight, position, 0).xy;
    float isOutsideSplit = pixelUv(position).x >= max(g.splitScreen, g.splitScreenPrev) ? 1.0 : 0.0;
    Stabilized diffuse = Stabilized(0.0, n.x), specular = Stabilized(0.0, n[kSpecularChannel]);
#if HAS_DIFFUSE
    Signal diffuseSignal = readSignal(gIn_Diffuse, gIn_DiffuseSh, position);
    copyTexel(gIn_Diffuse, gOut_DiffuseHistory, position);
#if IS_SH
    copyTexel(gIn_DiffuseSh, gOut_DiffuseHistorySh, position);
#endif
    if (kHasStabilization)
    {
        diffuse = stabilize(0, luma(diffuseSignal), history.x, quality.x, n.x, isOutsideSplit);
        diffuseSignal = changeLuma(diffuseSignal, diffuse.luma);
    }
    storeOutput(gOut_Diffuse, gOut_DiffuseSh, position, diffuseSignal, n.x);
#endif
#if HAS_SPECULAR
    const int c = kSpecularChannel;
    Signal specularSignal = readSignal(gIn_Specular, gIn_SpecularSh, position);
    copyTexel(gIn_Specular, gOut_SpecularHistory, position);
#if IS_SH
    copyTexel(gIn_SpecularSh, gOut_SpecularHistorySh, position);
#endif
    if (kHasStabilization)
    {
        Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(position), 0));
        float strength = isOutsideSplit * specularStrength(guide);
        specular = stabilize(c, luma(specularSignal), history[c], quality[c], n[c], strength);
        specularSignal = changeLuma(specularSignal, specular.luma);
    }
    storeOutput(gOut_Specular, gOut_SpecularSh, position, specularSignal, n[c]);
#endif
    if (kHasStabilization) imageStore(gOut_Stab, position, roundToHalf(packScalars(diffuse.luma, specular.luma)));
    imageStore(gOut_PrevLength, position, uvec4(packLengthWord(packScalars(diffuse.n, specular.n).xy + 1.0)));
}
