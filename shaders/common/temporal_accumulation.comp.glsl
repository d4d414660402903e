// Reprojects the history along the surface's motion and, for specular, along the motion of the virtual image, mixes
// the new sample in, and reads the stabilised history at the same place for the last pass.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "bindings.h"
#include "variant.glsl"

#define FIRST_SIGNAL (9 + LOBE_NUM)
#define FIRST_HISTORY (FIRST_SIGNAL + SIGNAL_NUM)
#define FIRST_SCALAR (FIRST_HISTORY + SIGNAL_NUM)
#define FIRST_TRACK (FIRST_SCALAR + 1 + IS_STABILIZED)
#define HAS_TRACK (HAS_SPECULAR * (1 - IS_BOUNDED))
#define SPECULAR_MOTION (FIRST_TRACK + HAS_SPECULAR + HAS_TRACK)
#define HAS_CAP (1 - IS_BOUNDED)
#define CAP (SPECULAR_MOTION + HAS_SPECULAR)
#define FIRST_OUT (CAP + HAS_CAP + 1)
#define FIRST_SCALAR_OUT (FIRST_OUT + SIGNAL_NUM)

layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Motion;
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_PrevDepth;
layout(set = SET_RESOURCES, binding = 5) uniform texture2D gIn_PrevNormalRoughness;
layout(set = SET_RESOURCES, binding = 6) uniform utexture2D gIn_PrevLength;
layout(set = SET_RESOURCES, binding = 7) uniform utexture2D gIn_Cut;
layout(set = SET_RESOURCES, binding = 8) uniform texture2D gIn_DisocclusionMix;
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 9) uniform texture2D gIn_DiffuseConfidence;
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY) uniform texture2D gIn_DiffuseHistory;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Diffuse;
#if IS_SH
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM) uniform texture2D gIn_DiffuseSh;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY + LOBE_NUM) uniform texture2D gIn_DiffuseHistorySh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_DiffuseSh;
#endif
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 8 + LOBE_NUM) uniform texture2D gIn_SpecularConfidence;
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM - 1) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY + LOBE_NUM - 1) uniform texture2D gIn_SpecularHistory;
#if SIGNAL == 2
layout(set = SET_RESOURCES, binding = FIRST_TRACK) uniform texture2D gIn_SpecularHitDist;
#else
layout(set = SET_RESOURCES, binding = FIRST_TRACK) uniform texture2D gIn_TrackNew;
layout(set = SET_RESOURCES, binding = FIRST_TRACK + 1) uniform texture2D gIn_PrevTrack;
layout(set = SET_RESOURCES, binding = FIRST_SCALAR_OUT + 2 + 2 * IS_STABILIZED) uniform writeonly image2D gOut_Track;
#endif
layout(set = SET_RESOURCES, binding = SPECULAR_MOTION) uniform texture2D gIn_SpecularMotion;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
#if IS_SH
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + 2 * LOBE_NUM - 1) uniform texture2D gIn_SpecularSh;
layout(set = SET_RESOURCES, binding = FIRST_HISTORY + 2 * LOBE_NUM - 1) uniform texture2D gIn_SpecularHistorySh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2 * LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularSh;
#endif
layout(set = SET_RESOURCES, binding = FIRST_SCALAR_OUT + 2 + 2 * IS_STABILIZED + HAS_TRACK)
uniform writeonly image2D gOut_VirtualAmount;
#if IS_RELAX
layout(set = SET_RESOURCES, binding = FIRST_SCALAR_OUT + 4) uniform writeonly image2D gOut_Confidence;
#endif
#endif
#if HAS_CAP
layout(set = SET_RESOURCES, binding = CAP) uniform texture2D gIn_Cap;
#endif
layout(set = SET_RESOURCES, binding = FIRST_OUT - 1) uniform writeonly uimage2D gOut_PrevCut;
layout(set = SET_RESOURCES, binding = FIRST_SCALAR) uniform texture2D gIn_Fast;
layout(set = SET_RESOURCES, binding = FIRST_SCALAR_OUT) uniform writeonly image2D gOut_Fast;
layout(set = SET_RESOURCES, binding = FIRST_SCALAR_OUT + 1) uniform writeonly image2D gOut_Length;
#if IS_STABILIZED
layout(set = SET_RESOURCES, binding = FIRST_SCALAR + 1) uniform texture2D gIn_Stab;
layout(set = SET_RESOURCES, binding = FIRST_SCALAR_OUT + 2) uniform writeonly image2D gOut_StabHistory;
layout(set = SET_RESOURCES, binding = FIRST_SCALAR_OUT + 3) uniform writeonly image2D gOut_StabWeight;
#endif

