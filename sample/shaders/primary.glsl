// What the camera sees in a pixel: the first surface, or with primary surface replacement the first one that is no
// mirror, unfolded to where the camera believes it to be.
#ifndef PRIMARY_GLSL
#define PRIMARY_GLSL
#include "bsdf.glsl"

layout(constant_id = 11) const bool kHasMirrors = false; // mirrors are followed

const uint kMaxMirrors = 8u; // the next one is shown as a surface of its own
const float kMirrorAlbedo = 0.02; // of what shines through the mirror and would be lost

struct Primary
{
    Surface surface; // where it is; fetched from somewhere for the sky
    Hit hit;
    bool isSky;
    vec3 direction;  // of the ray that found it
    float distance;  // from the camera, along the whole way
    float width;     // of the ray, world units
    vec3 tint;       // share of the surface's light that reaches the camera
    vec3 direct;     // what surface, mirrors and sky shine by themselves, with the tint
    NRD_Unfolding unfolding;
    NRD_Unfolding unfoldingBefore; // as it was in the frame before
};

bool isMirror(Surface s)
{
    bool isSmooth = s.roughness <= g.limits.y && brightest(s.albedo) < kMirrorAlbedo;
    // A shading normal may reflect into the mirror.
    return isSmooth && dot(reflect(-s.view, s.normal), s.geometricNormal) > 0.0;
}

// The shading normal of the frame before: it turns as its triangle does.
vec3 fetchNormalBefore(Hit hit, Surface s)
{
    int i = 3 * hit.triangle;
    vec3 m0 = uintBitsToFloat(texelFetch(gMotion, i).xyz);
    vec3 m1 = uintBitsToFloat(texelFetch(gMotion, i + 1).xyz), m2 = uintBitsToFloat(texelFetch(gMotion, i + 2).xyz);
    vec3 e1 = uintBitsToFloat(texelFetch(gTriangles, i + 1).xyz);
    vec3 e2 = uintBitsToFloat(texelFetch(gTriangles, i + 2).xyz);
    vec3 now = normalize(cross(e1, e2));
    vec3 before = NRD_NormalizeOrZero(cross(e1 + m1 - m0, e2 + m2 - m0));
    before = dot(before, before) > 0.0 ? before : now; // it had no area
    return normalize(s.normal + (before - now) * (dot(now, s.geometricNormal) < 0.0 ? -1.0 : 1.0));
}

// Past the mirror that p.surface is.
void reflectOff(inout Primary p, inout vec3 origin)
{
    Surface s = p.surface;
    p.unfolding = NRD_Unfolding_AddMirror(p.unfolding, s.position, s.normal);
    vec3 motion = kHasMotion ? fetchMotion(p.hit) : vec3(0.0);
    vec3 normalBefore = kHasMotion ? fetchNormalBefore(p.hit, s) : s.normal;
    p.unfoldingBefore = NRD_Unfolding_AddMirror(p.unfoldingBefore, s.position + motion, normalBefore);
    p.tint *= specularAlbedo(s, energyOf(clamp(dot(s.normal, s.view), 1e-3, 1.0), s.roughness));
    p.direction = reflect(p.direction, s.normal);
    origin = offsetOrigin(s, p.direction);
}

Primary findPrimary(vec3 origin, vec3 direction)
{
    Primary p;
    p.direction = direction;
    p.distance = 0.0;
    p.tint = vec3(1.0);
    p.direct = vec3(0.0);
    p.unfolding = p.unfoldingBefore = NRD_Unfolding_Begin();
    for (uint mirrors = 0u;; ++mirrors)
    {
        p.hit = traceRay(origin, p.direction, 1e30);
        p.tint *= tintUpTo(origin, p.direction, p.hit.t);
        p.isSky = p.hit.triangle == kNoHit;
        p.hit.triangle = p.isSky ? 0 : p.hit.triangle; // the fetches run in any case
        p.distance += p.isSky ? 0.0 : p.hit.t;
        p.width = p.isSky ? 0.0 : g.frustum.z * p.distance;
        p.surface = fetchSurface(p.hit, p.direction, p.width, 0.0);
        if (!p.isSky) p.direct += p.surface.emission * p.tint;
        if (!kHasMirrors || p.isSky || mirrors == kMaxMirrors || !isMirror(p.surface)) break;
        reflectOff(p, origin);
    }
    if (kHasEnvironment && p.isSky) p.direct += environmentSmooth(p.direction) * p.tint;
    return p;
}

vec3 unfoldPosition(Primary p, vec3 position)
{
    return kHasMirrors ? NRD_Unfolding_GetPosition(p.unfolding, position) : position;
}

vec3 unfoldDirection(Primary p, vec3 direction)
{
    return kHasMirrors ? NRD_Unfolding_GetDirection(p.unfolding, direction) : direction;
}

// `motion`: previous minus current position of what is at `position`.
vec3 unfoldMotion(Primary p, vec3 position, vec3 motion)
{
    return kHasMirrors ? NRD_Unfolding_GetMotion(p.unfolding, p.unfoldingBefore, position, motion) : motion;
}
#endif
