// Where a reflection seems to be: the thin-lens image of what a surface of given curvature reflects.
#ifndef VIRTUAL_MOTION_GLSL
#define VIRTUAL_MOTION_GLSL
#include "geometry.glsl"

struct Reflector
{
    vec3 X;         // now
    vec3 Xprev;     // the same point one frame ago
    vec3 N;
    vec3 V;
    float factor;   // dominantFactor()
    float NoD;      // cosine between normal and dominant direction
    float NoV;
    float distanceToCamera;
};

// Distance of the image from the surface, positive behind it. curvature: convex > 0. Flat: the hit distance itself.
float imageDistance(Reflector r, float hitDist, float curvature)
{
    float depth = -abs(r.NoD) * hitDist;
    float denominator = 2.0 * curvature * depth - 1.0;
    // At the focal point the image is at infinity: no position, so it is treated as flat.
    if (abs(denominator) < 1e-3) denominator = -1.0;
    // Without the second factor convex silhouettes smear.
    float silhouette = 1.0 + r.distanceToCamera * saturate(1.0 - r.NoV) * max(curvature, 0.0);
    return -r.factor * hitDist / (denominator * silhouette);
}

// Position, one frame ago, of the image. Images on the surface move with it, images far behind it stay where they are.
vec3 virtualPosition(Reflector r, float hitDist, float curvature)
{
    float along = imageDistance(r, hitDist, curvature);
    float share = saturate(abs(along) / (hitDist + kEps));
    return mix(r.Xprev, r.X, share) - along * r.V;
}

// Curvature from a second point of the surface and its normal; convex > 0.
float curvatureFromEdge(vec3 X, vec3 N, vec3 otherX, vec3 otherN)
{
    vec3 edge = otherX - X;
    float lengthSquared = dot(edge, edge);
    return lengthSquared > 1e-20 ? dot(otherN - N, edge) / lengthSquared : 0.0;
}

#endif
