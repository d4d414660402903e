// Writes zero to every texel of one image. IMAGE and TEXEL choose the component type.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.h"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform writeonly IMAGE gOut;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, imageSize(gOut)))) imageStore(gOut, pixel, TEXEL(0));
}