#include "accumulate.glsl"

// What a lobe leaves for the passes that follow.
struct LobeResult
{
    float n; // frames behind the new sample
    float fast;
    float noisy; // luma of the new sample
    float stabHistory;
    float stabWeight;
};

#if HAS_DIFFUSE
LobeResult accumulateDiffuse(Surface s, SurfaceTrack surface)
{
    LobeResult result;
    result.n = applyConfidence(surface.n.x, surface.quality);
    if (kHasConfidence)
    {
        float given = textureLod(sampler2D(gIn_DiffuseConfidence, gLinearClamp), surface.uv, 0.0).x;
        result.n = min(result.n, applyGivenConfidence(surface.n.x, given));
    }
    HistoryRead read = surfaceRead(surface);
    History stored = readHistory(gIn_DiffuseHistory, gIn_DiffuseHistorySh, 0, read);
    Signal history = stored.signal;
    bool isValid;
    Signal signal = readAccumulated(gIn_Diffuse, gIn_DiffuseSh, s, 0, 1.0, isValid);
    if (!isValid) signal = history;
    float share = dataShare(s.pixel, false, result.n);
    storeSignal(gOut_Diffuse, gOut_DiffuseSh, s.pixel, mixHistory(history, signal, result.n, share, 1.0));
    float fastWeight = newSampleWeight(min(result.n, g.maxFastAccumulatedFrameNum.x)) * share;
    result.fast = limitFast(mixFast(stored.fast, luma(signal), fastWeight), luma(history), result.n);
    result.noisy = limitFast(luma(signal), luma(history), result.n);
    result.stabHistory = stored.stabilized;
    result.stabWeight = isHistoryReset() ? 0.0 : sqrt(saturate(dot(surface.weights, vec4(1.0))));
    return result;
}
#endif

#if HAS_SPECULAR
#include "accumulate_specular.glsl"
#endif

void main()
{
    ivec2 group = ivec2(gl_WorkGroupID.xy) * ivec2(8, 16);
    // The last frame's votes are counted; the next frame's start from none.
    if (gl_GlobalInvocationID.xy == uvec2(0u)) imageStore(gOut_PrevCut, ivec2(0), uvec4(0u));
    if (texelFetch(gIn_Tiles, group / TILE_SIZE, 0).x > 0.5) return; // the same for the whole group
    if (!kIsSoftware)
    {
        loadNeighbourhood(group);
        barrier();
    }
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(pixel) || neighbour(ivec2(0)).w == 0.0) return;
    Surface s = makeSurface(pixel);
    SurfaceTrack surface = trackSurface(s, readMotion(gIn_Motion, gIn_ViewZ, pixel));
    LobeResult diffuse = LobeResult(0.0, 0.0, 0.0, 0.0, 0.0), specular = diffuse;
#if HAS_SPECULAR
    specular = accumulateSpecular(s, surface);
#endif
#if HAS_DIFFUSE
    diffuse = accumulateDiffuse(s, surface);
#endif
    vec4 fast = packScalars(diffuse.fast, specular.fast);
    if (kIsRelax) fast = packPairs(vec2(diffuse.fast, diffuse.noisy), vec2(specular.fast, specular.noisy));
    imageStore(gOut_Fast, pixel, kIsBounded ? fast : roundToHalf(fast));
    vec2 lengths = packScalars(diffuse.n, specular.n).xy;
    imageStore(gOut_Length, pixel, vec4(packLengths(lengths), 0.0, 0.0));
#if IS_STABILIZED
    if (!kHasStabilization) return;
    imageStore(gOut_StabHistory, pixel, roundToHalf(packScalars(diffuse.stabHistory, specular.stabHistory)));
    imageStore(gOut_StabWeight, pixel, packScalars(diffuse.stabWeight, specular.stabWeight));
#endif
}
