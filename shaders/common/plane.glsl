// Distance of other pixels' surfaces from a pixel's tangent plane, affine in the pixel: a few instructions each.
#ifndef PLANE_GLSL
#define PLANE_GLSL
#include "denoiser.glsl"

struct Plane
{
    vec3 slope;  // what is taken for a position and 1, to be scaled by depth
    float depth; // for depth
    float start;
};

// Through Xv with normal Nv, both in view space; distances are in multiples of `unit`.
Plane makePlane(vec3 Nv, vec3 Xv, float unit)
{
    bool isOrtho = g.cameraDelta.w != 0.0;
    vec3 N = Nv / unit;
    vec2 step = N.xy * g.frustum.zw * g.rectSizeInv;
    Plane plane;
    plane.slope = vec3(step, dot(N.xy, g.frustum.xy) + 0.5 * (step.x + step.y) + (isOrtho ? 0.0 : N.z));
    plane.depth = isOrtho ? N.z : 0.0;
    plane.start = dot(N, Xv);
    return plane;
}

// position: pixels; centres of pixels are whole numbers.
float planeDistance(Plane plane, vec2 position, float viewZ)
{
    float slope = plane.slope.x * position.x + (plane.slope.y * position.y + plane.slope.z);
    return abs(slope * (g.cameraDelta.w != 0.0 ? 1.0 : viewZ) + (plane.depth * viewZ - plane.start));
}

#endif
