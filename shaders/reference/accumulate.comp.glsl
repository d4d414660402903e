// Progressive mean: the exact running mean up to the cap, exponential beyond.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.h"
#include "nrd_frontend.glsl"
#include "reference_constants.h"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = SET_CONSTANTS, binding = BINDING_CONSTANTS, std140) uniform Constants { ReferenceConstants g; };
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Signal;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_Mean;
layout(set = SET_RESOURCES, binding = 2) uniform writeonly image2D gOut_Mean;

// A sample that is no number takes no part; half of the largest float, so that no difference overflows.
float usable(float signal, float mean) { return NRD_IsFinite(signal) ? clamp(signal, -1.7e38, 1.7e38) : mean; }

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(vec2(pixel), g.rectSize))) return;
    vec4 signal = texelFetch(gIn_Signal, pixel, 0);
    vec4 mean = g.weight == 1.0 ? vec4(0.0) : texelFetch(gIn_Mean, pixel, 0);
    for (int c = 0; c < 4; c++) signal[c] = usable(signal[c], mean[c]);
    // a + (b - a) w is exact for a = b.
    imageStore(gOut_Mean, pixel, mean + (signal - mean) * g.weight);
}
