// What a permutation denoises. LOBES: 1 diffuse, 2 specular, 3 both. SIGNAL: 0 radiance, 1 spherical harmonics,
// 2 occlusion, 3 directional occlusion of REBLUR; 4 radiance, 5 spherical harmonics of RELAX. The macros serve #if
// and bindings, the constants the code.
#ifndef VARIANT_GLSL
#define VARIANT_GLSL

#define HAS_DIFFUSE (LOBES & 1)
#define HAS_SPECULAR ((LOBES >> 1) & 1)
#define LOBE_NUM (HAS_DIFFUSE + HAS_SPECULAR)
#define IS_RELAX (SIGNAL >> 2)
#define IS_BOUNDED ((SIGNAL >> 1) & 1) // in [0; 1]: no fireflies, and the hit distance is the signal
#define IS_SH (SIGNAL & (1 - IS_BOUNDED) & 1)
#define IS_STABILIZED ((1 - IS_RELAX) * (1 - IS_BOUNDED + (SIGNAL & IS_BOUNDED))) // REBLUR's, but for occlusion
#define SIGNAL_NUM (LOBE_NUM * (1 + IS_SH)) // textures; the second ones of the lobes follow the first ones

const bool kIsRelax = IS_RELAX == 1;
const bool kIsSh = IS_SH == 1;
const bool kIsBounded = IS_BOUNDED == 1;
const bool kIsOcclusion = SIGNAL == 2;
const bool kIsDirectional = SIGNAL == 3;

// Without a second texture its name stands for the first, so that one text serves all variants.
#if IS_SH == 0
#define gIn_DiffuseSh gIn_Diffuse
#define gIn_SpecularSh gIn_Specular
#define gIn_DiffuseHistorySh gIn_DiffuseHistory
#define gIn_SpecularHistorySh gIn_SpecularHistory
#define gOut_DiffuseSh gOut_Diffuse
#define gOut_SpecularSh gOut_Specular
#define gOut_DiffuseHistorySh gOut_DiffuseHistory
#define gOut_SpecularHistorySh gOut_SpecularHistory
#define gOut_DiffuseBlurredSh gOut_DiffuseBlurred
#define gOut_SpecularBlurredSh gOut_SpecularBlurred
#endif

#endif
