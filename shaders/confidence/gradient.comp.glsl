// What has changed about the sample of each tile: the difference of luminance and the larger of both, by lobe.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "confidence.glsl"

layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_StoredSample;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_RetracedSample;
layout(set = SET_RESOURCES, binding = 2) uniform writeonly image2D gOut_Gradient; // .xy differences, .zw luminances

// A ray that meets another surface now says nothing about light, only that the reprojection will find no history.
float sameSurface(float a, float b) { return ramp(0.25, 0.05, abs(a - b) / max(a, b)); }

vec4 gradientOf(ivec2 tile)
{
    vec4 stored = texelFetch(gIn_StoredSample, tile, 0), retraced = texelFetch(gIn_RetracedSample, tile, 0);
    // A sample that is no number takes no part.
    if (!NRD_IsRadianceFinite(stored.xyz) || !NRD_IsRadianceFinite(retraced.xyz)) return vec4(0.0);
    float storedZ = decodeViewZ(stored.z), retracedZ = decodeViewZ(retraced.z);
    if (!isInRange(storedZ) || !isInRange(retracedZ)) return vec4(0.0);
    vec2 before = clamp(stored.xy, 0.0, g.maxLuminance), now = clamp(retraced.xy, 0.0, g.maxLuminance);
    return vec4(abs(now - before), max(now, before)) * sameSurface(storedZ, retracedZ);
}

void main()
{
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(tile)) return;
    imageStore(gOut_Gradient, tile, g.isHistoryReset != 0u ? vec4(0.0) : gradientOf(tile));
}
