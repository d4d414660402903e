// One input image of a frame of nrd-bench: traces the pixel's path through the closed-form scene and writes one of the
// things BENCH_... names. The path depends on pixel and seed only, so the images of a frame belong together.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bench_constants.h"
#include "bench_scene.glsl"
#include "nrd_frontend.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform writeonly image2D gOut_Input;
layout(push_constant) uniform Constants { BenchConstants g; };

struct LobeSample
{
    vec3 radiance; // demodulated
    float hitDist; // 0: the lobe has no sample
    vec3 direction;
};

Hit trace(vec3 o, vec3 d) { return intersect(o, d, g.sky.x, g.view.y); }

void makeFrame(vec3 n, out vec3 t, out vec3 b)
{
    t = normalize(abs(n.x) > 0.7 ? cross(n, vec3(0.0, 1.0, 0.0)) : cross(n, vec3(1.0, 0.0, 0.0)));
    b = cross(n, t);
}

vec3 sampleCosine(vec2 u, vec3 n)
{
    vec3 t, b;
    makeFrame(n, t, b);
    float r = sqrt(u.x), phi = 2.0 * kPi * u.y;
    return normalize(t * (r * cos(phi)) + b * (r * sin(phi)) + n * sqrt(1.0 - u.x));
}

// Bounded sampling of visible normals for spherical caps (Eto and Tokuyoshi 2023); returns the reflected direction,
// which seldom lies below the surface.
vec3 sampleGgx(vec2 u, vec3 n, vec3 view, float roughness)
{
    vec3 t, b;
    makeFrame(n, t, b);
    float alpha = max(roughness * roughness, 1e-4), a2 = alpha * alpha;
    vec3 v = normalize(vec3(dot(t, view), dot(b, view), max(dot(n, view), 1e-4)));
    vec3 stretched = normalize(vec3(v.xy * alpha, v.z));
    float c = 1.0 + length(v.xy);
    float low = stretched.z * (1.0 - a2) * c * c / (c * c + a2 * v.z * v.z);
    float phi = 2.0 * kPi * u.x, z = (1.0 - u.y) * (1.0 + low) - low;
    float r = sqrt(max(1.0 - z * z, 0.0));
    vec3 h = stretched + vec3(r * cos(phi), r * sin(phi), z);
    h = normalize(vec3(h.xy * alpha, max(h.z, 1e-7)));
    return reflect(-view, normalize(t * h.x + b * h.y + n * h.z));
}

vec3 sampleSun(inout uint seed)
{
    float u = nextRandom(seed), phi = 2.0 * kPi * nextRandom(seed);
    vec3 t, b;
    makeFrame(kSunDirection, t, b);
    return normalize(kSunDirection + (t * cos(phi) + b * sin(phi)) * (kSunSpread * sqrt(u)));
}

// Radiance of sunlight that a white diffuse surface reflects, one shadow ray.
float sunlight(vec3 p, vec3 n, inout uint seed)
{
    vec3 d = sampleSun(seed);
    float cosine = dot(n, d);
    if (cosine <= 0.0 || trace(p, d).distance < kNoHit) return 0.0;
    return kSunIrradiance * cosine / kPi;
}

// What arrives at p from d: the sky, or a surface in the sun and in the light of its surroundings.
LobeSample bounce(vec3 p, vec3 d, inout uint seed)
{
    Hit hit = trace(p, d);
    if (hit.distance == kNoHit) return LobeSample(skyRadiance(d), NRD_FP16_MAX, d);
    float light = sunlight(p + d * hit.distance + hit.normal * 1e-3, hit.normal, seed) + 0.25;
    return LobeSample(hit.emission + hit.color * light, hit.distance, d);
}

