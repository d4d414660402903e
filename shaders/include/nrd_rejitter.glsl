// Part of nrd_frontend.glsl: include that.
//
// Re-jittering: sub-pixel detail that the temporal filter averaged out, put back for an upscaler that expects jitter.
// Without camera jitter there is nothing to restore and this merely sharpens: leave it out then.
#ifndef NRD_REJITTER_GLSL
#define NRD_REJITTER_GLSL

// Lambert-like lobe of Burley towards L, with the cosine.
float NRD_SG_DiffuseResponse(vec3 normal, vec3 view, vec3 L, float roughness)
{
    float NoL = clamp(dot(normal, L), 0.0, 1.0);
    float NoV = clamp(abs(dot(normal, view)), 0.0, 1.0);
    float VoH = clamp(dot(view, NRD_NormalizeOrZero(view + L)), 0.0, 1.0);
    return NRD_BurleyTerm(NoL, NoV, VoH, roughness) * NoL;
}

// GGX towards L, without Fresnel, with the cosine. |N x H|^2 instead of 1 - NoH^2, which has no digits for sharp lobes.
float NRD_SG_SpecularResponse(vec3 normal, vec3 view, vec3 L, float roughness)
{
    float r = clamp(roughness, 0.05, 1.0);
    float m2 = r * r * r * r;
    vec3 H = NRD_NormalizeOrZero(view + L);
    vec3 sine = cross(normal, H);
    float NoH = dot(normal, H);
    // 1e-12: without a half vector (L = -view) both terms are 0.
    float t = max(m2 * NoH * NoH + dot(sine, sine), 1e-12);
    float NoL = clamp(dot(normal, L), 0.0, 1.0);
    float NoV = mix(0.02, 1.0, clamp(abs(dot(normal, view)), 0.0, 1.0));
    return m2 / (NRD_PI * t * t) * NRD_SmithVisibility(NoL, NoV, m2) * NoL;
}

// Returns (diffuse, specular) scales in [1/2; 2] for the resolved lobes; 1 at edges. Neighbours are the next pixels.
vec2 NRD_SG_ReJitter(NRD_SG diffSg, NRD_SG specSg, vec3 view, float roughness, NRD_Neighborhood s)
{
    vec3 Ld = NRD_SG_ExtractDirection(diffSg);
    vec3 Ls = NRD_NormalizeOrZero(mix(view, NRD_SG_ExtractDirection(specSg), NRD_GetLobeSpread(roughness, 0.5)));
    vec2 around = vec2(0.0, 0.0);
    for (int i = 0; i < 4; i++)
    {
        if (!NRD_IsSameSurface(s, i, view)) return vec2(1.0, 1.0);
        around.x += 0.25 * NRD_SG_DiffuseResponse(s.neighborNormals[i], view, Ld, roughness);
        around.y += 0.25 * NRD_SG_SpecularResponse(s.neighborNormals[i], view, Ls, roughness);
    }
    vec2 centre = vec2(NRD_SG_DiffuseResponse(s.normal, view, Ld, roughness),
                       NRD_SG_SpecularResponse(s.normal, view, Ls, roughness));
    return clamp((centre + NRD_LUMA_EPS) / (around + NRD_LUMA_EPS), 0.5, 2.0);
}

#endif
