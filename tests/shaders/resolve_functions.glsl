// In both languages.
#include "nrd_frontend.glsl"
#include "functions.h"
#include "interface.glsl"

NRD_Neighborhood neighborhood(Arguments v)
{
    NRD_Neighborhood s;
    s.normal = v.d.xyz;
    s.viewZ = v.d.w;
    s.neighborNormals[0] = v.e.xyz;
    s.neighborNormals[1] = v.f.xyz;
    s.neighborNormals[2] = v.g.xyz;
    s.neighborNormals[3] = v.h.xyz;
    s.neighborViewZ = vec4(v.e.w, v.f.w, v.g.w, v.h.w);
    return s;
}

vec2 rejitter(Arguments v)
{
    NRD_SG diffuse = REBLUR_BackEnd_UnpackSh(vec4(1.0, 0.0, 0.0, 0.0), vec4(v.a.xyz, 0.0));
    NRD_SG specular = REBLUR_BackEnd_UnpackSh(vec4(1.0, 0.0, 0.0, 0.0), vec4(v.b.xyz, 0.0));
    return NRD_SG_ReJitter(diffuse, specular, v.c.xyz, v.a.w, neighborhood(v));
}

// Two mirrors, the second one at rest.
NRD_Unfolding unfolding(Arguments v, vec3 hit, vec3 normal)
{
    NRD_Unfolding u = NRD_Unfolding_AddMirror(NRD_Unfolding_Begin(), hit, NRD_NormalizeOrZero(normal));
    return NRD_Unfolding_AddMirror(u, v.d.xyz, NRD_NormalizeOrZero(v.e.xyz));
}

Results unfold(NRD_Unfolding u, Arguments v)
{
    return results(vec4(NRD_Unfolding_GetPosition(u, v.a.xyz), 0.0),
                   vec4(NRD_Unfolding_GetDirection(u, v.f.xyz), 0.0));
}

vec3 unfoldedMotion(Arguments v)
{
    NRD_Unfolding now = unfolding(v, v.b.xyz, v.c.xyz);
    NRD_Unfolding before = unfolding(v, v.b.xyz + v.g.xyz, v.h.xyz);
    return NRD_Unfolding_GetMotion(now, before, v.a.xyz, v.f.xyz);
}

Results bend(Arguments v)
{
    vec3 from = NRD_NormalizeOrZero(v.c.xyz), to = NRD_NormalizeOrZero(v.d.xyz);
    return unfold(NRD_Unfolding_AddBend(NRD_Unfolding_Begin(), v.b.xyz, from, to), v);
}

Results evaluate(Arguments v)
{
    Results r = results(vec4(0.0, 0.0, 0.0, 0.0), vec4(0.0, 0.0, 0.0, 0.0));
    NRD_SG sg = REBLUR_BackEnd_UnpackSh(v.a, v.b);
    switch (kFunction)
    {
    case FN_UNPACK_SH: r = results(vec4(sg.c0, sg.chroma, sg.normHitDist), vec4(sg.c1, sg.sharpness)); break;
    case FN_UNPACK_RELAX_SH:
        sg = RELAX_BackEnd_UnpackSh(v.a, v.b);
        r = results(vec4(sg.c0, sg.chroma, sg.normHitDist), vec4(sg.c1, sg.sharpness));
        break;
    case FN_UNPACK_DIRECTIONAL:
        sg = REBLUR_BackEnd_UnpackDirectionalOcclusion(v.a);
        r = results(vec4(sg.c0, sg.chroma, sg.normHitDist), vec4(sg.c1, sg.sharpness));
        break;
    case FN_EXTRACT:
        r.first.xyz = NRD_SG_ExtractColor(sg);
        r.second.xyz = NRD_SG_ExtractDirection(sg);
        break;
    case FN_ROTATE:
        NRD_SG_Rotate(sg, fromColumns(vec3(v.c.xy, 0.0), vec3(-v.c.y, v.c.x, 0.0), vec3(0.0, 0.0, 1.0)));
        r.first.xyz = sg.c1;
        break;
    case FN_SH_DIFFUSE: r.first.xyz = NRD_SH_ResolveDiffuse(sg, v.c.xyz); break;
    case FN_SH_SPECULAR: r.first.xyz = NRD_SH_ResolveSpecular(sg, v.c.xyz, v.d.xyz, v.c.w); break;
    case FN_SG_DIFFUSE: r.first.xyz = NRD_SG_ResolveDiffuse(sg, v.c.xyz, v.d.xyz, v.c.w); break;
    case FN_SG_SPECULAR: r.first.xyz = NRD_SG_ResolveSpecular(sg, v.c.xyz, v.d.xyz, v.c.w); break;
    case FN_SG_INTEGRAL: r.first.x = NRD_SG_ProductIntegral(v.a.xyz, v.a.w, v.b.xyz, v.b.w, v.c.x); break;
    case FN_RESTORE_DIFFUSE: r.first.xyz = NRD_SG_RestoreDiffuse(sg, v.c.xyz, v.d.xyz); break;
    case FN_RESTORE_SPECULAR:
        r.first.xyz = NRD_SG_RestoreSpecular(sg, v.c.xyz, v.e.xyz, v.d.xyz, v.c.w);
        break;
    case FN_CAVITY:
        r.first.x = NRD_SG_CavityShadow(sg, v.c.xyz, v.c.w, v.d.x, v.d.y);
        r.first.y = NRD_SG_CavityShadow(sg, v.c.xyz, v.c.w);
        break;
    case FN_REJITTER: r.first.xy = rejitter(v); break;
    case FN_REFERENCE_NORMAL:
        r.first.xyz = NRD_GetReferenceNormal(neighborhood(v), v.c.xyz, v.c.w);
        break;
    case FN_UNFOLD: r = unfold(unfolding(v, v.b.xyz, v.c.xyz), v); break;
    case FN_UNFOLD_MOTION: r.first.xyz = unfoldedMotion(v); break;
    case FN_UNFOLD_BEND: r = bend(v); break;
    case FN_DOMINANT: r.first.xyz = NRD_DominantDirection(v.c.xyz, v.d.xyz, v.c.w); break;
    }
    return r;
}

#include "main.glsl"
