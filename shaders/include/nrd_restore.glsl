// Part of nrd_frontend.glsl: include that.
//
// Another resolve of the lobe record: puts back the dependence on the pixel's own normal that blurring took, relative to
// the normals the blur averaged over. Where the two normals agree, the colour is returned as it is: no bias on smooth
// surfaces, whatever the light.
//
// The record describes light times lobe. Both are taken for von Mises-Fisher lobes, whose product has the sum of their
// vectors (sharpness * axis), so the light's vector is the record's minus the lobe's at the reference normal. Turning the
// lobe to the pixel's normal and integrating again gives the ratio by which the colour changes.
#ifndef NRD_RESTORE_GLSL
#define NRD_RESTORE_GLSL

// Half to double: what is left of noise in the axis must not become sparkle.
#define NRD_MAX_RESTORE_RATIO 2.0
// Of the von Mises-Fisher lobe with a cosine lobe's mean cosine, 2/3.
#define NRD_COSINE_SHARPNESS 3.0666667

// Over pi: irradiance at the normal from a light of unit power, whose vector is sharpness * axis. Cosine lobe and light
// as Legendre series up to order 2, which is within 0.1 of the truth even for a point.
float NRD_SG_Irradiance(vec3 light, vec3 normal)
{
    float k = length(light);
    float e = exp(-2.0 * k);
    // Below 0.1 the difference of the two large terms has no digits left, its series has.
    float mean = k > 0.1 ? (1.0 + e) / (1.0 - e) - 1.0 / k : k / 3.0;
    float second = k > 0.1 ? 1.0 - 3.0 * mean / k : k * k / 15.0;
    float c = dot(NRD_NormalizeOrZero(light), normal);
    return max(0.25 + 0.5 * mean * c + 0.15625 * second * (3.0 * c * c - 1.0), 0.05);
}

// referenceNormal: unit, mean of the guide's normals around the pixel, or the normal before normal mapping.
vec3 NRD_SG_RestoreDiffuse(NRD_SG sg, vec3 normal, vec3 referenceNormal)
{
    // A record wider than the lobe itself has no light to be told from it.
    float lobe = min(NRD_COSINE_SHARPNESS, sg.sharpness);
    vec3 light = NRD_SG_ExtractDirection(sg) * sg.sharpness - referenceNormal * lobe;
    float ratio = NRD_SG_Irradiance(light, normal) / NRD_SG_Irradiance(light, referenceNormal);
    ratio = clamp(ratio, 1.0 / NRD_MAX_RESTORE_RATIO, NRD_MAX_RESTORE_RATIO);
    return NRD_SG_Rechroma(sg, sg.c0 * ratio);
}

vec3 NRD_SG_RestoreSpecular(NRD_SG sg, vec3 normal, vec3 referenceNormal, vec3 view, float roughness)
{
    float r = clamp(roughness, 0.05, 1.0);
    float NoV = max(abs(dot(referenceNormal, view)), 0.1);
    // GGX warped from half vectors to directions, times a cosine.
    float lobe = min(0.5 / (r * r * r * r * NoV) + 2.0, sg.sharpness);
    vec3 turn = (NRD_DominantDirection(normal, view, roughness) -
                 NRD_DominantDirection(referenceNormal, view, roughness)) * lobe;
    vec3 L = NRD_SG_ExtractDirection(sg);
    float d = length(L * sg.sharpness + turn);
    // d - sharpness without cancellation; beyond e^20 the ratio is at its bound anyway.
    float exponent = (2.0 * sg.sharpness * dot(L, turn) + dot(turn, turn)) / max(d + sg.sharpness, 1e-6);
    float ratio = exp(clamp(exponent, -20.0, 20.0)) * NRD_SG_SphereFactor(d) / NRD_SG_SphereFactor(sg.sharpness);
    ratio = clamp(ratio, 1.0 / NRD_MAX_RESTORE_RATIO, NRD_MAX_RESTORE_RATIO);
    return NRD_SG_Rechroma(sg, sg.c0 * ratio);
}

#endif
