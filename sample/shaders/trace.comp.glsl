// One noisy frame (MODE 0), or more samples added to the sums of its reference (MODE 1), or plain paths (MODE 2), or
// the path of one pixel of each tile, as a frame traces it (MODE 3).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "path.glsl"
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

// A group of 64 is 8 x 8 pixels; eight lanes that run together are 4 x 2 of them.
ivec2 pixelOf(uint group, uint lane, uint width)
{
    uint columns = (width + 7u) / 8u;
    uvec2 tile = uvec2(group % columns, group / columns);
    return ivec2(tile * 8u + uvec2((lane & 3u) | ((lane >> 1) & 4u), ((lane >> 2) & 1u) | ((lane >> 3) & 6u)));
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
    Shadow shadow = Shadow(vec3(1.0), kMiss);
    if (!isSky) shadow = traceShadow(s, sun.rgb, sampleSquare(seed + kShadowPair, g.sampling.y));
    imageStore(gOut_Shadow, pixel, vec4(shadow.transmittance, shadow.distance));
    imageStore(gOut_Sun, pixel, vec4(bounded(sun.rgb) * tint, sun.w));
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
#if MODE == 3
    ivec2 tile = pixelOf(gl_WorkGroupID.x, gl_LocalInvocationIndex, g.tiles.x);
    if (any(greaterThanEqual(uvec2(tile), g.tiles.xy))) return;
    ivec2 pixel = NRD_GetConfidencePixel(tile, int(g.tiles.z), ivec2(g.size.xy));
#else
    ivec2 pixel = pixelOf(gl_WorkGroupID.x, gl_LocalInvocationIndex, g.size.x);
    if (any(greaterThanEqual(uvec2(pixel), g.size.xy))) return;
#endif
    vec3 origin = g.viewToWorld[3].xyz;
    vec3 direction = primaryDirection(pixel);
    Hit hit = traceRay(origin, direction, 1e30);
    vec3 tint = tintUpTo(origin, direction, hit.t);
    bool isSky = hit.triangle == kNoHit;
    hit.triangle = isSky ? 0 : hit.triangle;
    float width = isSky ? 0.0 : g.frustum.z * hit.t;
    Surface s = fetchSurface(hit, direction, width, 0.0);
    float viewZ = isSky ? g.frustum.w : (g.worldToView * vec4(s.position, 1.0)).z;
    Split split = splitOf(s);
    if (MODE != 2) split.choice = chooseLobes(s, makeBsdf(s), pixel, g.sampling.y);
    vec3 direct = isSky ? (kHasEnvironment ? environmentSmooth(direction) : vec3(0.0)) : s.emission;
    uint seed = hash(uint(pixel.y) * g.size.x + uint(pixel.x) + g.sampling.x * 0x9E3779B9u);

    PathSums sums = noPaths();
    if (!isSky) sums = tracePaths(s, viewZ, width, split, seed);
#if MODE == 0
    vec3 motion = kHasMotion && !isSky ? fetchMotion(hit) : vec3(0.0);
    vec3 toSurface = isSky ? vec3(0.0) : vec3(1.0);
    imageStore(gOut_ViewZ, pixel, vec4(viewZ));
    imageStore(gOut_NormalRoughness, pixel, isSky ? vec4(-direction, 1.0) : vec4(s.normal, s.roughness));
    imageStore(gOut_Motion, pixel, vec4(motion, isSky ? 0.0 : float(s.material & 255u)));
    imageStore(gOut_Diffuse, pixel, vec4(sums.diffuse, sums.diffuseDistance));
    imageStore(gOut_Specular, pixel, vec4(sums.specular, sums.specularDistance));
    imageStore(gOut_DiffuseDirection, pixel, vec4(sums.diffuseDirection, 0.0));
    imageStore(gOut_SpecularDirection, pixel, vec4(sums.specularDirection, 0.0));
    imageStore(gOut_DiffuseFactor, pixel, vec4(split.diffuseFactor * tint * toSurface, 0.0));
    imageStore(gOut_SpecularFactor, pixel, vec4(split.specularFactor * tint * toSurface, 0.0));
    imageStore(gOut_Direct, pixel, vec4(direct * tint, 0.0));
    imageStore(gOut_DiffuseOrigin, pixel, vec4(sums.diffuseOrigin, 0.0));
    imageStore(gOut_SpecularOrigin, pixel, vec4(sums.specularOrigin, 0.0));
    imageStore(gOut_SpecularMotion, pixel, vec4(sums.specularMotion, sums.specularDistance > 0.0 ? 1.0 : 0.0));
    if (kHasShadowLight) storeShadow(pixel, s, isSky, tint, seed);
#elif MODE == 3
    imageStore(gOut_RetracedSample, tile, NRD_FrontEnd_PackConfidenceSample(sums.diffuse, sums.specular, viewZ));
#else
    if (MODE == 2) sums.diffuse *= tint;
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
    if (kHasShadowLight) addShadows(pixel, s, isSky, seed);
#endif
}
