#version 460
#extension GL_GOOGLE_include_directive : require
#include "functions.h"
#include "interface.glsl"
#include "shadow_history.glsl"

// What an image of 8 bits makes of it.
float store(float x) { return floor(clamp(x, 0.0, 1.0) * 255.0 + 0.5) / 255.0; }
vec4 store(vec4 x) { return floor(clamp(x, 0.0, 1.0) * 255.0 + 0.5) / 255.0; }

Results evaluate(Arguments v)
{
    Results r = Results(vec4(0.0), vec4(0.0));
    switch (kFunction)
    {
    case FN_RADIUS:
    {
        float stored = store(encodeRadius(v.a.x));
        float decoded = decodeRadius(stored);
        r.first = vec4(stored * 255.0, decoded, store(encodeRadius(decoded)) * 255.0, decodeRadius(v.a.y / 255.0));
        break;
    }
    case FN_DEPTH: r.first.x = unpackDepth(packDepth(v.a.x)); break;
    case FN_ROOTS: r = Results(decodeShadow(store(encodeShadow(v.a))), encodeOutput(v.a)); break;
    case FN_PAST:
    {
        Past past = Past(v.a, v.b.x);
        past = unpackPast(packVisibility(past), packColor(past));
        r = Results(past.shadow, vec4(past.n));
        break;
    }
    }
    return r;
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(gArguments.length())) gResults[i] = evaluate(gArguments[i]);
}
