// Where a reflection seems to be: the thin-lens image of what a surface of given curvature reflects.
#ifndef VIRTUAL_MOTION_GLSL
#define VIRTUAL_MOTION_GLSL
#include "geometry.glsl"

const float kMaxMagnification = 5.0; // near a concave mirror's focus the image's motion has no bound

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

// A flat mirror's image of what moves.
vec3 mirrorMotion(vec3 motion, vec3 N) { return motion - 2.0 * dot(motion, N) * N; }

// Position, one frame ago, of the image. Images on the surface move with it, images far behind it stay where they are.
vec3 virtualPosition(Reflector r, float hitDist, float curvature)
{
    float along = imageDistance(r, hitDist, curvature);
    float share = saturate(abs(along) / (hitDist + kEps));
    return mix(r.Xprev, r.X, share) - along * r.V;
}

// Previous position minus now of the image of what moves by itself: mirrored, times the image's lateral magnification,
// which is 1 if flat, less if convex, negative where it is upside down. Along the view direction its square would be
// right, which no screen shows. The lobe's width counts too: a rough surface has no image.
vec3 imageMotion(Reflector r, float hitDist, float curvature, vec3 motion)
{
    float magnification = imageDistance(r, hitDist, curvature) / (hitDist + kEps);
    return clamp(magnification, -kMaxMagnification, kMaxMagnification) * mirrorMotion(motion, r.N);
}

// Curvature from a second point of the surface and its normal; convex > 0.
float curvatureFromEdge(vec3 X, vec3 N, vec3 otherX, vec3 otherN)
{
    vec3 edge = otherX - X;
    float lengthSquared = dot(edge, edge);
    return lengthSquared > 1e-20 ? dot(otherN - N, edge) / lengthSquared : 0.0;
}

#endif
