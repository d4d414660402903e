// An image as a picture for the screen; left of the split that of the first side, right of it the second's.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "view_modes.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Left;
layout(set = 0, binding = 1) uniform texture2D gIn_Right;
layout(set = 0, binding = 2) uniform texture2D gIn_LeftOver; // overlay, or what the difference is taken from
layout(set = 0, binding = 3) uniform texture2D gIn_RightOver;
layout(set = 0, binding = 4) uniform writeonly image2D gOut_Picture;
layout(push_constant) uniform Constants
{
    uvec2 size;     // pixels
    ivec2 picked;   // a frame is drawn round this pixel; negative: none
    uint mode;      // VIEW_...
    uint tone;      // TONE_...
    float exposure; // radiance is multiplied by it
    float range;    // what small values are multiplied by
    int split;      // the first column of the right side; from size.x on there is none
};

vec3 encodeSrgb(vec3 x)
{
    return mix(12.92 * x, 1.055 * pow(max(x, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308)));
}

vec3 toneMap(vec3 radiance)
{
    vec3 x = max(radiance * exposure, vec3(0.0));
    if (tone == TONE_COMPRESS) x = x / (1.0 + x);
    if (tone == TONE_FILMIC) x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    return encodeSrgb(clamp(x, 0.0, 1.0));
}

vec3 colorOf(uint id)
{
    return id == 0u ? vec3(0.15) : 0.5 + 0.5 * cos(6.2832 * (float(id) * 0.61803 + vec3(0.0, 0.33, 0.67)));
}

vec3 picture(vec4 value, vec4 over)
{
    switch (mode)
    {
    case VIEW_VALUE:
        return value.rgb;
    case VIEW_SIGNED:
        return 0.5 + 0.5 * value.rgb;
    case VIEW_W:
        return vec3(value.w * range);
    case VIEW_X:
        return value.xxx * range;
    case VIEW_DEPTH:
        return vec3(1.0 / (1.0 + abs(value.x) * range));
    case VIEW_MOTION:
        return 0.5 + value.rgb * range;
    case VIEW_ID:
        return colorOf(uint(value.w + 0.5));
    case VIEW_DIFFERENCE:
        return abs(toneMap(value.rgb) - toneMap(over.rgb)) * range;
    case VIEW_OVERLAY:
        return mix(toneMap(value.rgb), over.rgb, over.a);
    default:
        return toneMap(value.rgb);
    }
}

// An image of another size fills the picture, too.
vec4 fetch(texture2D image, ivec2 pixel)
{
    return texelFetch(image, pixel * textureSize(image, 0) / ivec2(size), 0);
}

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool isRight = pixel.x >= split;
    vec4 value = isRight ? fetch(gIn_Right, pixel) : fetch(gIn_Left, pixel);
    vec4 over = isRight ? fetch(gIn_RightOver, pixel) : fetch(gIn_LeftOver, pixel);
    vec3 color = clamp(picture(value, over), 0.0, 1.0);
    if (pixel.x == split) color = vec3(1.0);
    ivec2 away = abs(pixel - picked);
    if (all(greaterThanEqual(picked, ivec2(0))) && max(away.x, away.y) == 3) color = vec3(1.0, 0.9, 0.0);
    imageStore(gOut_Picture, pixel, vec4(color, 1.0));
}
