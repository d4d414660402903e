// Paths from the primary surface. One loop serves every vertex of every path of a pixel, so that a lane that ends a
// path starts its next one at once instead of waiting for its neighbours.
#ifndef PATH_GLSL
#define PATH_GLSL
#include "lights.glsl"
#include "lobe_choice.glsl"

const uint kPairsPerBounce = 3u;
const uint kRouletteBounce = 2u; // the first two bounces always live

struct PathSums
{
    vec3 diffuse;           // demodulated radiance, summed over samples
    vec3 specular;
    float diffuseHit;       // sum of normalised hit distances
    float specularHit;
    float diffuseDistance;  // of the last sample: world units, kMiss for a miss, 0 for no sample
    float specularDistance;
    vec3 diffuseDirection;  // of the last sample
    vec3 specularDirection;
    vec3 specularMotion;    // of what the last sample hit: previous position minus now
    vec3 diffuseOrigin;     // where the radiance of the last sample comes from
    vec3 specularOrigin;
};

PathSums noPaths()
{
    return PathSums(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0),
                    vec3(0.0));
}

float powerHeuristic(float a, float b)
{
    float a2 = a * a, b2 = b * b;
    return b2 > 1e30 ? 0.0 : a2 > 1e30 ? 1.0 : a2 / max(a2 + b2, 1e-30);
}

float lobeSpread(float r)
{
    return (1.0 - exp2(-200.0 * r * r)) * sqrt(r);
}

// A non-finite path is dropped, a very bright one dimmed: the only bias, documented with the --help of the program.
vec3 bounded(vec3 radiance)
{
    if (!NRD_IsRadianceFinite(radiance)) return vec3(0.0);
    return max(radiance, vec3(0.0)) * min(1.0, g.hitDistanceParameters.w / max(brightest(radiance), 1e-20));
}

// A path on its way.
struct Path
{
    Surface surface; // where it stands
    Bsdf bsdf;
    uint lobes;      // that may be sampled here
    uint firstLobes; // that were at the primary surface
    uint bounce;
    uint seed;
    uint index; // of the sample in its sequence
    vec3 throughput;
    vec3 radiance;
    vec3 firstDirection;
    vec3 firstLight; // direction to the light sampled at the primary surface, times the luminance that came from it
    float firstDistance;
    vec3 firstMotion; // of the first hit
    float spread; // radians the ray widens by
    float width;  // of the ray, world units
    float blur;   // largest roughness on the way, 1 for a diffuse bounce
};

Path startPath(Surface primary, Bsdf bsdf, uint lobes, uint index, uint seed, float width)
{
    return Path(primary, bsdf, lobes, lobes, 0u, hash(seed ^ (lobes * 0x9E3779B9u)), index, vec3(1.0), vec3(0.0),
                vec3(0.0), vec3(0.0), 0.0, vec3(0.0), g.frustum.z, width, 0.0);
}

// Light that reaches this vertex directly.
void addLight(inout Path path, float choice, vec2 u)
{
    LightSample light = sampleLights(path.surface, choice, u, path.bounce == 0u);
    Evaluation toLight = evaluate(path.surface, path.bsdf, light.direction, path.lobes);
    vec3 contribution = path.throughput * toLight.value * light.radiance;
    contribution *= light.pdf > 0.0 ? powerHeuristic(light.pdf, toLight.pdf) : 1.0;
    float reach = brightest(contribution) > 0.0 ? light.distance : 0.0;
    vec3 origin = offsetOrigin(path.surface, light.direction);
    contribution *= tracePassage(origin, light.direction, reach, true).transmittance;
    path.radiance += contribution;
    if (path.bounce == 0u) path.firstLight = light.direction * luminance(contribution);
}

// False: the path ends here. `u` picks the direction, `choice` the lobe, `chance` plays roulette.
bool sampleDirection(inout Path path, vec2 u, float choice, float chance, out vec3 direction, out float pdf)
{
    bool isSpecular = choice < lobeShare(path.bsdf, path.lobes);
    direction = isSpecular ? sampleSpecular(path.surface, path.bsdf, u) : sampleCosine(u, path.surface.normal);
    Evaluation next = evaluate(path.surface, path.bsdf, direction, path.lobes);
    pdf = next.pdf;
    path.throughput *= pdf > 0.0 ? next.value / pdf : vec3(0.0);
    path.spread += isSpecular ? 0.5 * path.bsdf.alpha : 0.3;
    // Glossy surfaces seen by a rough bounce are made rougher: what they focus is found too seldom to be anything but
    // fireflies (path space regularisation, Kaplanyan and Dachsbacher 2013).
    path.blur = max(path.blur, isSpecular ? path.surface.roughness : 1.0);
    if (path.bounce < kRouletteBounce) return pdf > 0.0;
    float survival = clamp(brightest(path.throughput), 0.05, 1.0);
    path.throughput /= survival;
    return pdf > 0.0 && chance < survival;
}

