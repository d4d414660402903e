// In both languages.
#include "nrd_frontend.glsl"
#include "functions.h"
#include "interface.glsl"

Results evaluate(Arguments v)
{
    Results r = results(vec4(0.0, 0.0, 0.0, 0.0), vec4(0.0, 0.0, 0.0, 0.0));
    SIGMA_MultiLight lights = SIGMA_FrontEnd_MultiLight_Begin();
    switch (kFunction)
    {
    case FN_PENUMBRA:
        r.first.x = SIGMA_FrontEnd_PackPenumbra(v.a.x, v.a.y);
        r.first.y = SIGMA_FrontEnd_PackPenumbra(v.a.x, v.a.z, v.a.w);
        r.second = SIGMA_FrontEnd_PackTranslucency(v.a.x, v.b.xyz);
        break;
    case FN_UNPACK_SHADOW:
        r.first.x = SIGMA_BackEnd_UnpackShadow(v.a.x);
        r.second = SIGMA_BackEnd_UnpackShadow(v.a);
        break;
    case FN_MULTI_LIGHT:
        SIGMA_FrontEnd_MultiLight_Add(lights, v.a.xyz, v.a.w, v.b.xyz);
        SIGMA_FrontEnd_MultiLight_Add(lights, v.c.xyz, v.c.w, v.d.xyz);
        SIGMA_FrontEnd_MultiLight_Add(lights, v.e.xyz, v.e.w, v.f.xyz);
        r.first.x = SIGMA_FrontEnd_MultiLight_End(lights, r.second);
        break;
    }
    return r;
}

#include "main.glsl"
