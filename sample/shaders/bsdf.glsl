// Two lobes: GGX with Smith's height-correlated shadowing, compensated for multiple scattering (Turquin 2019), and a
// Lambertian one that gets the rest of the energy. Their albedos sum to 1 for a white surface.
#ifndef BSDF_GLSL
#define BSDF_GLSL
#include "nrd_frontend.glsl"
#include "sampling.glsl"
#include "surface.glsl"

const uint kDiffuseLobe = 1u;
const uint kSpecularLobe = 2u;

struct Bsdf
{
    vec3 diffuse;  // albedo / pi, energy of the specular lobe taken off
    vec3 scale;    // multiple-scattering compensation of the specular lobe
    float alpha;   // roughness squared
    float nov;     // > 0
    float boundK;  // of the bounded distribution of visible normals
    float boundT;
    float specularShare; // probability of sampling the specular lobe when both are open
};

// Directional albedo of the specular lobe is f0 * y + x: (x, y) from the table, bilinear.
vec2 energyOf(float nov, float roughness)
{
    vec2 at = clamp(vec2(nov, roughness) * 31.0, vec2(0.0), vec2(30.9999));
    ivec2 i = ivec2(at);
    vec2 f = at - vec2(i);
    int base = i.y * 32 + i.x;
    vec2 top = mix(texelFetch(gEnergy, base).xy, texelFetch(gEnergy, base + 1).xy, f.x);
    vec2 bottom = mix(texelFetch(gEnergy, base + 32).xy, texelFetch(gEnergy, base + 33).xy, f.x);
    return mix(top, bottom, f.y);
}

// Compensation of the specular lobe for light that is scattered more than once.
vec3 multipleScattering(Surface s, vec2 energy)
{
    return 1.0 + s.f0 * (1.0 / max(energy.x + energy.y, 1e-3) - 1.0);
}

// Share of the light that the specular lobe reflects.
vec3 specularAlbedo(Surface s, vec2 energy)
{
    return clamp((s.f0 * energy.y + energy.x) * multipleScattering(s, energy), 0.0, 1.0);
}

Bsdf makeBsdf(Surface s)
{
    Bsdf b;
    b.nov = clamp(dot(s.normal, s.view), 1e-3, 1.0);
    b.alpha = s.roughness * s.roughness;
    vec2 energy = energyOf(b.nov, s.roughness);
    b.scale = multipleScattering(s, energy);
    vec3 specular = specularAlbedo(s, energy);
    b.diffuse = s.albedo * (1.0 - specular) / kPi;
    float a2 = b.alpha * b.alpha;
    float sine2 = max(1.0 - b.nov * b.nov, 0.0);
    float c = 1.0 + sqrt(sine2);
    b.boundK = (1.0 - a2) * c * c / (c * c + a2 * b.nov * b.nov);
    b.boundT = sqrt(a2 * sine2 + b.nov * b.nov);
    float d = luminance(b.diffuse) * kPi, e = luminance(specular);
    b.specularShare = d < 1e-4 ? 1.0 : clamp(e / (d + e), 0.1, 0.9); // never below 0.05: fireflies
    return b;
}

// Bounded sampling of visible normals for spherical caps (Eto and Tokuyoshi 2023); returns the reflected direction.
vec3 sampleSpecular(Surface s, Bsdf b, vec2 u)
{
    vec3 t, bt;
    makeFrame(s.normal, t, bt);
    vec3 v = vec3(dot(t, s.view), dot(bt, s.view), b.nov);
    v = normalize(v);
    vec3 stretched = normalize(vec3(v.xy * b.alpha, v.z));
    float phi = 2.0 * kPi * u.x;
    float low = b.boundK * stretched.z;
    float z = (1.0 - u.y) * (1.0 + low) - low;
    float r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = stretched + vec3(r * cos(phi), r * sin(phi), z);
    h = normalize(vec3(h.xy * b.alpha, max(h.z, 1e-7)));
    vec3 l = 2.0 * dot(v, h) * h - v;
    return normalize(t * l.x + bt * l.y + s.normal * l.z);
}

struct Evaluation
{
    vec3 value; // both open lobes times the cosine
    float pdf;  // of sampling one of them by lobeShare(), per solid angle
};

Evaluation evaluate(Surface s, Bsdf b, vec3 l, uint lobes)
{
    float nol = dot(s.normal, l);
    if (nol <= 0.0 || dot(s.geometricNormal, l) <= 0.0) return Evaluation(vec3(0.0), 0.0);
    float a2 = b.alpha * b.alpha;
    vec3 h = normalize(s.view + l);
    float noh = clamp(dot(s.normal, h), 0.0, 1.0), voh = clamp(dot(s.view, h), 0.0, 1.0);
    float k = (noh * a2 - noh) * noh + 1.0;
    float distribution = a2 / (kPi * k * k);
    float visibility = 0.5 / (nol * sqrt(b.nov * b.nov * (1.0 - a2) + a2) + b.nov * sqrt(nol * nol * (1.0 - a2) + a2));
    float m = 1.0 - voh;
    vec3 fresnel = s.f0 + (1.0 - s.f0) * (m * m * m * m * m);
    float specularPdf = distribution / (2.0 * (b.boundK * b.nov + b.boundT));
    float diffusePdf = nol / kPi;
    vec3 specular = fresnel * b.scale * (distribution * visibility * nol);
    vec3 diffuse = b.diffuse * nol;
    if (lobes == kDiffuseLobe) return Evaluation(diffuse, diffusePdf);
    if (lobes == kSpecularLobe) return Evaluation(specular, specularPdf);
    return Evaluation(diffuse + specular, mix(diffusePdf, specularPdf, b.specularShare));
}

// Probability of sampling the specular lobe.
float lobeShare(Bsdf b, uint lobes)
{
    return lobes == kDiffuseLobe ? 0.0 : lobes == kSpecularLobe ? 1.0 : b.specularShare;
}

// The 0.02 bounds the division for black surfaces.
void demodulationFactors(Surface s, out vec3 diffuseFactor, out vec3 specularFactor)
{
    vec3 specular = NRD_EnvironmentTerm(s.f0, clamp(dot(s.normal, s.view), 0.0, 1.0), s.roughness);
    diffuseFactor = 0.02 + 0.98 * (1.0 - specular) * s.albedo;
    specularFactor = 0.02 + 0.98 * specular * (0.1 + 0.9 * s.roughness);
}
#endif