// Follows the sampled direction to the next surface and collects what shines there. False: there is no next vertex.
bool advance(inout Path path, vec3 direction, float pdf, bool isAlive)
{
    vec3 origin = offsetOrigin(path.surface, direction);
    Hit hit = traceRay(origin, direction, isAlive ? 1e30 : 0.0, kBounce);
    bool isMiss = hit.triangle == kNoHit, isPrimary = path.bounce == 0u;
    path.throughput *= tintUpTo(origin, direction, hit.t);
    if (isPrimary)
    {
        // A sample that points into its own surface is a contact, not "no sample".
        path.firstDistance = !isAlive ? 1e-3 : isMiss ? kMiss : clamp(hit.t, 1e-4, 65000.0);
        path.firstDirection = direction;
        if (kHasMotion && isAlive && !isMiss) path.firstMotion = fetchMotion(hit);
    }
    if (kHasEnvironment && isAlive && isMiss)
    {
        vec4 sky = environmentAt(direction);
        float skyPdf = sky.w * lightProbability(int(g.environment.z), isPrimary);
        path.radiance += path.throughput * sky.rgb * powerHeuristic(pdf, skyPdf);
    }
    isAlive = isAlive && !isMiss;
    hit.triangle = isAlive ? hit.triangle : 0; // the fetches below run in any case
    path.width += isAlive ? path.spread * hit.t : 0.0;
    path.surface = fetchSurface(hit, direction, path.width, path.blur * g.limits.x);
    path.bsdf = makeBsdf(path.surface);
    if (kHasTriangleLights && isAlive && path.surface.light != 0u)
    {
        float weight = powerHeuristic(pdf, lightPdf(path.surface, hit, hit.t, isPrimary));
        path.radiance += path.throughput * path.surface.emission * weight;
    }
    ++path.bounce;
    path.lobes = kDiffuseLobe | kSpecularLobe;
    return isAlive && path.bounce < g.environment.w && brightest(path.throughput) > 1e-5;
}

// How the light of the primary surface is split into signals.
struct Split
{
    LobeChoice choice;
    bool isTogether;    // both lobes by one path, into .diffuse
    vec3 diffuseFactor; // what demodulation divides by
    vec3 specularFactor;
};

// The lobes of the `item`-th path of a pixel: two that are split take turns.
uint lobesOf(uint item, Split split)
{
    bool hasTurns = !split.isTogether && bitCount(split.choice.lobes) == 2;
    if (!hasTurns) return split.choice.lobes;
    return (item & 1u) == 0u ? kDiffuseLobe : kSpecularLobe;
}

// Mean of the directions from which a path's radiance reaches the primary surface: the sampled light's and the
// bounce's.
// Shorter than 1 where they differ.
vec3 originOf(Path path)
{
    float all = luminance(path.radiance), light = length(path.firstLight);
    return all > 0.0 ? (path.firstLight + path.firstDirection * max(all - light, 0.0)) / max(all, light)
                     : path.firstDirection;
}

void finishPath(inout PathSums sums, Path path, Split split, vec2 hitDistanceScales)
{
    bool isSpecular = path.firstLobes == kSpecularLobe;
    vec3 factor = isSpecular ? split.specularFactor : split.diffuseFactor;
    vec3 demodulated = bounded(path.radiance / factor) * split.choice.scale;
    float scale = isSpecular ? hitDistanceScales.y : hitDistanceScales.x;
    float normalized = path.firstDistance >= kMiss ? 1.0 : clamp(path.firstDistance / scale, 0.0, 1.0);
    if (isSpecular)
    {
        sums.specular += demodulated;
        sums.specularHit += normalized;
        sums.specularDistance = path.firstDistance;
        sums.specularDirection = path.firstDirection;
        sums.specularOrigin = originOf(path);
        sums.specularMotion = path.firstMotion;
        return;
    }
    sums.diffuse += demodulated;
    sums.diffuseHit += normalized;
    sums.diffuseDistance = path.firstDistance;
    sums.diffuseDirection = path.firstDirection;
    sums.diffuseOrigin = originOf(path);
}

PathSums tracePaths(Surface primary, float viewZ, float width, Split split, uint seed)
{
    PathSums sums = noPaths();
    vec2 scales = vec2(g.hitDistanceParameters.x + g.hitDistanceParameters.y * abs(viewZ));
    scales.y *= mix(g.hitDistanceParameters.z, 1.0, lobeSpread(primary.roughness));
    Bsdf bsdf = makeBsdf(primary);
    uint perSample = split.isTogether ? 1u : uint(bitCount(split.choice.lobes));
    uint total = g.sampling.z * perSample;
    uint item = 0u;
    bool isNew = true;
    Path path = startPath(primary, bsdf, 0u, 0u, seed, width);
    while (item < total)
    {
        uint index = g.sampling.y + (perSample == 2u ? item >> 1 : item);
        if (isNew) path = startPath(primary, bsdf, lobesOf(item, split), index, seed, width);
        uint pair = path.seed + path.bounce * kPairsPerBounce * 0x632BE5ABu;
        vec2 choices = sampleSquare(pair + 0xC657CB56u, index);
        addLight(path, choices.x, sampleSquare(pair, index));
        vec3 direction;
        float pdf;
        float chance = toUnit(hash(hash(pair) ^ index));
        vec2 u = sampleSquare(pair + 0x632BE5ABu, index);
        bool isAlive = sampleDirection(path, u, choices.y, chance, direction, pdf);
        isNew = !advance(path, direction, pdf, isAlive);
        if (!isNew) continue;
        finishPath(sums, path, split, scales);
        ++item;
    }
    return sums;
}
#endif
