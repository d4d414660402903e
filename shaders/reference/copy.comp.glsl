// Copies the mean to the output, right of the split position.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.h"
#include "reference_constants.h"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = SET_CONSTANTS, binding = BINDING_CONSTANTS, std140) uniform Constants { ReferenceConstants g; };
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Mean;
layout(set = SET_RESOURCES, binding = 1) uniform writeonly image2D gOut_Signal;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(vec2(pixel), g.rectSize))) return;
    if (float(pixel.x) + 0.5 < g.splitScreen * g.rectSize.x) return;
    imageStore(gOut_Signal, pixel, texelFetch(gIn_Mean, pixel, 0));
}
