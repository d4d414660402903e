// Paths from the primary surface. One loop serves every vertex of every path of a pixel, so that a lane that ends a
// path starts its next one at once instead of waiting for its neighbours.
#ifndef PATH_GLSL
#define PATH_GLSL
#include "bsdf.glsl"
#include "lights.glsl"

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
};

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
    if (!isFinite(radiance)) return vec3(0.0);
    float brightest = max(radiance.r, max(radiance.g, radiance.b));
    return max(radiance, vec3(0.0)) * min(1.0, g.hitDistanceParameters.w / max(brightest, 1e-20));
}

// `factors` are what demodulation divides by; `isSplit` false gives plain paths with both lobes, summed in .diffuse.
PathSums tracePaths(Surface primary, float viewZ, float width, vec3 diffuseFactor, vec3 specularFactor, uint seed,
                    bool isSplit)
{
    PathSums sums = PathSums(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0, vec3(0.0), vec3(0.0));
    float diffuseScale = g.hitDistanceParameters.x + g.hitDistanceParameters.y * abs(viewZ);
    float specularScale = diffuseScale * mix(g.hitDistanceParameters.z, 1.0, lobeSpread(primary.roughness));
    bool hasDiffuse = isSplit && max(primary.albedo.r, max(primary.albedo.g, primary.albedo.b)) > 0.0;
    uint total = g.sampling.z * (hasDiffuse ? 2u : 1u);
    uint item = 0u;

    Surface s = primary;
    Bsdf bsdf = makeBsdf(primary);
    uint lobes = 0u, firstLobes = 0u, bounce = 0u, pathSeed = 0u, index = 0u;
    vec3 throughput = vec3(1.0), radiance = vec3(0.0), firstDirection = vec3(0.0);
    float firstDistance = 0.0, spread = 0.0, rayWidth = width, blur = 0.0;
    bool isNew = true;
    while (item < total)
    {
        if (isNew)
        {
            s = primary;
            bsdf = makeBsdf(primary);
            lobes = !isSplit ? kDiffuseLobe | kSpecularLobe : hasDiffuse && (item & 1u) == 0u ? kDiffuseLobe : kSpecularLobe;
            firstLobes = lobes;
            index = g.sampling.y + (hasDiffuse ? item >> 1 : item);
            pathSeed = hash(seed ^ (lobes * 0x9E3779B9u));
            bounce = 0u;
            throughput = vec3(1.0);
            radiance = vec3(0.0);
            firstDistance = 0.0;
            firstDirection = vec3(0.0);
            rayWidth = width;
            spread = g.frustum.z;
            blur = 0.0;
            isNew = false;
        }
        uint pair = pathSeed + bounce * kPairsPerBounce * 0x632BE5ABu;
        vec2 uLight = sampleSquare(pair, index);
        vec2 uLobe = sampleSquare(pair + 0x632BE5ABu, index);
        vec2 uChoice = sampleSquare(pair + 0xC657CB56u, index);

        // Light that reaches this vertex directly.
        LightSample light = sampleLights(s, uChoice.x, uLight);
        Evaluation toLight = evaluate(s, bsdf, light.direction, lobes);
        vec3 contribution = throughput * toLight.value * light.radiance;
        contribution *= light.pdf > 0.0 ? powerHeuristic(light.pdf, toLight.pdf) : 1.0;
        float reach = max(contribution.r, max(contribution.g, contribution.b)) > 0.0 ? light.distance : 0.0;
        Hit shadow = traceRay(offsetOrigin(s, light.direction), light.direction, reach, true);
        radiance += shadow.triangle == kNoHit ? contribution : vec3(0.0);

        // On along the path.
        bool isSpecular = uChoice.y < lobeShare(bsdf, lobes);
        vec3 direction = isSpecular ? sampleSpecular(s, bsdf, uLobe) : sampleCosine(uLobe, s.normal);
        Evaluation next = evaluate(s, bsdf, direction, lobes);
        bool isAlive = next.pdf > 0.0;
        throughput *= isAlive ? next.value / next.pdf : vec3(0.0);
        spread += isSpecular ? 0.5 * bsdf.alpha : 0.3;
        // Glossy surfaces seen by a rough bounce are made rougher: what they focus is found too seldom to be anything
        // but fireflies (path space regularisation, Kaplanyan and Dachsbacher 2013).
        blur = max(blur, isSpecular ? s.roughness : 1.0);
        if (bounce >= kRouletteBounce)
        {
            float survival = clamp(max(throughput.r, max(throughput.g, throughput.b)), 0.05, 1.0);
            float u = toUnit(hash(hash(pair) ^ index));
            isAlive = isAlive && u < survival;
            throughput /= survival;
        }
        Hit hit = traceRay(offsetOrigin(s, direction), direction, isAlive ? 1e30 : 0.0, false);
        bool isMiss = hit.triangle == kNoHit;
        if (bounce == 0u)
        {
            // A sample that points into its own surface is a contact, not "no sample".
            firstDistance = !isAlive ? 1e-3 : isMiss ? kMiss : clamp(hit.t, 1e-4, 65000.0);
            firstDirection = direction;
        }
        if (kHasEnvironment && isAlive && isMiss)
        {
            vec4 sky = environmentAt(direction);
            float pdf = sky.w * lightProbability(int(g.environment.z));
            radiance += throughput * sky.rgb * powerHeuristic(next.pdf, pdf);
        }
        isAlive = isAlive && !isMiss;
        hit.triangle = isAlive ? hit.triangle : 0;
        rayWidth += spread * hit.t;
        s = fetchSurface(hit, direction, isAlive ? rayWidth : 0.0, blur * g.limits.x);
        bsdf = makeBsdf(s);
        if (kHasTriangleLights && isAlive && s.light != 0u)
        {
            float pdf = lightPdf(s, hit, hit.t);
            radiance += throughput * s.emission * powerHeuristic(next.pdf, pdf);
        }
        ++bounce;
        isAlive = isAlive && bounce < g.environment.w && max(throughput.r, max(throughput.g, throughput.b)) > 1e-5;
        if (!isAlive)
        {
            bool isDiffuse = firstLobes == kDiffuseLobe;
            vec3 demodulated = bounded(!isSplit ? radiance : radiance / (isDiffuse ? diffuseFactor : specularFactor));
            float scale = isDiffuse ? diffuseScale : specularScale;
            float normalized = firstDistance >= kMiss ? 1.0 : clamp(firstDistance / scale, 0.0, 1.0);
            if (isDiffuse || !isSplit)
            {
                sums.diffuse += demodulated;
                sums.diffuseHit += normalized;
                sums.diffuseDistance = firstDistance;
                sums.diffuseDirection = firstDirection;
            }
            else
            {
                sums.specular += demodulated;
                sums.specularHit += normalized;
                sums.specularDistance = firstDistance;
                sums.specularDirection = firstDirection;
            }
            ++item;
            isNew = true;
        }
        lobes = kDiffuseLobe | kSpecularLobe;
    }
    return sums;
}
#endif
