// Left of the split position the output shows the noisy input.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "checkerboard.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
#define FIRST_OUT (1 + SIGNAL_NUM)
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Diffuse;
#if IS_SH
layout(set = SET_RESOURCES, binding = 1 + LOBE_NUM) uniform texture2D gIn_DiffuseSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_DiffuseSh;
#endif
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = LOBE_NUM) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
#if IS_SH
layout(set = SET_RESOURCES, binding = 2 * LOBE_NUM) uniform texture2D gIn_SpecularSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2 * LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularSh;
#endif
#endif

// A pixel of a checkerboard that has no data shows that of its neighbour in the packed texture.
void show(texture2D t, texture2D second, writeonly image2D target, writeonly image2D secondTarget, ivec2 pixel)
{
    bool isValid;
    Signal signal = readInput(t, second, inputTexel(pixel), isValid);
    if (kIsRelax && !kIsSh) signal.value.xyz = NRD_YCoCgToLinear(signal.value.xyz);
    imageStore(target, pixel, encodeValue(signal));
    if (kIsSh) imageStore(secondTarget, pixel, vec4(signal.axis, 0.0));
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(pixel) || pixelUv(pixel).x >= g.splitScreen) return;
    if (!isInRange(decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x))) return;
#if HAS_DIFFUSE
    show(gIn_Diffuse, gIn_DiffuseSh, gOut_Diffuse, gOut_DiffuseSh, pixel);
#endif
#if HAS_SPECULAR
    show(gIn_Specular, gIn_SpecularSh, gOut_Specular, gOut_SpecularSh, pixel);
#endif
}
