// A jittered picture blended into the reprojected history, which is held to the range of the new picture's neighbours
// (Karis 2014, "High Quality Temporal Supersampling"; variance clipping: Salvi 2016).
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Composed; // linear
layout(set = 0, binding = 1) uniform texture2D gIn_History;
layout(set = 0, binding = 2) uniform texture2D gIn_ViewZ;
layout(set = 0, binding = 3) uniform texture2D gIn_Motion; // previous minus current position, world space
layout(set = 0, binding = 4) uniform writeonly image2D gOut_Result;
layout(push_constant) uniform Constants
{
    vec4 viewToClipBefore[3];   // rows of x, y and w
    vec4 motionToClipBefore[3];
    vec2 tanHalfFov;
    uvec2 size;
    uint isCut;
};

const float kNew = 0.1;    // share of the new picture
const float kWidth = 1.25; // standard deviations that the history may be off

float luma(vec3 c)
{
    return dot(c, vec3(0.25, 0.5, 0.25));
}

// Bright samples would otherwise win every mean; inverse of each other.
vec3 compress(vec3 c)
{
    return c / (1.0 + luma(c));
}

vec3 expand(vec3 c)
{
    return c / max(1.0 - luma(c), 1e-4); // the filter overshoots
}

vec3 toYCoCg(vec3 c)
{
    return vec3(luma(c), 0.5 * (c.r - c.b), 0.5 * c.g - 0.25 * (c.r + c.b));
}

vec3 fromYCoCg(vec3 c)
{
    float t = c.x - c.z;
    return vec3(t + c.y, c.x + c.z, t - c.y);
}

ivec2 inside(ivec2 pixel)
{
    return clamp(pixel, ivec2(0), ivec2(size) - 1);
}

// NaN must not stay in the history for ever.
vec3 compressed(ivec2 pixel)
{
    vec3 c = compress(max(texelFetch(gIn_Composed, inside(pixel), 0).rgb, vec3(0.0)));
    return any(isnan(c)) || any(isinf(c)) ? vec3(0.0) : toYCoCg(c);
}

// Where the pixel was, in pixels. Of the nearest surface around, so that edges take their background's history along.
vec2 positionBefore(ivec2 pixel)
{
    ivec2 nearest = pixel;
    float viewZ = texelFetch(gIn_ViewZ, pixel, 0).x;
    for (int i = 0; i < 9; ++i)
    {
        ivec2 other = inside(pixel + ivec2(i % 3, i / 3) - 1);
        float z = texelFetch(gIn_ViewZ, other, 0).x;
        nearest = z > viewZ ? other : nearest; // view z is negative
        viewZ = max(viewZ, z);
    }
    vec2 ndc = (2.0 * (vec2(pixel) + 0.5) / vec2(size) - 1.0) * vec2(1.0, -1.0);
    vec4 position = vec4(ndc * tanHalfFov * -viewZ, viewZ, 1.0);
    vec3 motion = texelFetch(gIn_Motion, nearest, 0).xyz;
    vec3 clip;
    for (int i = 0; i < 3; ++i) clip[i] = dot(viewToClipBefore[i], position) + dot(motionToClipBefore[i].xyz, motion);
    vec2 uv = clip.z > 1e-6 ? vec2(0.5, -0.5) * clip.xy / clip.z + 0.5 : vec2(-1.0); // behind the camera
    return uv * vec2(size);
}

// Weights of Catmull and Rom's spline: bilinear reads would blur the history a little more in every frame.
vec4 splineWeights(float f)
{
    float f2 = f * f, f3 = f2 * f;
    return vec4(-0.5 * f3 + f2 - 0.5 * f, 1.5 * f3 - 2.5 * f2 + 1.0, -1.5 * f3 + 2.0 * f2 + 0.5 * f, 0.5 * (f3 - f2));
}

vec3 historyAt(vec2 position)
{
    vec2 at = position - 0.5;
    ivec2 base = ivec2(floor(at));
    vec4 x = splineWeights(at.x - float(base.x)), y = splineWeights(at.y - float(base.y));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 16; ++i)
    {
        vec3 c = compress(texelFetch(gIn_History, inside(base + ivec2(i & 3, i >> 2) - 1), 0).rgb);
        sum += toYCoCg(c) * (x[i & 3] * y[i >> 2]);
    }
    return sum;
}

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec3 now = compressed(pixel), mean = vec3(0.0), square = vec3(0.0);
    for (int i = 0; i < 9; ++i)
    {
        vec3 c = compressed(pixel + ivec2(i % 3, i / 3) - 1);
        mean += c / 9.0;
        square += c * c / 9.0;
    }
    vec2 before = positionBefore(pixel);
    bool isNew = isCut != 0u || any(lessThan(before, vec2(0.0))) || any(greaterThan(before, vec2(size)));
    vec3 reach = kWidth * sqrt(max(square - mean * mean, vec3(0.0)));
    vec3 history = isNew ? now : clamp(historyAt(before), mean - reach, mean + reach);
    vec3 result = fromYCoCg(mix(history, now, kNew));
    imageStore(gOut_Result, pixel, vec4(expand(max(result, vec3(0.0))), 1.0));
}
