// First recurrent blur. Also keeps this frame's depth for the next.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "spatial_filter.glsl"

layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Length;
#define FIRST_OUT (4 + SIGNAL_NUM)
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
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM) uniform writeonly image2D gOut_PrevViewZ;

#include "recurrent_blur.glsl"

void main()
{
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(position)) return;
    // Copied before any exit: a stale depth in sky would let the next frame accept garbage.
    float storedViewZ = texelFetch(gIn_ViewZ, guideTexel(position), 0).x;
    imageStore(gOut_PrevViewZ, position, vec4(storedForNext(storedViewZ)));
    if (texelFetch(gIn_Tiles, position / TILE_SIZE, 0).x > 0.5) return;
    float viewZ = decodeViewZ(storedViewZ);
    if (!isInRange(viewZ)) return;
    Pixel p = makePixel(position, viewZ, decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(position), 0)));
    vec2 narrowing = adaptedConvergence(gIn_Length, gIn_ViewZ, position);
    BlurPass pass = BlurPass(g.rotatorBlur, 1.0, 1.0);
#if HAS_DIFFUSE
    Lobe diffuse = Lobe(1.0, g.minMaterialForDiffuse, g.maxBlurRadius);
    storeSignal(gOut_Diffuse, gOut_DiffuseSh, position,
                blurLobe(gIn_Diffuse, gIn_DiffuseSh, p, diffuse, false, position, narrowing.x, pass));
#endif
#if HAS_SPECULAR
    Lobe specular = Lobe(p.guide.roughness, g.minMaterialForSpecular, g.maxBlurRadius);
    float specularNarrowing = narrowing[kSpecularChannel];
    storeSignal(gOut_Specular, gOut_SpecularSh, position,
                blurLobe(gIn_Specular, gIn_SpecularSh, p, specular, true, position, specularNarrowing, pass));
#endif
}
