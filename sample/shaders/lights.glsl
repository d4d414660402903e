// Next-event estimation: one light out of emissive triangles, punctual lights and the environment, by its power.
#ifndef LIGHTS_GLSL
#define LIGHTS_GLSL
#include "sampling.glsl"
#include "surface.glsl"

const uint kTriangleLight = 0u;
const uint kPointLight = 1u;
const uint kSpotLight = 2u;
const uint kDirectionalLight = 3u;
const uint kEnvironmentLight = 4u;
const int kLightWords = 5;

struct LightSample
{
    vec3 direction; // unit, to the light
    float distance; // of the shadow ray
    vec3 radiance;  // divided by the probability density
    float pdf;      // per solid angle, 0: a delta light that no other technique can find
};

int environmentTexel(vec3 d)
{
    ivec2 size = ivec2(g.environment.xy);
    float u = 0.5 + atan(d.x, -d.z) / (2.0 * kPi);
    float v = acos(clamp(d.y, -1.0, 1.0)) / kPi;
    ivec2 at = clamp(ivec2(vec2(u, v) * vec2(size)), ivec2(0), size - 1);
    return at.y * size.x + at.x;
}

// Radiance and, in .w, the density of sampleEnvironment(), per solid angle.
vec4 environmentAt(vec3 d)
{
    return uintBitsToFloat(texelFetch(gEnvironment, 2 * environmentTexel(d)));
}

// Bilinear, for what the camera sees directly.
vec3 environmentSmooth(vec3 d)
{
    ivec2 size = ivec2(g.environment.xy);
    float u = 0.5 + atan(d.x, -d.z) / (2.0 * kPi);
    float v = acos(clamp(d.y, -1.0, 1.0)) / kPi;
    vec2 at = vec2(u, v) * vec2(size) - 0.5;
    ivec2 i = ivec2(floor(at));
    vec2 f = at - vec2(i);
    vec3 corner[4];
    for (int k = 0; k < 4; ++k)
    {
        ivec2 p = i + ivec2(k & 1, k >> 1);
        p = ivec2((p.x + size.x) % size.x, clamp(p.y, 0, size.y - 1));
        corner[k] = uintBitsToFloat(texelFetch(gEnvironment, 2 * (p.y * size.x + p.x)).xyz);
    }
    return mix(mix(corner[0], corner[1], f.x), mix(corner[2], corner[3], f.x), f.y);
}

LightSample sampleEnvironment(vec2 u)
{
    uint count = g.environment.x * g.environment.y;
    float scaled = u.x * float(count);
    uint texel = min(uint(scaled), count - 1u);
    float rest = scaled - float(texel);
    uvec4 entry = texelFetch(gEnvironment, 2 * int(texel) + 1);
    float threshold = uintBitsToFloat(entry.x);
    // The fraction that chose the entry is stretched and used again.
    bool isSelf = rest < threshold;
    texel = isSelf ? texel : entry.y;
    float within = isSelf ? rest / max(threshold, 1e-6) : (rest - threshold) / max(1.0 - threshold, 1e-6);
    within = clamp(within, 0.0, 0.999999);
    vec4 light = uintBitsToFloat(texelFetch(gEnvironment, 2 * int(texel)));
    uint x = texel % g.environment.x, y = texel / g.environment.x;
    float phi = ((float(x) + within) / float(g.environment.x) - 0.5) * 2.0 * kPi;
    // Uniform in the cosine, so that all directions of the texel are equally likely.
    float top = cos(kPi * float(y) / float(g.environment.y));
    float bottom = cos(kPi * float(y + 1u) / float(g.environment.y));
    float cosine = mix(top, bottom, u.y);
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    return LightSample(vec3(sine * sin(phi), cosine, -sine * cos(phi)), 1e30, light.xyz, light.w);
}

LightSample sampleTriangle(Surface s, int triangle, vec2 u)
{
    uvec4 a0 = texelFetch(gTriangles, 3 * triangle);
    vec3 corner = uintBitsToFloat(a0.xyz);
    vec3 e1 = uintBitsToFloat(texelFetch(gTriangles, 3 * triangle + 1).xyz);
    vec3 e2 = uintBitsToFloat(texelFetch(gTriangles, 3 * triangle + 2).xyz);
    float root = sqrt(u.x);
    vec2 b = vec2(root * (1.0 - u.y), root * u.y);
    vec3 toLight = corner + e1 * b.x + e2 * b.y - s.position;
    float distance2 = max(dot(toLight, toLight), 1e-12);
    float distance = sqrt(distance2);
    vec3 direction = toLight / distance;
    vec3 normal = cross(e1, e2);
    float doubleArea = length(normal);
    float cosine = -dot(normal, direction) / max(doubleArea, 1e-20);
    int material = int(a0.w);
    vec3 emission = uintBitsToFloat(texelFetch(gMaterials, 16 * material + 1).xyz);
    bool isTwoSided = uintBitsToFloat(texelFetch(gMaterials, 16 * material + 2).w) > 0.5;
    cosine = isTwoSided ? abs(cosine) : cosine;
    if (kHasTextures) emission *= srgbToLinear(fetchTexture(triangle, material, kEmissive, b, -20.0).rgb);
    if (cosine <= 1e-6) return LightSample(direction, 0.0, vec3(0.0), 1.0);
    return LightSample(direction, distance * 0.9999, emission, 2.0 * distance2 / (cosine * doubleArea));
}

