// Part of nrd_frontend.glsl: include that.
//
// Another resolve of the lobe record: puts back the dependence on the pixel's own normal that blurring took, relative
// to the normals the blur averaged over. Where the two normals agree, the colour is returned as it is: no bias on
// smooth surfaces, whatever the light.
//
// The record describes light times lobe. Both are taken for von Mises-Fisher lobes, whose product has the sum of their
// vectors (sharpness * axis), so the light's vector is the record's minus the lobe's at the reference normal. Turning
// the lobe to the pixel's normal and integrating again gives the ratio by which the colour changes.
#ifndef NRD_RESTORE_GLSL
#define NRD_RESTORE_GLSL

// A pixel and four around it, left, right, up and down, in any order; a pixel or two away.
struct NRD_Neighborhood
{
    vec3 normal; // of this frame, full detail
    float viewZ;
    vec3 neighborNormals[4];
    vec4 neighborViewZ;
};

// Neither an edge of depth nor of normal. NaN in a depth fails the comparison, so it is an edge too.
bool NRD_IsSameSurface(NRD_Neighborhood s, int neighbor, vec3 view)
{
    float NoV = clamp(abs(dot(s.normal, view)), 0.0, 1.0);
    return abs(s.neighborViewZ[neighbor] - s.viewZ) <= 0.01 * abs(s.viewZ) / (0.95 * NoV + 0.05) &&
           dot(s.neighborNormals[neighbor], s.normal) >= 0.01;
}

// How far a normal may be off, per roughness, for the denoiser to blur across: a little wider than REBLUR's default.
#define NRD_REFERENCE_NORMAL_ANGLE 0.2

// Mean of the normals that the denoiser blurred together: the reference below, for those who have no normal from before
// normal mapping. Others must stay out: a corner's mean normal belongs to neither wall. roughness: 1 for diffuse.
vec3 NRD_GetReferenceNormal(NRD_Neighborhood s, vec3 view, float roughness)
{
    float angle = NRD_REFERENCE_NORMAL_ANGLE * roughness;
    vec3 sum = s.normal;
    for (int i = 0; i < 4; i++)
    {
        vec3 apart = s.neighborNormals[i] - s.normal; // its length is the angle, where acos has no digits
        if (dot(apart, apart) <= angle * angle && NRD_IsSameSurface(s, i, view)) sum += s.neighborNormals[i];
    }
    return NRD_NormalizeOrZero(sum);
}

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

// referenceNormal: unit, the normal before normal mapping, or the mean of the guide's around the pixel.
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
    // Half of GGX warped from half vectors to directions, times a cosine: its long tail falls more slowly than a
    // Gaussian with the same peak, and half has the least error in tests/shaders/test_restore.cpp.
    float lobe = min(0.25 / (r * r * r * r * NoV) + 1.0, sg.sharpness);
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
