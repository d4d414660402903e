// Part of nrd_frontend.glsl: include that.
//
// Results of the ..._SH and directional denoisers: a lobe's colour and the direction most of it comes from, and what
// the pixel's own normal makes of them. Use the full-detail normal of the current frame. A resolved lobe replaces the
// colour.
#ifndef NRD_RESOLVE_GLSL
#define NRD_RESOLVE_GLSL

#define NRD_PI 3.14159265
// Half floats hold |c1| / c0 to about 0.001: nothing sharper than this can be told from a point light.
#define NRD_MAX_ANISOTROPY 0.999

// A spherical Gaussian: luma about an axis.
struct NRD_SG
{
    float c0;          // luma, or normalised hit distance for directional occlusion
    vec2 chroma;       // Co, Cg
    float normHitDist; // or history length: RELAX always, REBLUR as the instance was asked for
    vec3 c1;           // direction * luma, mean of the samples: |c1| / c0 is the mean cosine to the axis
    float sharpness;   // measured: 0 from everywhere, about 2000 from one point
};

// Sharpness of the von Mises-Fisher lobe whose mean cosine is |c1| / c0; Banerjee et al. 2005, equation 4.4.
float NRD_SG_GetSharpness(float c0, vec3 c1)
{
    float mu = clamp(length(c1) / max(c0, NRD_LUMA_EPS), 0.0, NRD_MAX_ANISOTROPY);
    return mu * (3.0 - mu * mu) / (1.0 - mu * mu);
}

// OUT_DIFF_SH0 and OUT_DIFF_SH1, OUT_SPEC_SH0 and OUT_SPEC_SH1
NRD_SG REBLUR_BackEnd_UnpackSh(vec4 sh0, vec4 sh1)
{
    NRD_SG sg;
    sg.c0 = sh0.x;
    sg.chroma = sh0.yz;
    sg.normHitDist = sh0.w;
    sg.c1 = sh1.xyz;
    sg.sharpness = NRD_SG_GetSharpness(sg.c0, sg.c1);
    return sg;
}

// The same slots of RELAX, whose inputs are linear: (Y, Co, Cg, history length) and the vector come back.
NRD_SG RELAX_BackEnd_UnpackSh(vec4 sh0, vec4 sh1)
{
    return REBLUR_BackEnd_UnpackSh(sh0, sh1);
}

// OUT_DIFF_DIRECTION_HITDIST. Resolving it as a diffuse lobe gives the occlusion for the pixel's normal.
NRD_SG REBLUR_BackEnd_UnpackDirectionalOcclusion(vec4 data)
{
    return REBLUR_BackEnd_UnpackSh(vec4(data.w, 0.0, 0.0, data.w), vec4(data.xyz, 0.0));
}

// What the denoiser without SH returns.
vec3 NRD_SG_ExtractColor(NRD_SG sg)
{
    return NRD_YCoCgToLinear(vec3(sg.c0, sg.chroma));
}

// Unit; zero if no direction is known.
vec3 NRD_SG_ExtractDirection(NRD_SG sg)
{
    return NRD_NormalizeOrZero(sg.c1);
}

void NRD_SG_Rotate(inout NRD_SG sg, mat3 rotation)
{
    sg.c1 = NRD_MUL(rotation, sg.c1);
}

// The lobe's colour at another luma.
vec3 NRD_SG_Rechroma(NRD_SG sg, float luma)
{
    float y = max(luma, 0.0);
    return NRD_YCoCgToLinear(vec3(y, sg.chroma * ((y + NRD_LUMA_EPS) / (max(sg.c0, 0.0) + NRD_LUMA_EPS))));
}

float NRD_Pow5(float x)
{
    float x2 = x * x;
    return x2 * x2 * x;
}

//----------------------------------------------------------------------------------------------------------------------
// Spherical harmonics, first order: for comparison

vec3 NRD_SH_ResolveDiffuse(NRD_SG sh, vec3 normal)
{
    return NRD_SG_Rechroma(sh, (sh.c0 + 3.0 * dot(sh.c1, normal)) / NRD_PI);
}

// Where most of a GGX lobe points to; Lagarde and de Rousiers 2014, "Moving Frostbite to PBR".
vec3 NRD_DominantDirection(vec3 normal, vec3 view, float roughness)
{
    float NoV = clamp(abs(dot(normal, view)), 0.0, 1.0);
    float a = 0.298475 * log(39.4115 - 39.0029 * clamp(roughness, 0.0, 1.0));
    float g = clamp(mix(a, 1.0, pow(1.0 - NoV, 10.8649)), 0.0, 1.0);
    return NRD_NormalizeOrZero(mix(normal, reflect(-view, normal), g));
}

