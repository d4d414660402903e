// Reprojects the history along the surface's motion and, for specular, along the motion of the virtual image, mixes
// the new sample in, and reads the stabilised history at the same place for the last pass.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.h"

#define HAS_DIFFUSE (LOBES & 1)
#define HAS_SPECULAR ((LOBES >> 1) & 1)
#define LOBE_NUM (HAS_DIFFUSE + HAS_SPECULAR)
#define FIRST_SIGNAL (8 + LOBE_NUM)
#define FIRST_HISTORY (FIRST_SIGNAL + LOBE_NUM)
#define FIRST_SCALAR (FIRST_HISTORY + LOBE_NUM)
#define FIRST_OUT (FIRST_SCALAR + 2 + 2 * HAS_SPECULAR)

layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Motion;
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_PrevViewZ;
layout(set = SET_RESOURCES, binding = 5) uniform texture2D gIn_PrevNormalRoughness;
layout(set = SET_RESOURCES, binding = 6) uniform utexture2D gIn_PrevLength;
layout(set = SET_RESOURCES, binding = 7) uniform texture2D gIn_DisocclusionMix;
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 8) uniform texture2D gIn_DiffuseConfidence;
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY) uniform texture2D gIn_DiffuseHistory;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Diffuse;
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 7 + LOBE_NUM) uniform texture2D gIn_SpecularConfidence;
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM - 1) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY + LOBE_NUM - 1) uniform texture2D gIn_SpecularHistory;
layout(set = SET_RESOURCES, binding = FIRST_SCALAR + 2) uniform texture2D gIn_TrackNew;
layout(set = SET_RESOURCES, binding = FIRST_SCALAR + 3) uniform texture2D gIn_PrevTrack;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM + 4) uniform writeonly image2D gOut_Track;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM + 5) uniform writeonly image2D gOut_VirtualAmount;
#endif
layout(set = SET_RESOURCES, binding = FIRST_SCALAR) uniform texture2D gIn_Fast;
layout(set = SET_RESOURCES, binding = FIRST_SCALAR + 1) uniform texture2D gIn_Stab;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_Fast;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM + 1) uniform writeonly image2D gOut_Length;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM + 2) uniform writeonly image2D gOut_StabHistory;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM + 3) uniform writeonly image2D gOut_StabWeight;

#include "accumulate.glsl"

// What a lobe leaves for the passes that follow.
struct LobeResult
{
    float n; // frames behind the new sample
    float fast;
    float stabHistory;
    float stabWeight;
};

#if HAS_DIFFUSE
LobeResult accumulateDiffuse(Surface s, SurfaceTrack surface)
{
    LobeResult result;
    float confidence = surface.quality;
    if (kHasConfidence)
        confidence = min(confidence, textureLod(sampler2D(gIn_DiffuseConfidence, gLinearClamp), surface.uv, 0.0).x);
    result.n = applyConfidence(surface.n.x, confidence);
    HistoryRead read = surfaceRead(surface);
    vec4 history = readSignal(gIn_DiffuseHistory, read);
    bool isValid;
    vec4 signal = sanitize(texelFetch(gIn_Diffuse, s.pixel, 0), isValid);
    if (!isValid) signal = history;
    float fastHistory = fetchBilinear(gIn_Fast, read.origin, read.weights, lastPrevTexel()).x;
    vec4 mixed = mixHistory(history, signal, result.n, 1.0);
    float fastWeight = newSampleWeight(min(result.n, g.maxFastAccumulatedFrameNum));
    result.fast = limitFast(mixFast(fastHistory, signal.x, fastWeight), history.x, result.n);
    imageStore(gOut_Diffuse, s.pixel, roundToHalf(mixed));
    result.stabHistory = kHasStabilization ? readStabilized(0, read) : 0.0;
    result.stabWeight = g.isHistoryReset != 0u ? 0.0 : sqrt(saturate(dot(surface.weights, vec4(1.0))));
    return result;
}
#endif

#if HAS_SPECULAR
#include "accumulate_specular.glsl"
#endif

void main()
{
    ivec2 group = ivec2(gl_WorkGroupID.xy) * ivec2(8, 16);
    if (texelFetch(gIn_Tiles, group / TILE_SIZE, 0).x > 0.5) return; // the same for the whole group
    loadNeighbourhood(group);
    barrier();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(pixel)) return;
    Surface s = makeSurface(pixel);
    if (!isInRange(s.viewZ)) return;
    SurfaceTrack surface = trackSurface(s, texelFetch(gIn_Motion, guideTexel(pixel), 0).xyz);
    LobeResult diffuse = LobeResult(0.0, 0.0, 0.0, 0.0), specular = diffuse;
#if HAS_DIFFUSE
    diffuse = accumulateDiffuse(s, surface);
#endif
#if HAS_SPECULAR
    specular = accumulateSpecular(s, surface);
#endif
    imageStore(gOut_Fast, pixel, roundToHalf(packScalars(diffuse.fast, specular.fast)));
    vec2 lengths = packScalars(diffuse.n, specular.n).xy;
    imageStore(gOut_Length, pixel, vec4(packLengths(lengths), 0.0, 0.0));
    if (!kHasStabilization) return;
    imageStore(gOut_StabHistory, pixel, roundToHalf(packScalars(diffuse.stabHistory, specular.stabHistory)));
    imageStore(gOut_StabWeight, pixel, packScalars(diffuse.stabWeight, specular.stabWeight));
}
