// The recurrent blur: what it leaves is the history. Nothing stabilises occlusion, whose output it writes as well.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "spatial_filter.glsl"

layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_Length;
#define FIRST_SIGNAL 3
#define FIRST_OUT (FIRST_SIGNAL + SIGNAL_NUM)
#define FIRST_RESULT (FIRST_OUT + SIGNAL_NUM)
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_DiffuseBlurred;
#if IS_STABILIZED == 0
layout(set = SET_RESOURCES, binding = FIRST_RESULT) uniform writeonly image2D gOut_Diffuse;
#endif
#if IS_SH
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM) uniform texture2D gIn_DiffuseSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_DiffuseBlurredSh;
#endif
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM - 1) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularBlurred;
#if IS_STABILIZED == 0
layout(set = SET_RESOURCES, binding = FIRST_RESULT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
#endif
#if IS_SH
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + 2 * LOBE_NUM - 1) uniform texture2D gIn_SpecularSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2 * LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularBlurredSh;
#endif
#endif
#if IS_STABILIZED == 0
layout(set = SET_RESOURCES, binding = FIRST_RESULT + SIGNAL_NUM) uniform writeonly uimage2D gOut_PrevLength;
#else
layout(set = SET_RESOURCES, binding = FIRST_RESULT) uniform writeonly image2D gOut_BlurLuma;
#endif

#include "recurrent_blur.glsl"

void main()
{
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(position)) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(position), 0).x);
    if (!isInRange(viewZ))
    {
#if IS_STABILIZED
        imageStore(gOut_BlurLuma, position, vec4(kNoLuma)); // tells the stabilisation what is out of range
#endif
        return;
    }
    Pixel p = makePixel(position, viewZ, decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(position), 0)));
    vec2 narrowing = adaptedConvergence(gIn_Length, gIn_ViewZ, position);
    Signal diffuse = kNoSignal, specular = kNoSignal;
#if HAS_DIFFUSE
    Lobe diffuseLobe = Lobe(1.0, g.minMaterialForDiffuse, g.maxBlurRadius);
    diffuse = blurLobe(gIn_Diffuse, gIn_DiffuseSh, p, diffuseLobe, false, position, narrowing.x);
    storeSignal(gOut_DiffuseBlurred, gOut_DiffuseBlurredSh, position, diffuse);
#endif
#if HAS_SPECULAR
    Lobe specularLobe = Lobe(p.guide.roughness, g.minMaterialForSpecular, g.maxBlurRadius);
    specular = blurLobe(gIn_Specular, gIn_SpecularSh, p, specularLobe, true, position, narrowing[kSpecularChannel]);
    storeSignal(gOut_SpecularBlurred, gOut_SpecularBlurredSh, position, specular);
#endif
#if IS_STABILIZED == 0
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
#if HAS_DIFFUSE
    storeOutput(gOut_Diffuse, gOut_DiffuseSh, position, diffuse, n.x);
#endif
#if HAS_SPECULAR
    storeOutput(gOut_Specular, gOut_SpecularSh, position, specular, n[kSpecularChannel]);
#endif
    imageStore(gOut_PrevLength, position, uvec4(packLengthWord(n + 1.0)));
#else
    imageStore(gOut_BlurLuma, position, roundToHalf(packScalars(luma(diffuse), luma(specular))));
#endif
}
