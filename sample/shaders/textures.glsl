// Material textures out of one texel buffer: bilinear, one mip chosen by the caller.
#ifndef TEXTURES_GLSL
#define TEXTURES_GLSL
#include "scene_data.glsl"

const int kBaseColor = 0;
const int kMetallicRoughness = 1;
const int kNormal = 2;
const int kEmissive = 3;
const uint kNoTexture = 0xFFFFFFFFu;

// Wrap modes: 0 repeat, 1 clamp, 2 mirror.
int wrap(int x, int size, uint mode)
{
    int period = mode == 2u ? 2 * size : size;
    int r = x - period * int(floor(float(x) / float(period)));
    r = mode == 2u && r >= size ? 2 * size - 1 - r : r;
    return clamp(mode == 1u ? x : r, 0, size - 1);
}

vec2 texCoordOf(int triangle, uint set, vec2 b)
{
    vec2 c[3];
    for (int i = 0; i < 3; ++i)
    {
        uvec4 v = texelFetch(gVertices, 6 * triangle + 2 * i + int(set));
        c[i] = uintBitsToFloat(set == 0u ? v.zw : v.xy);
    }
    return c[0] * (1.0 - b.x - b.y) + c[1] * b.x + c[2] * b.y;
}

// Texture slot `slot` of a material at a hit. `logWidth` is log2 of the ray's width in units of texture coordinates.
vec4 fetchTexture(int triangle, int material, int slot, vec2 barycentrics, float logWidth)
{
    int at = 16 * material + 3 + 3 * slot;
    uvec4 head = texelFetch(gMaterials, at);
    if (head.x == kNoTexture) return vec4(1.0);
    vec4 turn = uintBitsToFloat(texelFetch(gMaterials, at + 1));
    vec2 shift = uintBitsToFloat(texelFetch(gMaterials, at + 2).xy);
    uint flags = head.w;
    vec2 uv = texCoordOf(triangle, (flags >> 4) & 1u, barycentrics);
    uv = vec2(dot(turn.xy, uv), dot(turn.zw, uv)) + shift;
    ivec2 size = ivec2(head.y, head.z);
    // Half a level sharper than one texel per pixel: nearest mip, no blend between two.
    int level = clamp(int(logWidth + 0.5 * log2(float(size.x) * float(size.y))), 0, int(flags >> 8) - 1);
    int first = int(head.x);
    for (int i = 0; i < level; ++i)
    {
        first += size.x * size.y;
        size = max(size >> 1, ivec2(1));
    }
    uv = clamp(uv, vec2(-1e4), vec2(1e4)) * vec2(size) - 0.5;
    ivec2 base = ivec2(floor(uv));
    vec2 f = uv - vec2(base);
    int x0 = wrap(base.x, size.x, flags & 3u), x1 = wrap(base.x + 1, size.x, flags & 3u);
    int y0 = first + size.x * wrap(base.y, size.y, (flags >> 2) & 3u);
    int y1 = first + size.x * wrap(base.y + 1, size.y, (flags >> 2) & 3u);
    vec4 top = mix(texelFetch(gTexels, y0 + x0), texelFetch(gTexels, y0 + x1), f.x);
    vec4 bottom = mix(texelFetch(gTexels, y1 + x0), texelFetch(gTexels, y1 + x1), f.x);
    return mix(top, bottom, f.y);
}

vec3 srgbToLinear(vec3 c)
{
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

vec4 colorOf(int triangle, vec2 b)
{
    vec4 c0 = unpackUnorm4x8(texelFetch(gVertices, 6 * triangle + 1).z);
    vec4 c1 = unpackUnorm4x8(texelFetch(gVertices, 6 * triangle + 3).z);
    vec4 c2 = unpackUnorm4x8(texelFetch(gVertices, 6 * triangle + 5).z);
    return c0 * (1.0 - b.x - b.y) + c1 * b.x + c2 * b.y;
}

// Of a blended surface: what is not there has no colour either, so the tint comes with the alpha.
vec3 fetchTransmittance(int triangle, int material, vec2 barycentrics)
{
    vec4 color = uintBitsToFloat(texelFetch(gMaterials, 16 * material));
    if (kHasTextures)
    {
        vec4 texel = fetchTexture(triangle, material, kBaseColor, barycentrics, -20.0);
        color *= vec4(srgbToLinear(texel.rgb), texel.a) * colorOf(triangle, barycentrics);
    }
    // Glass is all there.
    if (kHasGlass && texelFetch(gMaterials, 16 * material + 15).y != 0u) return color.rgb;
    return (1.0 - color.a) * mix(vec3(1.0), color.rgb, min(4.0 * color.a, 1.0));
}

float fetchAlpha(int triangle, int material, vec2 barycentrics)
{
    float factor = uintBitsToFloat(texelFetch(gMaterials, 16 * material).w);
    vec4 texel = fetchTexture(triangle, material, kBaseColor, barycentrics, -20.0);
    return factor * texel.a * colorOf(triangle, barycentrics).a;
}
#endif