vec3 NRD_SH_ResolveSpecular(NRD_SG sh, vec3 normal, vec3 view, float roughness)
{
    return NRD_SH_ResolveDiffuse(sh, NRD_DominantDirection(normal, view, roughness));
}

//----------------------------------------------------------------------------------------------------------------------
// Spherical Gaussians of fixed sharpness

// (1 - e^(-2d)) / d without the cancellation at small d.
float NRD_SG_SphereFactor(float d)
{
    return d > 1e-3 ? (1.0 - exp(-2.0 * d)) / d : 2.0 - 2.0 * d;
}

// Integral over the sphere of the product of two lobes a * e^(s * (x.axis - 1)) with unit axes.
// The exponent |s1 u1 + s2 u2| - s1 - s2 is rewritten: sharpness beyond 1e5 leaves nothing of the plain difference.
float NRD_SG_ProductIntegral(vec3 axisA, float sharpnessA, vec3 axisB, float sharpnessB, float amplitude)
{
    float d = length(sharpnessA * axisA + sharpnessB * axisB);
    vec3 between = axisA - axisB;
    float exponent = -sharpnessA * sharpnessB * dot(between, between) / max(d + sharpnessA + sharpnessB, 1e-15);
    return 2.0 * NRD_PI * amplitude * exp(exponent) * NRD_SG_SphereFactor(d);
}

// Burley 2012, without albedo.
float NRD_BurleyTerm(float NoL, float NoV, float VoH, float roughness)
{
    float e = 2.0 * VoH * VoH * roughness - 0.5;
    return (1.0 + e * NRD_Pow5(1.0 - NoL)) * (1.0 + e * NRD_Pow5(1.0 - NoV)) / NRD_PI;
}

// Height-correlated Smith over 4 NoL NoV; m2 is roughness^4 and > 0, or both cosines 0 would divide by 0.
float NRD_SmithVisibility(float NoL, float NoV, float m2)
{
    return 0.5 / (NoV * sqrt(NoL * NoL * (1.0 - m2) + m2) + NoL * sqrt(NoV * NoV * (1.0 - m2) + m2));
}

// Without a direction both resolves return the colour.
vec3 NRD_SG_ResolveDiffuse(NRD_SG sg, vec3 normal, vec3 view, float roughness)
{
    vec3 L = NRD_SG_ExtractDirection(sg);
    if (dot(L, L) == 0.0) return NRD_SG_ExtractColor(sg);
    float NoL = clamp(dot(normal, L), 0.0, 1.0);
    float NoV = clamp(abs(dot(normal, view)), 0.0, 1.0);
    float VoH = clamp(dot(view, NRD_NormalizeOrZero(view + L)), 0.0, 1.0);
    float y = NRD_SG_ProductIntegral(L, 2.0, normal, 2.0, 2.0 * sg.c0) * NRD_BurleyTerm(NoL, NoV, VoH, roughness);
    y *= mix(1.0, mix(1.5, 0.6, roughness), NRD_Pow5(1.0 - NoV));
    return NRD_SG_Rechroma(sg, max(y, sg.c0 / NRD_PI));
}

// No Fresnel: it is in the factor that was divided out. Below roughness 0.05 the lobe outgrows floats.
vec3 NRD_SG_ResolveSpecular(NRD_SG sg, vec3 normal, vec3 view, float roughness)
{
    vec3 L = NRD_SG_ExtractDirection(sg);
    if (dot(L, L) == 0.0) return NRD_SG_ExtractColor(sg);
    float r = clamp(roughness, 0.05, 1.0);
    float m2 = r * r * r * r;
    float NoL = clamp(dot(normal, L), 0.0, 1.0);
    float NoV = mix(0.02, 1.0, clamp(abs(dot(normal, view)), 0.0, 1.0));
    float VoH = clamp(dot(view, NRD_NormalizeOrZero(view + L)), 0.0, 1.0);
    float sharpness = 2.0 / m2;
    float y = NRD_SG_ProductIntegral(L, sharpness, L, 0.5 / max(m2 * VoH, 1e-8), sg.c0 * sharpness);
    y *= NRD_SmithVisibility(NoL, NoV, m2) * NoL * mix(mix(0.1, 0.4, m2), 0.8, NoV);
    return NRD_SG_Rechroma(sg, max(y, sg.c0 / NRD_PI));
}

#endif
