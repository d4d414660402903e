// One noisy frame (MODE 0), or more samples added to the sums of its reference (MODE 1), or plain paths (MODE 2), or
// the path of one pixel of each tile, as a frame traces it (MODE 3).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "path.glsl"
#include "primary.glsl"
#include "shadow_light.glsl"

layout(local_size_x = 64) in;

#if MODE == 0
layout(set = 0, binding = 10) uniform writeonly image2D gOut_ViewZ;
layout(set = 0, binding = 11) uniform writeonly image2D gOut_NormalRoughness;
layout(set = 0, binding = 12) uniform writeonly image2D gOut_Motion; // .w: material
layout(set = 0, binding = 13) uniform writeonly image2D gOut_Diffuse; // .w: hit distance
layout(set = 0, binding = 14) uniform writeonly image2D gOut_Specular;
layout(set = 0, binding = 15) uniform writeonly image2D gOut_DiffuseDirection;
layout(set = 0, binding = 16) uniform writeonly image2D gOut_SpecularDirection;
layout(set = 0, binding = 17) uniform writeonly image2D gOut_DiffuseFactor;
layout(set = 0, binding = 18) uniform writeonly image2D gOut_SpecularFactor;
layout(set = 0, binding = 19) uniform writeonly image2D gOut_Direct;
layout(set = 0, binding = 20) uniform writeonly image2D gOut_DiffuseOrigin;
layout(set = 0, binding = 21) uniform writeonly image2D gOut_SpecularOrigin;
layout(set = 0, binding = 22) uniform writeonly image2D gOut_SpecularMotion; // .w: 0 without a sample
layout(set = 0, binding = 23) uniform writeonly image2D gOut_Shadow;         // translucency, .w: distance
layout(set = 0, binding = 24) uniform writeonly image2D gOut_Sun;
#elif MODE == 3
layout(set = 0, binding = 10) uniform writeonly image2D gOut_RetracedSample;
#else
layout(set = 0, binding = 10, rgba32f) uniform image2D gSum_Diffuse; // .w: normalised hit distance
layout(set = 0, binding = 11, rgba32f) uniform image2D gSum_Specular;
#endif
#if MODE == 1
layout(set = 0, binding = 12, rgba32f) uniform image2D gSum_Shadow; // translucency, .w: rays that crossed nothing
#endif

// A group of 64 is 8 x 8 tiles; eight lanes that run together are 4 x 2 of them.
ivec2 tileOf(uint group, uint lane)
{
    uint columns = (g.tiles.x + 7u) / 8u;
    uvec2 block = uvec2(group % columns, group / columns);
    return ivec2(block * 8u + uvec2((lane & 3u) | ((lane >> 1) & 4u), ((lane >> 2) & 1u) | ((lane >> 3) & 6u)));
}

// The pixels that have paths are in groups of their own, so that no lane waits for a neighbour's.
bool hasPaths() { return gl_WorkGroupID.y == 0u; }

ivec2 pixelOf(ivec2 tile)
{
#if MODE == 3
    ivec2 pixel = NRD_GetConfidencePixel(tile, int(g.tiles.z), ivec2(g.size.xy));
    return pixel - pixel % int(g.tiles.w); // one that had paths
#else
    return tile * int(g.tiles.z) + ivec2(gl_WorkGroupID.y % g.tiles.z, gl_WorkGroupID.y / g.tiles.z);
#endif
}

vec3 primaryDirection(ivec2 pixel)
{
    vec2 uv = (vec2(pixel) + 0.5 + g.jitter.xy) / vec2(g.size.xy);
    vec3 view = vec3((2.0 * uv.x - 1.0) * g.frustum.x, (1.0 - 2.0 * uv.y) * g.frustum.y, -1.0);
    return normalize(mat3(g.viewToWorld) * view);
}

#if MODE == 0
// The light's shadow and what it gives without; the sky is lit, by nothing.
void storeShadow(ivec2 pixel, Surface s, bool isSky, vec3 tint, uint seed)
{
    vec4 sun = isSky ? vec4(0.0) : unshadowedRadiance(s, makeBsdf(s));
    Shadow shadow = hasPaths() ? Shadow(vec3(1.0), kMiss) : Shadow(vec3(0.0), 0.0);
    if (hasPaths() && !isSky) shadow = traceShadow(s, sun.rgb, sampleSquare(seed + kShadowPair, g.sampling.y));
    imageStore(gOut_Shadow, pixel, vec4(shadow.transmittance, shadow.distance));
    imageStore(gOut_Sun, pixel, vec4(bounded(sun.rgb) * tint, sun.w));
}

// Of the unfolded surface.
void storeGuides(ivec2 pixel, Primary p, float viewZ)
{
    Surface s = p.surface;
    vec3 motion = kHasMotion && !p.isSky ? fetchMotion(p.hit) : vec3(0.0);
    motion = p.isSky ? motion : unfoldMotion(p, s.position, motion);
    vec3 normal = unfoldDirection(p, p.isSky ? -p.direction : s.normal);
    imageStore(gOut_ViewZ, pixel, vec4(viewZ));
    imageStore(gOut_NormalRoughness, pixel, vec4(normal, p.isSky ? 1.0 : s.roughness));
    imageStore(gOut_Motion, pixel, vec4(motion, p.isSky ? 0.0 : float(s.material & 255u)));
}

