// How much two pixels are of one surface, for taking signals from one size to another. Textures are the caller's.
#ifndef RESAMPLING_GLSL
#define RESAMPLING_GLSL
#include "plane.glsl"

// What counts as one surface, in e-folds: off the tangent plane by a thousandth of the frustum's size, turned by so
// many radians, or of another roughness.
const float kPlaneShare = 0.001;
const float kDiffuseTurn = 0.3;
const float kMinSpecularTurn = 0.03;
const float kRoughnessShare = 0.1;

struct Surface
{
    vec3 Nv;
    float roughness;
    Plane plane;
    float turnScale; // of the specular lobe
};

vec3 viewNormal(Guide guide) { return guide.N * mat3(g.viewToWorld); } // the inverse of a rotation

// place: pixels of the signals, need not be whole.
Surface makeSurface(Guide guide, vec2 place, float viewZ)
{
    Surface s;
    s.Nv = viewNormal(guide);
    s.roughness = guide.roughness;
    vec3 Xv = reconstructViewPosition((place + 0.5) * g.rectSizeInv, g.frustum, viewZ, g.cameraDelta.w);
    s.plane = makePlane(s.Nv, Xv, kPlaneShare * getFrustumSize(viewZ));
    s.turnScale = 1.0 / max(angleOf(lobeTangent(guide.roughness, 0.5)), kMinSpecularTurn);
    return s;
}

// Weights of another pixel, for diffuse and specular light. Never 0, so that among strangers the nearest counts.
vec2 kinship(Surface s, Guide guide, vec2 place, float viewZ)
{
    float plane = planeDistance(s.plane, place, viewZ);
    float turn = angleBetween(s.Nv, viewNormal(guide));
    float roughness = abs(guide.roughness - s.roughness) * (1.0 / kRoughnessShare);
    return exp(-min(vec2(plane + turn * (1.0 / kDiffuseTurn), plane + turn * s.turnScale + roughness), 60.0));
}

// Of the lobe that a signal belongs to: first those of each lobe, then what spherical harmonics have in addition.
float lobeWeight(vec2 weights, int signal)
{
    int lobe = LOBES == 3 ? signal % 2 : LOBES - 1;
    return lobe == 0 ? weights.x : weights.y;
}

#endif
