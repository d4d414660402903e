// The share of the luminance that has changed -> how far history can be trusted, for the whole output: the denoisers
// sample it over [0; 1]^2, whatever part of the resource the last frame had.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "confidence.glsl"

layout(set = SET_CONSTANTS, binding = BINDING_SAMPLERS + 1) uniform sampler gLinearClamp;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Gradient;
layout(set = SET_RESOURCES, binding = 1) uniform writeonly image2D gOut_DiffuseConfidence;
layout(set = SET_RESOURCES, binding = 2) uniform writeonly image2D gOut_SpecularConfidence;

// minLuminance is a divisor, too: black that stays black has not changed.
vec2 changeOf(vec4 gradient) { return gradient.xy / max(gradient.zw, g.minLuminance); }

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    vec2 uv = (vec2(texel) + 0.5) * g.outputSizeInv;
    if (any(greaterThanEqual(uv, vec2(1.0)))) return;
    // Half a tile from the border, beyond which tiles are of no frame.
    vec2 tile = clamp(uv * g.rectSizePrev, vec2(0.5), g.rectSizePrev - 0.5);
    vec4 gradient = textureLod(sampler2D(gIn_Gradient, gLinearClamp), tile * g.outputSizeInv, 0.0);
    vec2 confidence = 1.0 - clamp(g.sensitivity * (changeOf(gradient) - g.tolerance), 0.0, 1.0);
    imageStore(gOut_DiffuseConfidence, texel, vec4(confidence.x));
    imageStore(gOut_SpecularConfidence, texel, vec4(confidence.y));
}
