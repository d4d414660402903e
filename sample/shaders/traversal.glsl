// Rays against the threaded hierarchy of bvh.h: no stack, one loop over boxes, one over the triangles of a leaf.
#ifndef TRAVERSAL_GLSL
#define TRAVERSAL_GLSL
#include "textures.glsl"

const float kEdge = 1e-5; // share of a triangle

// What a ray is for decides what stops it.
const uint kSight = 0u;  // the camera's: glass, and blended surfaces from an alpha of one half on
const uint kBounce = 1u; // a path's: the same but for glass
const uint kLight = 2u;  // only what lets no light through

struct Hit
{
    int triangle; // position in gTriangles / 3, kNoHit: none
    float t;
    vec2 barycentrics; // of the second and third corner
};

// What a ray met that blended surfaces don't stop.
struct Passage
{
    vec3 transmittance; // 0 behind an opaque surface
    float distance;     // to the nearest opaque surface, else to the nearest blended one; kNever: it met nothing
};

const float kNever = 1e30;

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

// Word 15 of its material: blended (or glass), glass, index of refraction, solid.
uvec4 mediumOf(int triangle)
{
    return texelFetch(gMaterials, 16 * int(texelFetch(gTriangles, 3 * triangle).w) + 15);
}

bool isBlended(int triangle)
{
    return mediumOf(triangle).x != 0u;
}

bool isGlass(int triangle)
{
    return kHasGlass && mediumOf(triangle).y != 0u;
}

// Transmittances multiply in whatever order the surfaces are found.
bool isPassed(int triangle, vec2 barycentrics, float t, inout Passage passage)
{
    int material = int(texelFetch(gTriangles, 3 * triangle).w);
    vec3 through = fetchTransmittance(triangle, material, barycentrics);
    if (brightest(through) < 1.0 / 512.0) return false;
    passage.transmittance *= through;
    if (through != vec3(1.0)) passage.distance = min(passage.distance, t);
    return true;
}

// Moeller and Trumbore 1997; a degenerate triangle gives NaN, which fails every comparison.
void testLeaf(uint leaf, vec3 origin, vec3 direction, uint purpose, inout Hit hit, inout Passage passage)
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
        if (kHasBlended && purpose == kLight && isBlended(i))
            isHit = isHit && !isPassed(i, uv, t, passage);
        else if (kHasAlphaMask)
            isHit = isHit && ((purpose == kSight && isGlass(i)) || !isCutOut(i, uv));
        if (isHit) hit = Hit(i, t, uv);
    }
}

// Nearest hit in (0; tMax), or with `isAnyEnough` the first that is found.
Hit traceRay(vec3 origin, vec3 direction, float tMax, bool isAnyEnough, uint purpose, inout Passage passage)
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
        testLeaf(leaf, origin, direction, purpose, hit, passage);
        if (isAnyEnough && hit.triangle != kNoHit) break;
    }
    return hit;
}

// What the camera or a bounce sees.
Hit traceRay(vec3 origin, vec3 direction, float tMax, uint purpose)
{
    Passage unused = Passage(vec3(1.0), kNever);
    return traceRay(origin, direction, tMax, false, purpose, unused);
}

// Of light on its way through (0; tMax); with `isAnyEnough` .distance is that of any opaque surface.
Passage tracePassage(vec3 origin, vec3 direction, float tMax, bool isAnyEnough)
{
    Passage passage = Passage(vec3(1.0), kNever);
    Hit hit = traceRay(origin, direction, tMax, isAnyEnough, kLight, passage);
    return hit.triangle == kNoHit ? passage : Passage(vec3(0.0), hit.t);
}

// Of the blended surfaces before what traceRay() found at t, which may be one itself.
vec3 tintUpTo(vec3 origin, vec3 direction, float t)
{
    return kHasBlended ? tracePassage(origin, direction, 0.9999 * t, true).transmittance : vec3(1.0);
}
#endif
