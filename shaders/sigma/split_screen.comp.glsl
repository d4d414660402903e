// Left of the split position the output shows the noisy input, encoded as the denoised one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.h"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_Penumbra;
#if HAS_TRANSLUCENCY
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_Translucency;
#endif
layout(set = SET_RESOURCES, binding = 2 + HAS_TRANSLUCENCY) uniform writeonly image2D gOut_ShadowTranslucency;

#include "input.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(pixel) || pixelUv(pixel).x >= g.splitScreen) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    if (isInRange(viewZ)) imageStore(gOut_ShadowTranslucency, pixel, encodeOutput(readInputSample(pixel, viewZ).shadow));
}
