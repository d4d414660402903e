// Part of nrd_frontend.glsl: include that.
//
// Lobe trimming: rays of very low probability make fireflies, so the tail of the specular lobe is cut. Biased by
// design: leave it off in reference renders.
#ifndef NRD_LOBE_TRIMMING_GLSL
#define NRD_LOBE_TRIMMING_GLSL

// How much of the lobe is kept: 0 its dominant direction, 1 all. parameters: kept at most, and the roughness between
// which that is reached; (0.85, 0.04, 0.11) is a good start.
float NRD_GetTrimmingFactor(float roughness, vec3 parameters)
{
    float t = clamp((roughness - parameters.y) / max(parameters.z - parameters.y, 1e-6), 0.0, 1.0);
    return parameters.x * t * t * (3.0 - 2.0 * t);
}

// Multiply Fresnel by it: a trimmed lobe loses shadowing. geometryTerm: pre-integrated, of the full lobe.
float NRD_GetTrimmingCompensation(float geometryTerm, float trimmingFactor)
{
    return mix(geometryTerm, 1.0, clamp(trimmingFactor, 0.0, 1.0));
}

// Microfacet normal, tangent space with the surface's normal as z, of GGX as seen from view (view.z > 0); Heitz 2018,
// "Sampling the GGX Distribution of Visible Normals", its polar number drawn from [0; trimmingFactor].
vec3 NRD_SampleTrimmedLobe(vec2 random, vec3 view, float roughness, float trimmingFactor)
{
    float alpha = roughness * roughness;
    vec3 v = NRD_NormalizeOrZero(vec3(alpha * view.xy, view.z));
    float squared = dot(v.xy, v.xy);
    // Looking straight down any tangent will do.
    vec3 t = squared > 1e-14 ? vec3(-v.y, v.x, 0.0) * inversesqrt(squared) : vec3(1.0, 0.0, 0.0);
    vec3 b = cross(v, t);
    float radius = sqrt(clamp(random.x * trimmingFactor, 0.0, 1.0));
    float phi = 2.0 * NRD_PI * random.y;
    float x = radius * cos(phi);
    float s = 0.5 * (1.0 + v.z);
    float y = mix(sqrt(max(1.0 - x * x, 0.0)), radius * sin(phi), s);
    vec3 n = x * t + y * b + sqrt(max(1.0 - x * x - y * y, 0.0)) * v;
    // 1e-6: a grazing facet of a mirror would be all zeros.
    return NRD_NormalizeOrZero(vec3(alpha * n.xy, max(n.z, 1e-6)));
}

#endif
