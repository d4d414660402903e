// Motion: where a surface was, on screen and in space.
#ifndef MOTION_GLSL
#define MOTION_GLSL
#include "denoiser.glsl"

struct Motion
{
    vec2 uv;    // on the previous screen
    vec3 Xprev; // origin at the current camera
};

// What IN_MV says of a pixel, in units; on screen z is a difference of what IN_VIEWZ stores, which has either sign.
vec3 readMotion(texture2D t, texture2D viewZ, ivec2 pixel)
{
    vec3 mv = texelFetch(t, guideTexel(pixel), 0).xyz * g.motionVectorScale.xyz;
    bool isOnScreen = g.motionVectorScale.w == 0.0;
    if (isOnScreen && texelFetch(viewZ, guideTexel(pixel), 0).x < 0.0) mv.z = -mv.z;
    return mv;
}

// X: position now; mv: from readMotion().
Motion followMotion(vec2 uv, float viewZ, vec3 X, vec3 mv)
{
    Motion motion;
    if (g.motionVectorScale.w != 0.0)
    {
        motion.Xprev = X + mv;
        motion.uv = projectToUv(g.worldToClipPrev, motion.Xprev);
        return motion;
    }
    motion.uv = uv + mv.xy;
    // 2D motion knows no depth: the surface is taken as static.
    float viewZPrev = g.motionVectorScale.z != 0.0 ? viewZ + mv.z : transform(g.worldToViewPrev, X).z;
    vec3 Xv = reconstructViewPosition(motion.uv, g.frustumPrev, max(viewZPrev, 1e-4), g.cameraDelta.w);
    motion.Xprev = transform(g.viewToWorldPrev, Xv);
    return motion;
}

#endif
