// The scene of nrd-bench in closed form: a courtyard of floor and walls with panels, spheres from mirror to chalk, half
// of them metal, boxes, one of them a lamp. Metres, Y up, the camera looks along +Z from a height of 1.6.
#ifndef BENCH_SCENE_GLSL
#define BENCH_SCENE_GLSL
#include "math.glsl"
#include "random.glsl"

const float kNoHit = 1e30;
const float kCameraHeight = 1.6;
const float kWallZ = 12.0;
const float kSideX = 14.0; // beyond the picture's edges
const int kSphereColumns = 10;
const int kSphereRows = 3;
const int kBoxes = 5;
const int kLamp = 2; // of the boxes
const vec3 kSunDirection = vec3(BENCH_SUN_X, BENCH_SUN_Y, BENCH_SUN_Z);
const float kSunSpread = 0.05; // radians
const float kSunIrradiance = 3.0;

struct Hit
{
    float distance; // kNoHit: the sky
    vec3 normal;
    vec3 color; // albedo, or reflectance of a metal
    float roughness;
    bool isMetal;
    vec3 emission;
};

vec3 colorOf(uint seed)
{
    vec3 u = vec3(nextRandom(seed), nextRandom(seed), nextRandom(seed));
    return 0.2 + 0.6 * u;
}

void setPanel(inout Hit hit, vec2 cell, uint surface)
{
    uint seed = seedPixel(ivec2(floor(cell)), surface);
    hit.color = colorOf(seed);
    hit.roughness = nextRandom(seed);
    hit.isMetal = nextRandom(seed) < 0.2;
    hit.emission = vec3(0.0);
}

// The wall ends in gables whose mean leaves `share` of the picture to the sky, so that its edge crosses tiles anyhow.
float wallTop(float x, float share, float tanHalfAngle)
{
    if (share <= 0.0) return kNoHit;
    float gable = abs(2.0 * fract(x * 0.25) - 1.0);
    return kCameraHeight + kWallZ * tanHalfAngle * (1.0 - 4.0 * share * gable);
}

bool isNearer(float distance, Hit hit) { return distance > 1e-4 && distance < hit.distance; }

void hitFloorAndSides(vec3 o, vec3 d, inout Hit hit)
{
    float t = d.y < 0.0 ? -o.y / d.y : kNoHit;
    vec3 p = o + d * t;
    if (isNearer(t, hit) && p.z < kWallZ && abs(p.x) < kSideX)
    {
        hit.distance = t;
        hit.normal = vec3(0.0, 1.0, 0.0);
        setPanel(hit, p.xz, 1u);
    }
    t = d.x != 0.0 ? (sign(d.x) * kSideX - o.x) / d.x : kNoHit;
    p = o + d * t;
    if (isNearer(t, hit) && p.z < kWallZ && p.y >= 0.0 && p.y < 8.0)
    {
        hit.distance = t;
        hit.normal = vec3(-sign(d.x), 0.0, 0.0);
        setPanel(hit, p.yz, 2u);
    }
}

void hitWall(vec3 o, vec3 d, float share, float tanHalfAngle, inout Hit hit)
{
    float t = d.z > 0.0 ? (kWallZ - o.z) / d.z : kNoHit;
    vec3 p = o + d * t;
    if (!isNearer(t, hit) || p.y < 0.0 || p.y > wallTop(p.x, share, tanHalfAngle)) return;
    hit.distance = t;
    hit.normal = vec3(0.0, 0.0, -1.0);
    setPanel(hit, p.xy * 0.7, 3u);
}

void hitSpheres(vec3 o, vec3 d, inout Hit hit)
{
    const float radius = 0.55;
    for (int i = 0; i < kSphereColumns * kSphereRows; i++)
    {
        int column = i % kSphereColumns, row = i / kSphereColumns;
        vec3 center = vec3((float(column) - 4.5) * 1.6, 0.6 + 1.3 * float(row), 6.5 + 1.2 * float(row));
        vec3 m = o - center;
        float b = dot(m, d), discriminant = b * b - dot(m, m) + radius * radius;
        float t = -b - sqrt(max(discriminant, 0.0));
        if (discriminant <= 0.0 || !isNearer(t, hit)) continue;
        hit.distance = t;
        hit.normal = (m + d * t) / radius;
        hit.color = colorOf(uint(i));
        hit.roughness = float(column) / float(kSphereColumns - 1);
        hit.isMetal = (column + row) % 2 == 0;
        hit.emission = vec3(0.0);
    }
}

void hitBoxes(vec3 o, vec3 d, inout Hit hit)
{
    // A ray in the plane of a side must not make 0 / 0.
    vec3 inverse = 1.0 / mix(d, vec3(1e-9), lessThan(abs(d), vec3(1e-9)));
    for (int i = 0; i < kBoxes; i++)
    {
        vec3 halfSize = vec3(0.4, 0.25 + 0.08 * float(i), 0.4);
        vec3 center = vec3(3.0 * float(i) - 6.0, halfSize.y, 4.6);
        vec3 middle = (center - o) * inverse, extent = halfSize * abs(inverse);
        vec3 near = middle - extent, far = middle + extent;
        float t = max(near.x, max(near.y, near.z));
        if (t > min(far.x, min(far.y, far.z)) || !isNearer(t, hit)) continue;
        hit.distance = t;
        hit.normal = -sign(d) * vec3(equal(near, vec3(t)));
        hit.color = colorOf(100u + uint(i));
        hit.roughness = 0.1 + 0.2 * float(i);
        hit.isMetal = i % 2 == 1;
        hit.emission = i == kLamp ? vec3(12.0, 10.0, 8.0) : vec3(0.0);
    }
}

Hit intersect(vec3 o, vec3 d, float share, float tanHalfAngle)
{
    Hit hit = Hit(kNoHit, vec3(0.0), vec3(0.0), 1.0, false, vec3(0.0));
    hitFloorAndSides(o, d, hit);
    hitWall(o, d, share, tanHalfAngle, hit);
    hitSpheres(o, d, hit);
    hitBoxes(o, d, hit);
    return hit;
}

vec3 skyRadiance(vec3 d) { return mix(vec3(0.9, 0.85, 0.8), vec3(0.3, 0.5, 0.9), saturate(d.y)); }
#endif
