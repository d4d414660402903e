#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "functions.h"
#include "interface.glsl"
#include "virtual_motion.glsl"
#include "history.glsl"
#include "axis.glsl"
#include "random.glsl"

vec4 catmullRomCentre(CatmullRom c, out float sum)
{
    vec2 positions[5] = vec2[](vec2(c.xTaps.y, c.yTaps.x), vec2(c.xTaps.x, c.yTaps.y), vec2(c.xTaps.y, c.yTaps.y),
                               vec2(c.xTaps.z, c.yTaps.y), vec2(c.xTaps.y, c.yTaps.z));
    vec2 centre = vec2(0.0);
    sum = 0.0;
    for (int i = 0; i < 5; i++)
    {
        centre += positions[i] * c.weights[i];
        sum += c.weights[i];
    }
    return vec4(centre, 0.0, 0.0);
}

Reflector reflector(Arguments v)
{
    Reflector r;
    r.X = v.a.xyz;
    r.Xprev = v.c.xyz;
    r.N = v.b.xyz;
    r.V = -normalize(v.a.xyz);
    r.NoV = abs(dot(r.N, r.V));
    r.factor = dominantFactor(r.NoV, v.c.w);
    r.NoD = dot(r.N, dominantDirection(r.N, r.V, r.factor));
    r.distanceToCamera = length(v.a.xyz);
    return r;
}

// In steps, after so many passes that only read and write; half of the reads are off to either side.
vec3 storeAxisAgain(vec3 axis, float error, int passes, uint seed)
{
    vec3 stored = vec3(0.0);
    for (int i = 0; i < passes; i++)
    {
        vec3 dither = vec3(nextRandom(seed), nextRandom(seed), nextRandom(seed));
        stored = encodeAxis(axis, dither);
        axis = decodeAxis(stored + (nextRandom(seed) < 0.5 ? -error : error));
    }
    return stored * 1023.0;
}

Results evaluate(Arguments v)
{
    Results r = Results(vec4(0.0), vec4(0.0));
    switch (kFunction)
    {
    case FN_FALLOFFS: r.first = vec4(soft(v.a.x), heavy(v.a.x), smooth01(v.a.x), 0.0); break;
    case FN_RAMP: r.first.x = ramp(v.a.x, v.a.y, v.a.z); break;
    case FN_DOMINANT_FACTOR: r.first.x = dominantFactor(v.a.x, v.a.y); break;
    case FN_DOMINANT_DIRECTION:
        r.first.xyz = dominantDirection(v.a.xyz, v.b.xyz, dominantFactor(abs(dot(v.a.xyz, v.b.xyz)), v.a.w));
        break;
    case FN_LOBE_TANGENT: r.first.x = lobeTangent(v.a.x, v.a.y); break;
    case FN_MIRROR_UV: r.first.xy = mirrorUv(v.a.xy); break;
    case FN_VIRTUAL_POSITION: r.first.xyz = virtualPosition(reflector(v), v.a.w, v.b.w); break;
    case FN_IMAGE_MOTION: r.first.xyz = imageMotion(reflector(v), v.a.w, v.b.w, v.d.xyz); break;
    case FN_CURVATURE: r.first.x = curvatureFromEdge(v.a.xyz, v.b.xyz, v.c.xyz, v.d.xyz); break;
    case FN_RECONSTRUCT: r.first.xyz = reconstructViewPosition(v.a.xy, v.b, v.a.z, v.a.w); break;
    case FN_FOOTPRINT:
    {
        Footprint f = makeFootprint(v.a.xy);
        r.first = f.bilinear;
        r.second = vec4(f.origin, 0, 0);
        break;
    }
    case FN_CATMULL_ROM: r.first = catmullRomCentre(makeCatmullRom(v.a.xy, vec2(1.0)), r.second.x); break;
    case FN_CATMULL_ROM_WEIGHTS:
    {
        CatmullRom c = makeCatmullRom(v.a.xy, vec2(1.0));
        r.first = vec4(c.weights[0], c.weights[1], c.weights[2], c.weights[3]);
        r.second = vec4(c.weights[4], c.xTaps.y, c.yTaps.y, 0.0);
        break;
    }
    case FN_ROUND_TO_HALF: r.first = roundToHalf(v.a); break;
    case FN_NORMAL_ANGLE: r.first.x = angleBetween(v.a.xyz, v.b.xyz); break;
    case FN_TANGENT_BASIS: tangentBasis(v.a.xyz, r.first.xyz, r.second.xyz); break;
    case FN_PROJECT:
    {
        mat4 m = transpose(mat4(v.b, v.c, vec4(0.0), v.d));
        r.first.xy = projectToUv(m, v.a.xyz);
        break;
    }
    case FN_AXIS_CODE: r.first.xyz = storeAxisAgain(v.a.xyz, v.a.w, int(v.b.x), uint(v.b.y)); break;
    case FN_CUSTOM_BILINEAR: r.first.x = customBilinear(v.a, v.b); break;
    }
    return r;
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(gArguments.length())) gResults[i] = evaluate(gArguments[i]);
}
