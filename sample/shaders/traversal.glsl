// Rays against the threaded hierarchy of bvh.h: no stack, one loop over boxes, one over the triangles of a leaf.
#ifndef TRAVERSAL_GLSL
#define TRAVERSAL_GLSL
#include "textures.glsl"

const float kEdge = 1e-5; // share of a triangle

struct Hit
{
    int triangle; // position in gTriangles / 3, kNoHit: none
    float t;
    vec2 barycentrics; // of the second and third corner
};

// A zero component would make infinity times zero in the slab test.
vec3 safeInverse(vec3 d)
{
    const float kTiny = 1e-20;
    return 1.0 / vec3(abs(d.x) < kTiny ? kTiny : d.x, abs(d.y) < kTiny ? kTiny : d.y, abs(d.z) < kTiny ? kTiny : d.z);
}

bool isCutOut(int triangle, vec2 barycentrics)
{
    uint material = texelFetch(gTriangles, 3 * triangle).w;
    float cutoff = uintBitsToFloat(texelFetch(gMaterials, 16 * int(material) + 1).w);
    if (cutoff <= 0.0) return false;
    return fetchAlpha(triangle, int(material), barycentrics) < cutoff;
}

// Moeller and Trumbore 1997; a degenerate triangle gives NaN, which fails every comparison.
void testLeaf(uint leaf, vec3 origin, vec3 direction, inout Hit hit)
{
    int last = int(leaf >> 3) + int(leaf & 7u);
    for (int i = int(leaf >> 3); i < last; ++i)
    {
        vec3 corner = uintBitsToFloat(texelFetch(gTriangles, 3 * i).xyz);
        vec3 e1 = uintBitsToFloat(texelFetch(gTriangles, 3 * i + 1).xyz);
        vec3 e2 = uintBitsToFloat(texelFetch(gTriangles, 3 * i + 2).xyz);
        vec3 p = cross(direction, e2);
        float scale = 1.0 / dot(e1, p);
        vec3 s = origin - corner;
        vec3 q = cross(s, e1);
        vec2 uv = vec2(dot(s, p), dot(direction, q)) * scale;
        float t = dot(e2, q) * scale;
        // A hair wider than the triangle: rounding must not open cracks between neighbours.
        bool isHit = min(uv.x, uv.y) >= -kEdge && uv.x + uv.y <= 1.0 + kEdge && t > 0.0 && t < hit.t;
        if (kHasAlphaMask) isHit = isHit && !isCutOut(i, uv);
        if (isHit) hit = Hit(i, t, uv);
    }
}

// Nearest hit in (0; tMax), or with `isAnyEnough` the first that is found.
Hit traceRay(vec3 origin, vec3 direction, float tMax, bool isAnyEnough)
{
    vec3 inverse = safeInverse(direction);
    vec3 shifted = -origin * inverse;
    uint octant = (direction.x < 0.0 ? 1u : 0u) | (direction.y < 0.0 ? 2u : 0u) | (direction.z < 0.0 ? 4u : 0u);
    int first = int(octant * g.size.z);
    int end = first + int(g.size.z);
    int node = first;
    Hit hit = Hit(kNoHit, tMax, vec2(0.0));
    while (true)
    {
        // All lanes look for a leaf before any of them tests triangles: branches cost both their sides on SIMD.
        uint leaf = 0u;
        while (node < end && leaf == 0u)
        {
            uvec4 a = texelFetch(gNodes, 2 * node);
            uvec4 b = texelFetch(gNodes, 2 * node + 1);
            vec3 t0 = uintBitsToFloat(a.xyz) * inverse + shifted;
            vec3 t1 = uintBitsToFloat(b.xyz) * inverse + shifted;
            vec3 low = min(t0, t1), high = max(t0, t1);
            float near = max(max(low.x, low.y), max(low.z, 0.0));
            float far = min(min(high.x, high.y), min(high.z, hit.t));
            bool isInside = near <= far * 1.0000004; // covers the rounding of the slab test (Ize 2013)
            leaf = isInside ? b.w : 0u;
            node = isInside && b.w == 0u ? node + 1 : first + int(a.w);
        }
        if (leaf == 0u) break;
        testLeaf(leaf, origin, direction, hit);
        if (isAnyEnough && hit.triangle != kNoHit) break;
    }
    return hit;
}
#endif
