// Stabilises luma against a clamped history, measures lag and shortens the history where it disagrees with the present.
// The history was read by temporal accumulation, at the place it chose.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "reblur.glsl"

layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_Length;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_StabHistory;
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_StabWeight;
#define FIRST_OUT (5 + LOBE_NUM + HAS_SPECULAR)
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 5) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Diffuse;
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 4 + LOBE_NUM) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = 5 + LOBE_NUM) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
#endif
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_Stab;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM + 1) uniform writeonly uimage2D gOut_PrevLength;

const ivec2 kHalo = ivec2(10, 18);
const float kInvalid = -1.0; // lumas are not negative

shared vec2 sLuma[kHalo.y][kHalo.x]; // per lobe

void loadLuma(ivec2 group)
{
    for (int i = int(gl_LocalInvocationIndex); i < kHalo.x * kHalo.y; i += 128)
    {
        ivec2 local = ivec2(i % kHalo.x, i / kHalo.x);
        ivec2 pixel = group + local - 1;
        ivec2 inside = clampToRect(pixel);
        bool isUsed = pixel == inside && isInRange(decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(inside), 0).x));
        vec2 luma = vec2(kInvalid);
#if HAS_DIFFUSE
        if (isUsed) luma.x = texelFetch(gIn_Diffuse, inside, 0).x;
#endif
#if HAS_SPECULAR
        if (isUsed) luma[kSpecularChannel] = texelFetch(gIn_Specular, inside, 0).x;
#endif
        sLuma[local.y][local.x] = luma;
    }
}

struct Box
{
    float mean;
    float sigma;
};

Box lumaBox(int lobe)
{
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    float centre = sLuma[local.y + 1][local.x + 1][lobe];
    float sum = 0.0, sumSquared = 0.0;
    for (int i = 0; i < 9; i++)
    {
        float value = sLuma[local.y + i / 3][local.x + i % 3][lobe];
        value = value == kInvalid ? centre : value;
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

vec4 outputSignal(vec4 signal, float n)
{
    return roundToHalf(vec4(signal.xyz, g.returnHistoryLength != 0u ? n : signal.w));
}

float specularStrength(Guide guide)
{
    float response = smooth01(max(guide.roughness, 1e-3) / max(g.responsiveRoughnessThreshold, 1e-3));
    float strength = mix(NRD_GetLobeSpread(guide.roughness, 0.25), 1.0, 0.5 + 0.5 * response);
    bool isStrand = kHasMaterialTest && guide.materialID == g.strandMaterialID;
    return isStrand ? min(strength, 0.5) : strength;
}

void main()
{
    ivec2 group = ivec2(gl_WorkGroupID.xy) * ivec2(8, 16);
    if (texelFetch(gIn_Tiles, group / TILE_SIZE, 0).x > 0.5) return; // the same for the whole group
    loadLuma(group);
    barrier();
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(position)) return;
    if (!isInRange(decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(position), 0).x))) return;
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
    vec2 history = texelFetch(gIn_StabHistory, position, 0).xy;
    vec2 quality = texelFetch(gIn_StabWeight, position, 0).xy;
    float isOutsideSplit = pixelUv(position).x >= max(g.splitScreen, g.splitScreenPrev) ? 1.0 : 0.0;
    Stabilized diffuse = Stabilized(0.0, 0.0), specular = Stabilized(0.0, 0.0);
#if HAS_DIFFUSE
    vec4 diffuseSignal = texelFetch(gIn_Diffuse, position, 0);
    diffuse = stabilize(0, diffuseSignal.x, history.x, quality.x, n.x, isOutsideSplit);
    imageStore(gOut_Diffuse, position, outputSignal(changeLuma(diffuseSignal, diffuse.luma), n.x));
#endif
#if HAS_SPECULAR
    const int c = kSpecularChannel;
    Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(position), 0));
    vec4 specularSignal = texelFetch(gIn_Specular, position, 0);
    specular = stabilize(c, specularSignal.x, history[c], quality[c], n[c], isOutsideSplit * specularStrength(guide));
    imageStore(gOut_Specular, position, outputSignal(changeLuma(specularSignal, specular.luma), n[c]));
#endif
    imageStore(gOut_Stab, position, roundToHalf(packScalars(diffuse.luma, specular.luma)));
    imageStore(gOut_PrevLength, position, uvec4(packLengthWord(packScalars(diffuse.n, specular.n).xy + 1.0)));
}
