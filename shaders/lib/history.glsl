// Reading a reprojected history: footprints, custom bilinear weights, Catmull-Rom.
#ifndef HISTORY_GLSL
#define HISTORY_GLSL
#include "math.glsl"

// 2x2 texels round a position; vectors over the four are in the order (0,0) (1,0) (0,1) (1,1).
struct Footprint
{
    ivec2 origin;
    vec4 bilinear; // weights, sum 1
};

Footprint makeFootprint(vec2 position) // pixels
{
    vec2 corner = position - 0.5;
    vec2 origin = floor(corner);
    vec2 f = clamp(corner - origin, 0.0, 1.0);
    Footprint result;
    result.origin = ivec2(origin);
    result.bilinear = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    return result;
}

ivec2 footprintTexel(ivec2 origin, int i, ivec2 last)
{
    return clamp(origin + ivec2(i & 1, i >> 1), ivec2(0), last);
}

// 1 where the texel lies in [0; last].
vec4 footprintInside(ivec2 origin, ivec2 last)
{
    bvec2 low = greaterThanEqual(origin, ivec2(0)) , high = greaterThanEqual(origin + 1, ivec2(0));
    low = bvec2(low.x && origin.x <= last.x, low.y && origin.y <= last.y);
    high = bvec2(high.x && origin.x + 1 <= last.x, high.y && origin.y + 1 <= last.y);
    return vec4(low.x && low.y, high.x && low.y, low.x && high.y, high.x && high.y);
}

// textureGather returns (0,1) (1,1) (1,0) (0,0).
vec4 gatherOrder(vec4 g) { return g.wzxy; }
uvec4 gatherOrder(uvec4 g) { return g.wzxy; }

// Weighted mean; 0 if next to nothing is valid, and then the history length, weighted the same way, is 0 as well.
float customBilinear(vec4 values, vec4 weights)
{
    float sum = dot(weights, vec4(1.0));
    return sum < 1e-4 ? 0.0 : dot(values, weights) / sum;
}

vec4 fetchBilinear(texture2D t, ivec2 origin, vec4 weights, ivec2 last)
{
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; i++) sum += texelFetch(t, footprintTexel(origin, i, last), 0) * weights[i];
    float weightSum = dot(weights, vec4(1.0));
    return weightSum < 1e-4 ? vec4(0.0) : sum / weightSum;
}

// Catmull-Rom over 12 texels (the corners left out) by five bilinear reads, normalised by their weights.
struct CatmullRom
{
    vec4 xTaps; // positions in texture space: before, middle, after; unused
    vec4 yTaps;
    float weights[5];
};

CatmullRom makeCatmullRom(vec2 position, vec2 textureSizeInv)
{
    vec2 centre = floor(position - 0.5) + 0.5;
    vec2 f = clamp(position - centre, 0.0, 1.0);
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f));
    vec2 w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f));
    vec2 w3 = f * f * (-0.5 + 0.5 * f);
    vec2 w12 = w1 + w2; // at least 1
    vec2 middle = (centre + w2 / w12) * textureSizeInv;
    vec2 before = (centre - 1.0) * textureSizeInv;
    vec2 after = (centre + 2.0) * textureSizeInv;
    CatmullRom result;
    result.xTaps = vec4(before.x, middle.x, after.x, 0.0);
    result.yTaps = vec4(before.y, middle.y, after.y, 0.0);
    float sum = w12.x * w12.y + w12.x * (w0.y + w3.y) + w12.y * (w0.x + w3.x);
    float inv = 1.0 / max(sum, 1e-6); // the sum is near 1, never near 0
    result.weights[0] = w12.x * w0.y * inv;
    result.weights[1] = w0.x * w12.y * inv;
    result.weights[2] = w12.x * w12.y * inv;
    result.weights[3] = w3.x * w12.y * inv;
    result.weights[4] = w12.x * w3.y * inv;
    return result;
}

vec4 fetchCatmullRom(texture2D t, sampler linearClamp, CatmullRom c)
{
    return textureLod(sampler2D(t, linearClamp), vec2(c.xTaps.y, c.yTaps.x), 0.0) * c.weights[0] +
           textureLod(sampler2D(t, linearClamp), vec2(c.xTaps.x, c.yTaps.y), 0.0) * c.weights[1] +
           textureLod(sampler2D(t, linearClamp), vec2(c.xTaps.y, c.yTaps.y), 0.0) * c.weights[2] +
           textureLod(sampler2D(t, linearClamp), vec2(c.xTaps.z, c.yTaps.y), 0.0) * c.weights[3] +
           textureLod(sampler2D(t, linearClamp), vec2(c.xTaps.y, c.yTaps.z), 0.0) * c.weights[4];
}

#endif
