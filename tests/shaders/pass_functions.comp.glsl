#version 460
#extension GL_GOOGLE_include_directive : require
#include "functions.h"
#include "interface.glsl"
#include "bindings.h"
#include "denoiser_constants.h"

layout(set = 0, binding = 2, std430) readonly buffer Frames { DenoiserConstants gFrames[]; };

// Each invocation has constants of its own, so the passes' are left out.
#define DENOISER_BINDINGS_GLSL
DenoiserConstants g;
int kStep = 0; // likewise
const int kNormalEncoding = 2, kRoughnessEncoding = 1;
const bool kHasPrepass = true, kHasStabilization = true, kHasMaterialTest = false, kHasConfidence = false;
const bool kHasSpecularMotion = false, kHasAntiFirefly = true;
const bool kIsSoftware = true; // nothing is shared

// Named by functions that are not called here.
layout(set = 1, binding = 0) uniform sampler gNearestClamp;
layout(set = 1, binding = 1) uniform sampler gLinearClamp;
layout(set = 1, binding = 2) uniform texture2D gIn_PrevDepth;
layout(set = 1, binding = 3) uniform texture2D gIn_PrevNormalRoughness;
layout(set = 1, binding = 4) uniform utexture2D gIn_PrevLength;
layout(set = 1, binding = 5) uniform utexture2D gIn_Cut;
layout(set = 1, binding = 6) uniform texture2D gIn_PrevTrack;

#include "nrd_frontend.glsl"
#include "virtual_track.glsl"
#include "edge_stops.glsl"

// As 16 bits hold it.
float storedCode(float viewZ)
{
    return isInRange(decodeViewZ(viewZ)) ? floor(depthCode(viewZ) * 65535.0 + 0.5) / 65535.0 : 0.0;
}

Guide guideOf(vec3 N, float roughness) { return Guide(N, roughness, 0u); }

// As a pass places its pixels: from a pixel and a depth to the last frame's screen.
Results reproject(Arguments v)
{
    vec2 uv = pixelUv(ivec2(v.a.xy));
    vec3 X = rotate(g.viewToWorld, reconstructViewPosition(uv, g.frustum, v.a.z, g.cameraDelta.w));
    Motion motion = followMotion(uv, v.a.z, X, v.c.xyz);
    float viewZPrev = transform(g.worldToViewPrev, motion.Xprev).z;
    return Results(vec4(motion.uv, viewZPrev, 0.0), vec4(motion.Xprev, 0.0));
}

vec4 planeDistances(Arguments v)
{
    Pixel p = makePixel(ivec2(v.a.xy), v.a.z, guideOf(v.b.xyz, 0.5));
    Neighbour other = makeNeighbour(p, ivec2(v.c.xy), v.c.z, p.guide);
    return vec4(planeDistance(p.plane, v.c.xy, v.c.z), other.distance, p.frustumSize, p.NoV);
}

Stops stopsOf(Pixel p, Lobe lobe, vec4 e) { return makeStops(p, lobe, e.w != 0.0, e.x, e.y, e.z); }

Results edgeStops(Arguments v)
{
    kStep = int(v.b.z);
    Pixel p = makePixel(ivec2(0), v.a.x, guideOf(vec3(0.0, 0.0, -1.0), v.a.y));
    Stops stops = stopsOf(p, Lobe(v.a.y, 0u, 0.0), vec4(v.a.zw, v.b.xy));
    return Results(vec4(stops.normal, stops.roughness, stops.plane, stops.maxLuma), vec4(stops.relax, 0.0, 0.0, 0.0));
}

float edgeWeight(Arguments v)
{
    Pixel p = makePixel(ivec2(v.a.xy), v.a.z, guideOf(v.b.xyz, v.a.w));
    Lobe lobe = Lobe(v.a.w, 0u, 0.0);
    Neighbour other = makeNeighbour(p, ivec2(v.c.xy), v.c.z, guideOf(v.d.xyz, v.c.w));
    return tapWeight(p, lobe, v.e.w != 0.0, other, stopsOf(p, lobe, v.e));
}

Results evaluate(Arguments v)
{
    Results r = Results(vec4(0.0), vec4(0.0));
    switch (kFunction)
    {
    case FN_FOLLOW_MOTION:
    {
        Motion motion = followMotion(v.a.xy, v.a.z, v.b.xyz, v.c.xyz);
        r = Results(vec4(motion.uv, 0.0, 0.0), vec4(motion.Xprev, 0.0));
        break;
    }
    case FN_REPROJECT: r = reproject(v); break;
    case FN_DISOCCLUSION:
    {
        Surface s;
        s.NoV = v.a.x;
        s.frustumSize = v.a.y;
        s.disocclusionThreshold = v.a.z;
        r.first.x = disocclusionDistance(s, v.a.w);
        break;
    }
    case FN_DEPTH_TEST:
        r.first = testDepths(vec4(storedCode(v.a.x), storedCode(v.a.y), storedCode(v.a.z), storedCode(v.a.w)),
                             depthBounds(v.b.x, v.b.y));
        break;
    case FN_PLANE_DISTANCE: r.first = planeDistances(v); break;
    case FN_EDGE_STOPS: r = edgeStops(v); break;
    case FN_EDGE_WEIGHT: r.first.x = edgeWeight(v); break;
    case FN_LUMA_STOP: r.first.x = lumaStop(v.a.x, v.a.y, Stops(0.0, 0.0, 0.0, v.a.z, v.a.w, v.b.x)); break;
    case FN_ROUGHNESS_WEIGHT: r.first.x = roughnessWeight(v.a.x, v.a.y, v.a.z, v.a.w); break;
    case FN_ANGLE_CONFIDENCE: r.first.x = angleConfidence(v.a.xyz, v.b.xyz, v.c.x, v.c.y); break;
    case FN_HIT_DIST_WEIGHT: r.first.x = hitDistWeight(Weights(0.0, 0.0, v.a.z, v.a.w), v.a.x, v.a.y); break;
    case FN_SANITIZE:
    {
        bool isValid;
        r.first = sanitize(v.a, isValid);
        r.second = vec4(sanitizeAxis(v.b.xyz, r.first.x), isValid);
        break;
    }
    case FN_NORMAL_CUTOFF: r.first.x = normalCutoff(v.a.x, v.a.y); break;
    }
    return r;
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(gArguments.length())) return;
    g = gFrames[uint(gArguments[i].h.w)];
    gResults[i] = evaluate(gArguments[i]);
}
