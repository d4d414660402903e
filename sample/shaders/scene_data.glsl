// The scene on the device. Texel buffers rather than storage buffers: llvmpipe reads them ten times faster.
#ifndef SCENE_DATA_GLSL
#define SCENE_DATA_GLSL
#include "trace_constants.h"

// Off: the code for it is not compiled, which matters on SIMD machines that run both sides of every branch.
layout(constant_id = 0) const bool kHasTextures = true; // or vertex colours
layout(constant_id = 1) const bool kHasAlphaMask = true;
layout(constant_id = 2) const bool kHasTriangleLights = true;
layout(constant_id = 3) const bool kHasPunctualLights = true;
layout(constant_id = 4) const bool kHasEnvironment = true;
layout(constant_id = 5) const bool kHasMotion = true;
layout(constant_id = 8) const bool kHasShadowLight = true; // its light at the primary surface is a signal of its own
layout(constant_id = 9) const bool kHasBlended = true;     // materials that let light through
layout(constant_id = 12) const bool kHasGlass = true;      // and that the camera sees through

layout(set = 0, binding = 0, std140) uniform Constants { TraceConstants g; };
layout(set = 0, binding = 1) uniform usamplerBuffer gNodes;       // 2 per node
layout(set = 0, binding = 2) uniform usamplerBuffer gTriangles;   // 3 per triangle, in the order of the leaves
layout(set = 0, binding = 3) uniform usamplerBuffer gVertices;    // 6 per triangle
layout(set = 0, binding = 4) uniform usamplerBuffer gMotion;      // 3 per triangle, previous minus current position
layout(set = 0, binding = 5) uniform usamplerBuffer gMaterials;   // 16 per material
layout(set = 0, binding = 6) uniform samplerBuffer gTexels;       // all mips of all textures
layout(set = 0, binding = 7) uniform usamplerBuffer gLights;      // 5 per light
layout(set = 0, binding = 8) uniform usamplerBuffer gEnvironment; // 2 per texel
layout(set = 0, binding = 9) uniform samplerBuffer gEnergy;       // 32 x 32: NoV across, roughness down

const float kPi = 3.14159265359;
const float kMiss = 65504.0; // hit distance of a ray that left the scene
const int kNoHit = -1;

float luminance(vec3 c)
{
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

float brightest(vec3 c)
{
    return max(c.r, max(c.g, c.b));
}

// Two unit vectors that make a right-handed frame with n; Duff et al. 2017.
void makeFrame(vec3 n, out vec3 t, out vec3 b)
{
    float s = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (s + n.z);
    float c = n.x * n.y * a;
    t = vec3(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
    b = vec3(c, s + n.y * n.y * a, -n.y);
}

vec3 octDecode(vec2 e)
{
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float t = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -t : t;
    n.y += n.y >= 0.0 ? -t : t;
    return normalize(n);
}
#endif
