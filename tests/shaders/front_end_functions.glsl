// In both languages.
#include "nrd_frontend.glsl"
#include "functions.h"
#include "interface.glsl"

// As storing in a texture and reading it does.
vec4 quantized(vec4 v, vec4 steps, bool isSigned)
{
    return floor(clamp(v, isSigned ? -1.0 : 0.0, 1.0) * steps + 0.5) / steps;
}

vec4 normalRoundTrip(Arguments v, out float material)
{
    vec4 packed = NRD_PackNormalAndRoughness(v.a.xyz, v.a.w, v.b.x, int(v.b.y), int(v.b.z));
    packed = quantized(packed, vec4(v.c.xxx, v.c.y), v.c.z != 0.0);
    return NRD_UnpackNormalAndRoughness(packed, int(v.b.y), int(v.b.z), material);
}

Results evaluate(Arguments v)
{
    Results r = results(vec4(0.0, 0.0, 0.0, 0.0), vec4(0.0, 0.0, 0.0, 0.0));
    switch (kFunction)
    {
    case FN_PACK_NORMAL:
        r.first = NRD_PackNormalAndRoughness(v.a.xyz, v.a.w, v.b.x, int(v.b.y), int(v.b.z));
        r.second = NRD_FrontEnd_PackNormalAndRoughness(v.a.xyz, v.a.w, v.b.x);
        break;
    case FN_UNPACK_NORMAL: r.first = NRD_UnpackNormalAndRoughness(v.a, int(v.b.y), int(v.b.z), r.second.x); break;
    case FN_NORMAL_ROUND_TRIP: r.first = normalRoundTrip(v, r.second.x); break;
    case FN_YCOCG: r.first.xyz = NRD_LinearToYCoCg(v.a.xyz); break;
    case FN_FROM_YCOCG: r.first.xyz = NRD_YCoCgToLinear(v.a.xyz); break;
    case FN_LOBE_SPREAD: r.first.x = NRD_GetLobeSpread(v.a.x, v.a.y); break;
    case FN_NORM_HIT_DIST: r.first.x = REBLUR_FrontEnd_GetNormHitDist(v.a.x, v.a.y, v.b.xyz, v.a.z); break;
    case FN_HIT_DIST: r.first.x = REBLUR_GetHitDist(v.a.x, v.a.y, v.b.xyz, v.a.z); break;
    case FN_PACK_RADIANCE: r.first = REBLUR_FrontEnd_PackRadianceAndNormHitDist(v.a.xyz, v.a.w, v.b.x != 0.0); break;
    case FN_UNPACK_RADIANCE: r.first = REBLUR_BackEnd_UnpackRadianceAndNormHitDist(v.a); break;
    case FN_ENVIRONMENT_TERM: r.first.xyz = NRD_EnvironmentTerm(v.a.xyz, v.a.w, v.b.x); break;
    case FN_MATERIAL_FACTORS:
        NRD_MaterialFactors(vec3(0.0, 0.0, 1.0), vec3(sqrt(1.0 - v.b.w * v.b.w), 0.0, v.b.w), v.a.xyz, v.b.xyz, v.a.w,
                            r.first.xyz, r.second.xyz);
        break;
    case FN_AVERAGING:
        r.first.x = NRD_FrontEnd_SpecHitDistAveraging_Begin();
        for (int i = 0; i < 4; i++) NRD_FrontEnd_SpecHitDistAveraging_Add(r.first.x, v.a[i]);
        NRD_FrontEnd_SpecHitDistAveraging_End(r.first.x);
        r.first.y = NRD_FrontEnd_TrimHitDistance(v.a.x, 0.5);
        break;
    case FN_PACK_RELAX:
        r.first = RELAX_FrontEnd_PackRadianceAndHitDist(v.a.xyz, v.a.w, v.b.x != 0.0);
        r.second = RELAX_BackEnd_UnpackRadiance(r.first);
        break;
    case FN_PACK_RELAX_SH: r.first = RELAX_FrontEnd_PackSh(v.a.xyz, v.a.w, v.b.xyz, r.second, v.b.w != 0.0); break;
    case FN_PACK_SH: r.first = REBLUR_FrontEnd_PackSh(v.a.xyz, v.a.w, v.b.xyz, r.second, v.b.w != 0.0); break;
    case FN_PACK_DIRECTIONAL:
        r.first = REBLUR_FrontEnd_PackDirectionalOcclusion(v.a.xyz, v.a.w, v.b.x != 0.0);
        break;
    case FN_TRIMMING:
        r.first.x = NRD_GetTrimmingFactor(v.a.x, v.b.xyz);
        r.first.y = NRD_GetTrimmingCompensation(v.a.y, r.first.x);
        break;
    case FN_TRIMMED_SAMPLE: r.first.xyz = NRD_SampleTrimmedLobe(v.a.xy, v.b.xyz, v.a.z, v.a.w); break;
    case FN_STRANDS:
        r.second.xyz = NRD_GetStrandBitangent(v.b.xyz, v.a.xyz);
        r.first = vec4(NRD_GetStrandNormal(v.a.xyz, r.second.xyz), NRD_GetStrandThicknessFactor(v.a.w, v.b.w));
        break;
    }
    return r;
}

#include "main.glsl"
