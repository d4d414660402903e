// What weighs the taps of the wavelet: surface, direction, roughness and luma. Needs kStep, log2 of its stride.
#ifndef EDGE_STOPS_GLSL
#define EDGE_STOPS_GLSL
#include "spatial_filter.glsl"

struct Stops
{
    float normal;    // 1 / radians
    float roughness; // 1 / roughness, 0 for diffuse
    float plane;     // 1 / world units
    float luma;      // 1 / luma
    float maxLuma;   // cap of the exponent
    float relax;     // of the luma stop
};

// What both lobes ask of a neighbour.
struct Neighbour
{
    Guide guide;
    bool isInRange;
    float distance; // from the centre's plane, world units
    float turned;   // between the normals, square of the chord
    float seen;     // likewise between the directions of view
};

Neighbour makeNeighbour(Pixel p, ivec2 pixel, float viewZ, Guide guide)
{
    vec3 Xv = reconstructViewPosition(pixelUv(pixel), g.frustum, viewZ, g.cameraDelta.w);
    Neighbour other;
    other.guide = guide;
    other.isInRange = isInRange(viewZ);
    other.distance = abs(dot(p.Nv, Xv - p.Xv));
    other.turned = squaredAngleBetween(p.guide.N, guide.N);
    // Seen from farther back, it changes less.
    vec3 shift = p.Vv + normalize(Xv + g.relaxViewRelaxation * p.Xv);
    other.seen = g.cameraDelta.w == 0.0 ? dot(shift, shift) : 0.0;
    return other;
}

float tapWeight(Pixel p, Lobe lobe, bool isSpecular, Neighbour other, Stops stops)
{
    if (!other.isInRange || !isSameMaterial(p.guide.materialID, other.guide.materialID, lobe.minMaterial)) return 0.0;
    float root = softRoot(square(other.distance * stops.plane));
    // What is reflected changes with the view as well.
    root *= softRoot((isSpecular ? max(other.turned, other.seen) : other.turned) * square(stops.normal));
    if (isSpecular) root *= softRoot(square((other.guide.roughness - p.guide.roughness) * stops.roughness));
    return square(root);
}

float lumaStop(float centre, float other, Stops stops)
{
    return exp(-min(abs(other - centre) * stops.luma, stops.maxLuma) * stops.relax);
}

// doubt: the application's about the history, [0; 1].
Stops makeStops(Pixel p, Lobe lobe, bool isSpecular, float n, float confidence, float doubt)
{
    float step = float(1 << kStep);
    float share = (kIsSh ? 1.0 : g.relaxLobeAngle) / sqrt(step);
    share = mix(share, 0.99, saturate(doubt * g.relaxDoubt.z));
    // Short histories have more to gain from a wide cone than to lose.
    float settled = saturate(n / 5.0);
    Stops stops;
    float cone = isSpecular ? atan(lobeTangent(lobe.roughness, g.relaxLobeAngle)) * (10.0 - 9.0 * settled *
                                  mix(1.0, confidence, g.relaxEdgeRelaxation.y)) + g.relaxLobeAngleSlack
                            : atan(lobeTangent(1.0, mix(0.99, share, settled)));
    stops.normal = 1.0 / clamp(cone, normalEncodingError(kNormalEncoding), 1.5708);
    float admissible = mix(0.01, 1.0, saturate(lobe.roughness * g.roughnessFraction));
    stops.roughness = isSpecular && g.relaxRoughnessStop != 0u ? 1.0 / admissible : 0.0;
    stops.plane = 1.0 / (g.relaxDepthThreshold * p.viewZ);
    stops.maxLuma = isSpecular ? g.relaxMaxLumaStop.y : g.relaxMaxLumaStop.x;
    stops.relax = isSpecular && kStep <= 2 ? mix(1.0, confidence, g.relaxEdgeRelaxation.x) : 1.0;
    // Nor is a difference of few samples an edge: what filled them in would stand out as a lattice.
    stops.relax *= mix(0.1, 1.0, settled);
    stops.relax *= 1.0 - saturate(doubt * g.relaxDoubt.y);
    stops.luma = 0.0;
    return stops;
}

#endif
