// History at another size: a side that has grown keeps its texels where they are and gains zeros, one that has shrunk
// takes the nearest of the old ones; never a mean, as texels are packed and belong together across textures.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform TEXTURE gPrev_History;
layout(set = 0, binding = 1) uniform writeonly IMAGE gOut_History;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(gOut_History);
    if (any(greaterThanEqual(pixel, size))) return;
    ivec2 sizePrev = textureSize(gPrev_History, 0);
    vec2 scale = max(vec2(sizePrev) / vec2(size), 1.0);
    ivec2 pixelPrev = ivec2((vec2(pixel) + 0.5) * scale);
    bool isKept = all(lessThan(pixelPrev, sizePrev));
    imageStore(gOut_History, pixel, isKept ? texelFetch(gPrev_History, pixelPrev, 0) : TEXEL(0));
}
