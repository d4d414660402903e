// Samples one texture at a list of coordinates through all four samplers.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler gNearestClamp;
layout(set = 0, binding = 1) uniform sampler gLinearClamp;
layout(set = 0, binding = 2) uniform sampler gNearestMirror;
layout(set = 0, binding = 3) uniform sampler gLinearMirror;
layout(set = 1, binding = 0) uniform texture2D gIn;
layout(set = 1, binding = 1, std430) readonly buffer Coordinates { vec2 uv[]; } gCoordinates;
layout(set = 1, binding = 2, std430) writeonly buffer Out { vec4 samples[]; } gOut; // one component per sampler

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= gCoordinates.uv.length()) return;
    vec2 uv = gCoordinates.uv[i];
    float nearestClamp = textureLod(sampler2D(gIn, gNearestClamp), uv, 0.0).x;
    float linearClamp = textureLod(sampler2D(gIn, gLinearClamp), uv, 0.0).x;
    float nearestMirror = textureLod(sampler2D(gIn, gNearestMirror), uv, 0.0).x;
    float linearMirror = textureLod(sampler2D(gIn, gLinearMirror), uv, 0.0).x;
    gOut.samples[i] = vec4(nearestClamp, linearClamp, nearestMirror, linearMirror);
}