// Directions and motion are unfolded too: what lights the surface moves with it.
void storeSignals(ivec2 pixel, Primary p, Split split, PathSums sums)
{
    vec3 tint = p.isSky ? vec3(0.0) : p.tint;
    bool hasSpecular = sums.specularDistance > 0.0;
    vec3 reflected = p.surface.position + sums.specularDirection * min(sums.specularDistance, kMiss);
    vec3 specularMotion = hasSpecular ? unfoldMotion(p, reflected, sums.specularMotion) : vec3(0.0);
    imageStore(gOut_Diffuse, pixel, vec4(sums.diffuse, sums.diffuseDistance));
    imageStore(gOut_Specular, pixel, vec4(sums.specular, sums.specularDistance));
    imageStore(gOut_DiffuseDirection, pixel, vec4(unfoldDirection(p, sums.diffuseDirection), 0.0));
    imageStore(gOut_SpecularDirection, pixel, vec4(unfoldDirection(p, sums.specularDirection), 0.0));
    imageStore(gOut_DiffuseFactor, pixel, vec4(split.diffuseFactor * tint, 0.0));
    imageStore(gOut_SpecularFactor, pixel, vec4(split.specularFactor * tint, 0.0));
    imageStore(gOut_Direct, pixel, vec4(p.direct, 0.0));
    imageStore(gOut_DiffuseOrigin, pixel, vec4(unfoldDirection(p, sums.diffuseOrigin), 0.0));
    imageStore(gOut_SpecularOrigin, pixel, vec4(unfoldDirection(p, sums.specularOrigin), 0.0));
    imageStore(gOut_SpecularMotion, pixel, vec4(specularMotion, hasSpecular ? 1.0 : 0.0));
}
#elif MODE == 1
void addShadows(ivec2 pixel, Surface s, bool isSky, uint seed)
{
    vec3 sun = isSky ? vec3(0.0) : unshadowedRadiance(s, makeBsdf(s)).rgb;
    vec4 sum = isSky ? vec4(g.sampling.z) : vec4(0.0);
    for (uint i = 0u; i < g.sampling.z && !isSky; ++i)
    {
        Shadow shadow = traceShadow(s, sun, sampleSquare(seed + kShadowPair, g.sampling.y + i));
        sum += vec4(shadow.transmittance, shadow.distance == kMiss ? 1.0 : 0.0);
    }
    if (g.sampling.w == 0u) sum += imageLoad(gSum_Shadow, pixel);
    imageStore(gSum_Shadow, pixel, sum);
}
#endif

// Plain paths and merged ones carry both lobes; plain ones aren't demodulated.
Split splitOf(Surface s)
{
    Split split = Split(LobeChoice(kDiffuseLobe | kSpecularLobe, 1.0), MODE == 2 || kIsMerged, vec3(1.0), vec3(1.0));
    if (MODE == 2) return split;
    demodulationFactors(s, split.diffuseFactor, split.specularFactor);
    if (kIsMerged) split.diffuseFactor += split.specularFactor;
    if (kIsMerged) split.specularFactor = vec3(0.0);
    return split;
}

void main()
{
    ivec2 tile = tileOf(gl_WorkGroupID.x, gl_LocalInvocationIndex), pixel = pixelOf(tile);
    if (any(greaterThanEqual(uvec2(tile), g.tiles.xy)) || any(greaterThanEqual(uvec2(pixel), g.size.xy))) return;
    Primary p = findPrimary(g.viewToWorld[3].xyz, primaryDirection(pixel));
    Surface s = p.surface;
    float viewZ = p.isSky ? g.frustum.w : (g.worldToView * vec4(unfoldPosition(p, s.position), 1.0)).z;
    Split split = splitOf(s);
    if (MODE != 2) split.choice = chooseLobes(s, makeBsdf(s), pixel, g.sampling.y);
    uint seed = hash(uint(pixel.y) * g.size.x + uint(pixel.x) + g.sampling.x * 0x9E3779B9u);

    PathSums sums = noPaths();
    if (!p.isSky && hasPaths()) sums = tracePaths(s, viewZ, p.width, split, seed);
#if MODE == 0
    storeGuides(pixel, p, viewZ);
    storeSignals(pixel, p, split, sums);
    if (kHasShadowLight) storeShadow(pixel, s, p.isSky, p.tint, seed);
#elif MODE == 3
    imageStore(gOut_RetracedSample, tile, NRD_FrontEnd_PackConfidenceSample(sums.diffuse, sums.specular, viewZ));
#else
    if (MODE == 2) sums.diffuse *= p.tint;
    vec4 diffuse = vec4(sums.diffuse, sums.diffuseHit), specular = vec4(sums.specular, sums.specularHit);
    if (g.sampling.w == 0u)
    {
        diffuse += imageLoad(gSum_Diffuse, pixel);
        specular += imageLoad(gSum_Specular, pixel);
    }
    imageStore(gSum_Diffuse, pixel, diffuse);
    imageStore(gSum_Specular, pixel, specular);
#endif
#if MODE == 1
    if (kHasShadowLight) addShadows(pixel, s, p.isSky, seed);
#endif
}
