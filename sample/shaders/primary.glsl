// What the camera sees in a pixel: the first surface that is no glass, or with primary surface replacement the first one
// that is no mirror either, unfolded to where the camera believes it to be.
#ifndef PRIMARY_GLSL
#define PRIMARY_GLSL
#include "bsdf.glsl"

layout(constant_id = 11) const bool kHasMirrors = false; // mirrors are followed

const bool kHasUnfolding = kHasMirrors || kHasGlass;
const uint kMaxSteps = 12u; // mirrors and sides of glass; the next one is shown as a surface of its own
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
    bool isSmooth = kHasMirrors && s.roughness <= g.limits.y && brightest(s.albedo) < kMirrorAlbedo;
    // A shading normal may reflect into the mirror.
    return isSmooth && dot(reflect(-s.view, s.normal), s.geometricNormal) > 0.0;
}

vec3 mirrorAlbedo(Surface s)
{
    return specularAlbedo(s, energyOf(clamp(dot(s.normal, s.view), 1e-3, 1.0), s.roughness));
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

// Past the mirror that p.surface is, whose light is reflected by that share.
void reflectOff(inout Primary p, inout vec3 origin, vec3 share)
{
    Surface s = p.surface;
    p.unfolding = NRD_Unfolding_AddMirror(p.unfolding, s.position, s.normal);
    vec3 motion = kHasMotion ? fetchMotion(p.hit) : vec3(0.0);
    vec3 normalBefore = kHasMotion ? fetchNormalBefore(p.hit, s) : s.normal;
    p.unfoldingBefore = NRD_Unfolding_AddMirror(p.unfoldingBefore, s.position + motion, normalBefore);
    p.tint *= share;
    p.direction = reflect(p.direction, s.normal);
    origin = offsetOrigin(s, p.direction);
}

// Unpolarised, from vacuum or the glass into the other; eta: index of refraction there over here.
float dielectricFresnel(float cosine, float eta)
{
    float g2 = eta * eta - 1.0 + cosine * cosine;
    if (g2 <= 0.0) return 1.0; // total reflection
    float g = sqrt(g2), a = (g - cosine) / (g + cosine);
    float b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// Lamps and sky only, so that it needs no denoising; other surfaces seem black in glass.
vec3 shineIn(vec3 origin, vec3 direction)
{
    Hit hit = traceRay(origin, direction, 1e30, kBounce);
    bool isMiss = hit.triangle == kNoHit;
    if (kHasEnvironment && isMiss) return environmentSmooth(direction);
    hit.triangle = isMiss ? 0 : hit.triangle;
    Surface s = fetchSurface(hit, direction, 0.0, 0.0);
    return isMiss ? vec3(0.0) : s.emission;
}

// Past the side of glass that p.surface is, from outside or inside.
void passGlass(inout Primary p, inout vec3 origin)
{
    Surface s = p.surface;
    uvec4 medium = mediumOf(p.hit.triangle);
    bool isSolid = medium.w != 0u;
    vec3 e1 = uintBitsToFloat(texelFetch(gTriangles, 3 * p.hit.triangle + 1).xyz);
    vec3 e2 = uintBitsToFloat(texelFetch(gTriangles, 3 * p.hit.triangle + 2).xyz);
    bool isInside = isSolid && dot(cross(e1, e2), s.geometricNormal) < 0.0;
    float ior = uintBitsToFloat(medium.z), eta = isInside ? 1.0 / ior : ior;
    float fresnel = dielectricFresnel(clamp(dot(s.normal, s.view), 0.0, 1.0), eta);
    fresnel = isSolid ? fresnel : 2.0 * fresnel / (1.0 + fresnel); // a pane's two sides and all between them
    vec3 mirrored = reflect(p.direction, s.normal);
    if (fresnel == 1.0)
    {
        reflectOff(p, origin, vec3(1.0));
        return;
    }
    if (!isInside) p.direct += p.tint * fresnel * shineIn(offsetOrigin(s, mirrored), mirrored);
    vec3 bent = isSolid ? refract(p.direction, s.normal, 1.0 / eta) : p.direction;
    vec3 motion = kHasMotion ? fetchMotion(p.hit) : vec3(0.0);
    p.unfolding = NRD_Unfolding_AddBend(p.unfolding, s.position, p.direction, bent);
    p.unfoldingBefore = NRD_Unfolding_AddBend(p.unfoldingBefore, s.position + motion, p.direction, bent);
    p.tint *= (1.0 - fresnel) * fetchTransmittance(p.hit.triangle, int(s.material), p.hit.barycentrics);
    p.direction = bent;
    origin = offsetOrigin(s, bent);
}

Primary findPrimary(vec3 origin, vec3 direction)
{
    Primary p;
    p.direction = direction;
    p.distance = 0.0;
    p.tint = vec3(1.0);
    p.direct = vec3(0.0);
    p.unfolding = p.unfoldingBefore = NRD_Unfolding_Begin();
    for (uint steps = 0u;; ++steps)
    {
        p.hit = traceRay(origin, p.direction, 1e30, kSight);
        p.tint *= tintUpTo(origin, p.direction, p.hit.t);
        p.isSky = p.hit.triangle == kNoHit;
        p.hit.triangle = p.isSky ? 0 : p.hit.triangle; // the fetches run in any case
        p.distance += p.isSky ? 0.0 : p.hit.t;
        p.width = p.isSky ? 0.0 : g.frustum.z * p.distance;
        p.surface = fetchSurface(p.hit, p.direction, p.width, 0.0);
        if (!p.isSky) p.direct += p.surface.emission * p.tint;
        if (!kHasUnfolding || p.isSky || steps == kMaxSteps) break;
        bool isThrough = isGlass(p.hit.triangle);
        if (!isThrough && !isMirror(p.surface)) break;
        if (isThrough)
            passGlass(p, origin);
        else
            reflectOff(p, origin, mirrorAlbedo(p.surface));
    }
    if (kHasEnvironment && p.isSky) p.direct += environmentSmooth(p.direction) * p.tint;
    return p;
}

vec3 unfoldPosition(Primary p, vec3 position)
{
    return kHasUnfolding ? NRD_Unfolding_GetPosition(p.unfolding, position) : position;
}

vec3 unfoldDirection(Primary p, vec3 direction)
{
    return kHasUnfolding ? NRD_Unfolding_GetDirection(p.unfolding, direction) : direction;
}

// `motion`: previous minus current position of what is at `position`.
vec3 unfoldMotion(Primary p, vec3 position, vec3 motion)
{
    return kHasUnfolding ? NRD_Unfolding_GetMotion(p.unfolding, p.unfoldingBefore, position, motion) : motion;
}
#endif
