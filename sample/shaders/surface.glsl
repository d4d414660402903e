// From a hit to everything the shading needs.
#ifndef SURFACE_GLSL
#define SURFACE_GLSL
#include "traversal.glsl"

struct Surface
{
    vec3 position;
    vec3 geometricNormal; // unit, on the viewer's side
    vec3 normal;          // unit, shading normal, on the viewer's side
    vec3 view;            // unit, to the viewer
    vec3 albedo;          // of the diffuse lobe: 0 for metals
    vec3 f0;
    float roughness; // linear
    vec3 emission;   // towards the viewer
    uint light;      // index among the lights plus 1, 0: does not emit
    uint material;
};

const float kMinRoughness = 0.04; // below it the distribution of normals loses its digits

vec3 unpackNormal(uint bits)
{
    return octDecode(unpackSnorm2x16(bits));
}

// The tangent has 15 bits for y; the lowest bit is the bitangent's sign.
vec4 unpackTangent(uint bits)
{
    return vec4(octDecode(unpackSnorm2x16(bits & 0xFFFEFFFFu)), (bits & 0x00010000u) != 0u ? -1.0 : 1.0);
}

vec3 applyNormalMap(vec3 n, int triangle, int material, vec2 b, float logWidth, float scale)
{
    vec4 t0 = unpackTangent(texelFetch(gVertices, 6 * triangle).y);
    vec4 t1 = unpackTangent(texelFetch(gVertices, 6 * triangle + 2).y);
    vec4 t2 = unpackTangent(texelFetch(gVertices, 6 * triangle + 4).y);
    vec3 t = t0.xyz * (1.0 - b.x - b.y) + t1.xyz * b.x + t2.xyz * b.y;
    t -= n * dot(n, t);
    float size = length(t);
    bool hasMap = texelFetch(gMaterials, 16 * material + 3 + 3 * kNormal).x != kNoTexture;
    if (!hasMap || size < 1e-6) return n;
    t /= size;
    vec3 bitangent = cross(n, t) * t0.w;
    vec3 m = fetchTexture(triangle, material, kNormal, b, logWidth).xyz * 2.0 - 1.0;
    vec3 mapped = t * (m.x * scale) + bitangent * (m.y * scale) + n * max(m.z, 1e-3);
    return normalize(mapped);
}

// log2 of the ray's width in units of the first texture coordinates.
float logFootprint(int triangle, vec3 e1, vec3 e2, float width, float cosine)
{
    vec2 a = uintBitsToFloat(texelFetch(gVertices, 6 * triangle).zw);
    vec2 b = uintBitsToFloat(texelFetch(gVertices, 6 * triangle + 2).zw);
    vec2 c = uintBitsToFloat(texelFetch(gVertices, 6 * triangle + 4).zw);
    float uvArea = abs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
    float area = length(cross(e1, e2));
    return log2(max(width, 1e-10)) + 0.5 * log2(max(uvArea, 1e-20) / max(area * cosine, 1e-20));
}

vec3 smoothNormal(int triangle, vec2 b, vec3 otherwise)
{
    vec3 n0 = unpackNormal(texelFetch(gVertices, 6 * triangle).x);
    vec3 n1 = unpackNormal(texelFetch(gVertices, 6 * triangle + 2).x);
    vec3 n2 = unpackNormal(texelFetch(gVertices, 6 * triangle + 4).x);
    vec3 n = n0 * (1.0 - b.x - b.y) + n1 * b.x + n2 * b.y;
    return dot(n, n) > 1e-8 ? normalize(n) : otherwise;
}

// `width` is the width of the ray where it hits, in world units; `minRoughness` is what the path demands.
Surface fetchSurface(Hit hit, vec3 direction, float width, float minRoughness)
{
    int i = hit.triangle;
    vec2 b = hit.barycentrics;
    uvec4 a0 = texelFetch(gTriangles, 3 * i), a1 = texelFetch(gTriangles, 3 * i + 1);
    uvec4 a2 = texelFetch(gTriangles, 3 * i + 2);
    vec3 e1 = uintBitsToFloat(a1.xyz), e2 = uintBitsToFloat(a2.xyz);
    int material = int(a0.w);
    vec4 baseColor = uintBitsToFloat(texelFetch(gMaterials, 16 * material));
    vec3 emission = uintBitsToFloat(texelFetch(gMaterials, 16 * material + 1).xyz);
    // Metallic, roughness, scale of the normal map, two-sided.
    vec4 parameters = uintBitsToFloat(texelFetch(gMaterials, 16 * material + 2));

    Surface s;
    s.position = uintBitsToFloat(a0.xyz) + e1 * b.x + e2 * b.y;
    s.geometricNormal = normalize(cross(e1, e2));
    bool isFront = dot(s.geometricNormal, direction) < 0.0;
    s.geometricNormal = isFront ? s.geometricNormal : -s.geometricNormal;
    s.view = -direction;
    s.material = a0.w;
    s.light = a2.w;

    vec3 n = smoothNormal(i, b, s.geometricNormal);
    if (kHasTextures)
    {
        float logWidth = logFootprint(i, e1, e2, width, abs(dot(s.geometricNormal, direction)));
        vec4 texel = fetchTexture(i, material, kBaseColor, b, logWidth);
        baseColor.rgb *= srgbToLinear(texel.rgb) * colorOf(i, b).rgb;
        vec4 mr = fetchTexture(i, material, kMetallicRoughness, b, logWidth);
        parameters.xy *= mr.bg;
        n = applyNormalMap(n, i, material, b, logWidth, parameters.z);
        emission *= srgbToLinear(fetchTexture(i, material, kEmissive, b, logWidth).rgb);
    }
    n = dot(n, s.geometricNormal) < 0.0 ? -n : n;
    // A shading normal turned away from the viewer is bent back until it is just visible.
    float nov = dot(n, s.view);
    s.normal = nov < 0.01 ? normalize(n + s.view * (0.01 - nov)) : n;
    s.albedo = baseColor.rgb * (1.0 - parameters.x);
    s.f0 = mix(vec3(0.04), baseColor.rgb, parameters.x);
    s.roughness = clamp(parameters.y, max(kMinRoughness, minRoughness), 1.0);
    s.emission = isFront || parameters.w > 0.5 ? emission : vec3(0.0);
    return s;
}

// World position of the hit in the previous frame minus now.
vec3 fetchMotion(Hit hit)
{
    vec3 m0 = uintBitsToFloat(texelFetch(gMotion, 3 * hit.triangle).xyz);
    vec3 m1 = uintBitsToFloat(texelFetch(gMotion, 3 * hit.triangle + 1).xyz);
    vec3 m2 = uintBitsToFloat(texelFetch(gMotion, 3 * hit.triangle + 2).xyz);
    vec2 b = hit.barycentrics;
    return m0 * (1.0 - b.x - b.y) + m1 * b.x + m2 * b.y;
}

// Off the surface far enough that a ray from there doesn't hit it again; on the side `direction` goes to.
vec3 offsetOrigin(Surface s, vec3 direction)
{
    vec3 p = abs(s.position);
    float distance = g.jitter.z * max(p.x, max(p.y, p.z)) + g.jitter.w;
    return s.position + s.geometricNormal * (dot(direction, s.geometricNormal) < 0.0 ? -distance : distance);
}
#endif
