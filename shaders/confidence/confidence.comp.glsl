// The share of the luminance that has changed -> how far history can be trusted, for the whole output: the denoisers
// sample it over [0; 1]^2, whatever part of the resource the last frame had.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "confidence.glsl"

layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Gradient;
layout(set = SET_RESOURCES, binding = 1) uniform writeonly image2D gOut_DiffuseConfidence;
layout(set = SET_RESOURCES, binding = 2) uniform writeonly image2D gOut_SpecularConfidence;

vec2 confidenceOf(vec4 gradient)
{
    // minLuminance is a divisor, too: black that stays black has not changed.
    vec2 change = gradient.xy / max(gradient.zw, g.minLuminance);
    return 1.0 - clamp(g.sensitivity * (change - g.tolerance), 0.0, 1.0);
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    vec2 uv = (vec2(texel) + 0.5) * g.outputSizeInv;
    if (any(greaterThanEqual(uv, vec2(1.0)))) return;
    // Outlines run through tiles, and confidence is read between them: the least of the neighbours leaves no rim of old
    // light next to what has not changed, or has none.
    vec2 confidence = vec2(1.0);
    for (int i = 0; i < 9; i++)
    {
        ivec2 tile = clamp(ivec2(uv * g.rectSizePrev) + ivec2(i % 3, i / 3) - 1, ivec2(0), ivec2(g.rectSizePrev) - 1);
        confidence = min(confidence, confidenceOf(texelFetch(gIn_Gradient, tile, 0)));
    }
    imageStore(gOut_DiffuseConfidence, texel, vec4(confidence.x));
    imageStore(gOut_SpecularConfidence, texel, vec4(confidence.y));
}
