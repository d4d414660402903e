// Which lobes of the primary surface a frame traces in a pixel.
#ifndef LOBE_CHOICE_GLSL
#define LOBE_CHOICE_GLSL
#include "bsdf.glsl"
#include "checkerboard.glsl"

layout(constant_id = 6) const bool kIsProbabilistic = false; // one of the two lobes by chance
layout(constant_id = 7) const uint kCheckerboardMode = 0u;   // nrd::CheckerboardMode, not together with the above
layout(constant_id = 10) const bool kIsMerged = false;       // both lobes by one path, not together with either

struct LobeChoice
{
    uint lobes;  // to trace
    float scale; // of their radiance: 1 / probability of the choice
};

// Order of the pixels of a 4x4 tile, [0; 15]: k consecutive ones, around the end too, are as far apart as they can be,
// so that four of them leave no 3x3 window without one.
uint bayer4x4(uvec2 pixel)
{
    uvec2 p = pixel & 3u;
    uint odd = p.x ^ p.y;
    return ((odd & 1u) << 3) | ((p.y & 1u) << 2) | (odd & 2u) | ((p.y & 2u) >> 1);
}

// Uniform in [0; 1) over frames: the golden ratio's multiples, the same for the whole screen, shift the pattern.
float lobeThreshold(ivec2 pixel, uint frameIndex)
{
    return toUnit((bayer4x4(uvec2(pixel)) << 28) + frameIndex * 0x9E3779B9u);
}

LobeChoice chooseLobes(Surface s, Bsdf b, ivec2 pixel, uint frameIndex)
{
    if (kIsMerged) return LobeChoice(kDiffuseLobe | kSpecularLobe, 1.0);
    bool hasDiffuse = brightest(s.albedo) > 0.0;
    uint all = hasDiffuse ? kDiffuseLobe | kSpecularLobe : kSpecularLobe;
    if (kCheckerboardMode != 0u)
    {
        bool isDiffuse = hasCheckerboardSample(pixel, frameIndex, kCheckerboardMode, true);
        return LobeChoice(all & (isDiffuse ? kDiffuseLobe : kSpecularLobe), 1.0);
    }
    if (!kIsProbabilistic || !hasDiffuse) return LobeChoice(all, 1.0);
    float specularShare = clamp(b.specularShare, 0.25, 0.75);
    bool isSpecular = lobeThreshold(pixel, frameIndex) < specularShare;
    return isSpecular ? LobeChoice(kSpecularLobe, 1.0 / specularShare)
                      : LobeChoice(kDiffuseLobe, 1.0 / (1.0 - specularShare));
}
#endif
