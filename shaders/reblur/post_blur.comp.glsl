// Second recurrent blur, wider and stricter: its result is the history. Also keeps this frame's normals for the next,
// and is the last pass where stabilisation is off.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "recurrent_blur.glsl"

layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Length;
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = 4 + LOBE_NUM) uniform writeonly image2D gOut_DiffuseHistory;
layout(set = SET_RESOURCES, binding = 6 + 2 * LOBE_NUM) uniform writeonly image2D gOut_Diffuse;
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 3 + LOBE_NUM) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = 3 + 2 * LOBE_NUM) uniform writeonly image2D gOut_SpecularHistory;
layout(set = SET_RESOURCES, binding = 5 + 3 * LOBE_NUM) uniform writeonly image2D gOut_Specular;
#endif
layout(set = SET_RESOURCES, binding = 4 + 2 * LOBE_NUM) uniform writeonly image2D gOut_PrevNormalRoughness;
layout(set = SET_RESOURCES, binding = 5 + 2 * LOBE_NUM) uniform writeonly uimage2D gOut_PrevLength;

vec4 outputSignal(vec4 signal, float n) { return vec4(signal.xyz, g.returnHistoryLength != 0u ? n : signal.w); }

void main()
{
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (texelFetch(gIn_Tiles, position / TILE_SIZE, 0).x > 0.5 || !isInRect(position)) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(position), 0).x);
    if (!isInRange(viewZ)) return;
    vec4 packedGuide = texelFetch(gIn_NormalRoughness, guideTexel(position), 0);
    imageStore(gOut_PrevNormalRoughness, position, packedGuide);
    Pixel p = makePixel(position, viewZ, decodeGuide(packedGuide));
    vec2 narrowing = adaptedConvergence(gIn_Length, gIn_ViewZ, position);
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
    BlurPass pass = BlurPass(g.rotatorPostBlur, 2.0, 0.5);
#if HAS_DIFFUSE
    Lobe diffuseLobe = Lobe(1.0, g.minMaterialForDiffuse, g.maxBlurRadius);
    vec4 diffuse = blurLobe(gIn_Diffuse, gIn_ViewZ, gIn_NormalRoughness, p, diffuseLobe, false, position,
                            narrowing.x, pass);
    imageStore(gOut_DiffuseHistory, position, diffuse);
    if (!kHasStabilization) imageStore(gOut_Diffuse, position, outputSignal(diffuse, n.x));
#endif
#if HAS_SPECULAR
    Lobe specularLobe = Lobe(p.guide.roughness, g.minMaterialForSpecular, g.maxBlurRadius);
    vec4 specular = blurLobe(gIn_Specular, gIn_ViewZ, gIn_NormalRoughness, p, specularLobe, true, position,
                             narrowing[kSpecularChannel], pass);
    imageStore(gOut_SpecularHistory, position, specular);
    if (!kHasStabilization) imageStore(gOut_Specular, position, outputSignal(specular, n[kSpecularChannel]));
#endif
    if (!kHasStabilization) imageStore(gOut_PrevLength, position, uvec4(packLengthWord(n + 1.0)));
}