// A point of a disc across the unit vector `axis`; u = 0: its middle.
vec3 sampleDisc(vec3 axis, float radius, vec2 u)
{
    vec3 t, b;
    makeFrame(axis, t, b);
    float r = radius * sqrt(u.x), phi = 2.0 * kPi * u.y;
    return t * (r * cos(phi)) + b * (r * sin(phi));
}

LightSample samplePunctual(Surface s, int light, uint type, vec2 u)
{
    vec4 place = uintBitsToFloat(texelFetch(gLights, kLightWords * light + 1)); // position, range
    vec4 aim = uintBitsToFloat(texelFetch(gLights, kLightWords * light + 2));   // direction, inner cosine
    vec4 power = uintBitsToFloat(texelFetch(gLights, kLightWords * light + 3)); // intensity, outer cosine
    float radius = uintBitsToFloat(texelFetch(gLights, kLightWords * light + 4).x); // a sun's: tangent
    if (type == kDirectionalLight)
        return LightSample(normalize(sampleDisc(-aim.xyz, radius, u) - aim.xyz), 1e30, power.rgb, 0.0);
    vec3 toLight = place.xyz - s.position;
    float distance2 = max(dot(toLight, toLight), 1e-8);
    float distance = sqrt(distance2);
    vec3 direction = toLight / distance;
    float ratio = place.w > 0.0 ? distance / place.w : 0.0;
    float window = clamp(1.0 - ratio * ratio * ratio * ratio, 0.0, 1.0);
    float cone = clamp((-dot(direction, aim.xyz) - power.w) / max(aim.w - power.w, 1e-4), 0.0, 1.0);
    float fade = type == kSpotLight ? cone * cone : 1.0;
    toLight += sampleDisc(direction, radius, u);
    return LightSample(normalize(toLight), length(toLight) * 0.9999, power.rgb * (window * fade / distance2), 0.0);
}

// The word of a light's row that has its entry of the alias table; the primary surface leaves out the shadow's light.
int tableWord(bool isPrimary)
{
    return kHasShadowLight && isPrimary ? 4 : 0;
}

float lightProbability(int light, bool isPrimary)
{
    return uintBitsToFloat(texelFetch(gLights, kLightWords * light + tableWord(isPrimary)).y);
}

LightSample sampleLights(Surface s, float choice, vec2 u, bool isPrimary)
{
    LightSample light = LightSample(vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 1.0);
    if (g.size.w == 0u) return light;
    float scaled = choice * float(g.size.w);
    uint index = min(uint(scaled), g.size.w - 1u);
    uvec4 entry = texelFetch(gLights, kLightWords * int(index) + tableWord(isPrimary));
    if (scaled - float(index) >= uintBitsToFloat(entry.z)) index = entry.w;
    if (kHasShadowLight && isPrimary && index == g.shadow.x) return light; // it is the only one
    uint type = texelFetch(gLights, kLightWords * int(index)).x;
    if (kHasTriangleLights && type == kTriangleLight)
        light = sampleTriangle(s, int(texelFetch(gLights, kLightWords * int(index) + 1).x), u);
    if (kHasPunctualLights && type != kTriangleLight && type != kEnvironmentLight)
        light = samplePunctual(s, int(index), type, u);
    if (kHasEnvironment && type == kEnvironmentLight) light = sampleEnvironment(u);
    float probability = lightProbability(int(index), isPrimary);
    bool isDelta = light.pdf == 0.0;
    light.pdf *= probability;
    light.radiance /= max(isDelta ? probability : light.pdf, 1e-20);
    return light;
}

// Density with which sampleLights() finds the point that a ray from `origin` hit after `distance`.
float lightPdf(Surface hit, Hit at, float distance, bool isPrimary)
{
    vec3 e1 = uintBitsToFloat(texelFetch(gTriangles, 3 * at.triangle + 1).xyz);
    vec3 e2 = uintBitsToFloat(texelFetch(gTriangles, 3 * at.triangle + 2).xyz);
    float cosine = max(dot(hit.geometricNormal, hit.view), 1e-6);
    float doubleArea = max(length(cross(e1, e2)), 1e-20);
    return lightProbability(int(hit.light) - 1, isPrimary) * 2.0 * distance * distance / (cosine * doubleArea);
}
#endif
