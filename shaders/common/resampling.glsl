// How much two pixels are of one surface, for taking signals from one size to another. Textures are the caller's.
#ifndef RESAMPLING_GLSL
#define RESAMPLING_GLSL
#include "denoiser.glsl"

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
    float planeStart; // dot(Nv, Xv)
    float planeScale; // 1 / admissible distance from the plane
    float turnScale;  // of the specular lobe
};

// Of a place in pixels of the signals, which need not be whole.
vec3 positionAt(vec2 place, float viewZ)
{
    return reconstructViewPosition((place + 0.5) * g.rectSizeInv, g.frustum, viewZ, g.cameraDelta.w);
}

vec3 viewNormal(Guide guide) { return guide.N * mat3(g.viewToWorld); } // the inverse of a rotation

Surface makeSurface(Guide guide, vec2 place, float viewZ)
{
    Surface s;
    s.Nv = viewNormal(guide);
    s.roughness = guide.roughness;
    s.planeStart = dot(s.Nv, positionAt(place, viewZ));
    s.planeScale = 1.0 / (kPlaneShare * getFrustumSize(viewZ));
    s.turnScale = 1.0 / max(angleOf(lobeTangent(guide.roughness, 0.5)), kMinSpecularTurn);
    return s;
}

// Weights of another pixel, for diffuse and specular light. Never 0, so that among strangers the nearest counts.
vec2 kinship(Surface s, Guide guide, vec2 place, float viewZ)
{
    float plane = abs(dot(s.Nv, positionAt(place, viewZ)) - s.planeStart) * s.planeScale;
    float turn = angleBetween(s.Nv, viewNormal(guide));
    float roughness = abs(guide.roughness - s.roughness) * (1.0 / kRoughnessShare);
    return exp(-min(vec2(plane + turn * (1.0 / kDiffuseTurn), plane + turn * s.turnScale + roughness), 60.0));
}

// Of the lobe that a signal belongs to: first those of each lobe, then what spherical harmonics have in addition.
float lobeWeight(vec2 weights, int signal) { return (LOBES == 3 ? signal % 2 : LOBES - 1) == 0 ? weights.x : weights.y; }

#endif