LobeSample sampleLobe(Hit hit, vec3 p, vec3 view, uint seed)
{
    bool isSpecular = g.target.y != 0u;
    seed = hashPcg(seed + g.target.y);
    vec2 u = vec2(nextRandom(seed), nextRandom(seed));
    LobeSample none = LobeSample(vec3(0.0), 0.0, vec3(0.0));
    if (isSpecular)
    {
        vec3 d = sampleGgx(u, hit.normal, view, hit.roughness);
        if (dot(d, hit.normal) <= 0.0) return none;
        return bounce(p, d, seed);
    }
    if (hit.isMetal) return none;
    LobeSample lobe = bounce(p, sampleCosine(u, hit.normal), seed);
    lobe.radiance += sunlight(p, hit.normal, seed);
    return lobe;
}

vec4 packLobe(LobeSample lobe, float viewZ, float roughness)
{
    if (g.target.x == BENCH_RELAX) return RELAX_FrontEnd_PackRadianceAndHitDist(lobe.radiance, lobe.hitDist, true);
    float lobeRoughness = g.target.y != 0u ? roughness : 1.0;
    float normHitDist =
        REBLUR_FrontEnd_GetNormHitDist(lobe.hitDist, viewZ, g.hitDistanceParameters.xyz, lobeRoughness);
    vec4 radiance = REBLUR_FrontEnd_PackRadianceAndNormHitDist(lobe.radiance, normHitDist, true);
    if (g.target.x == BENCH_HITDIST) return vec4(normHitDist);
    if (g.target.x == BENCH_DIRECTION) return vec4(lobe.direction * normHitDist, normHitDist);
    if (g.target.x == BENCH_SH1) return vec4(lobe.direction * radiance.x, 0.0);
    return g.target.x == BENCH_SIGNAL ? vec4(lobe.radiance, 1.0) : radiance;
}

vec4 packShadow(vec3 p, vec3 n, uint seed)
{
    Hit hit = trace(p, sampleSun(seed));
    float distance = dot(n, kSunDirection) <= 0.0 ? 0.0 : hit.distance < kNoHit ? hit.distance : NRD_FP16_MAX;
    if (g.target.x == BENCH_PENUMBRA) return vec4(SIGMA_FrontEnd_PackPenumbra(distance, tan(kSunSpread)));
    return SIGMA_FrontEnd_PackTranslucency(distance, hit.isMetal ? hit.color : vec3(0.0));
}

vec4 packPixel(Hit hit, vec3 o, vec3 d, uint seed)
{
    float c = cos(g.camera.w), s = sin(g.camera.w);
    bool isSky = hit.distance == kNoHit;
    float viewZ = isSky ? g.sky.y : hit.distance * dot(d, vec3(s, 0.0, c));
    if (g.target.x == BENCH_VIEWZ) return vec4(viewZ);
    if (g.target.x == BENCH_MOTION || isSky) return vec4(0.0); // nothing in the scene moves
    if (g.target.x == BENCH_NORMAL_ROUGHNESS)
        return NRD_FrontEnd_PackNormalAndRoughness(hit.normal, hit.roughness, hit.isMetal ? 1.0 : 0.0);
    if (g.target.x >= BENCH_PENUMBRA) return packShadow(o + d * hit.distance + hit.normal * 1e-3, hit.normal, seed);
    LobeSample lobe = sampleLobe(hit, o + d * hit.distance + hit.normal * 1e-3, -d, seed);
    return packLobe(lobe, viewZ, hit.roughness);
}

void main()
{
    uvec2 id = gl_GlobalInvocationID.xy;
    uvec2 pixel = id * g.target.z;
    if (any(greaterThanEqual(pixel, g.frame.xy))) return;
    vec2 uv = (vec2(pixel) + 0.5 + g.view.zw) / vec2(g.frame.xy);
    vec3 v = vec3((2.0 * uv.x - 1.0) * g.view.x, (1.0 - 2.0 * uv.y) * g.view.y, 1.0);
    float c = cos(g.camera.w), s = sin(g.camera.w);
    vec3 d = normalize(vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x));
    Hit hit = trace(g.camera.xyz, d);
    imageStore(gOut_Input, ivec2(id), packPixel(hit, g.camera.xyz, d, seedPixel(ivec2(pixel), g.frame.z)));
}
