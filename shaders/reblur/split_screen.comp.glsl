// Left of the split position the output shows the noisy input.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "reblur.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = 1 + LOBE_NUM) uniform writeonly image2D gOut_Diffuse;
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = LOBE_NUM) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = 2 * LOBE_NUM) uniform writeonly image2D gOut_Specular;
#endif

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(pixel) || pixelUv(pixel).x >= g.splitScreen) return;
    if (!isInRange(decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x))) return;
    bool isValid;
#if HAS_DIFFUSE
    imageStore(gOut_Diffuse, pixel, sanitize(texelFetch(gIn_Diffuse, pixel, 0), isValid));
#endif
#if HAS_SPECULAR
    imageStore(gOut_Specular, pixel, sanitize(texelFetch(gIn_Specular, pixel, 0), isValid));
#endif
}
