// Writes mip 0 from mips 1-4 of the same texture, which the view numbers 0-3.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform utexture2D gCoarse;
layout(set = 0, binding = 1) uniform writeonly uimage2D gFine;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(gFine)))) return;
    uint sum = 0;
    for (int lod = 0; lod < 4; lod++) sum = sum * 16 + texelFetch(gCoarse, pixel >> (lod + 1), lod).x;
    imageStore(gFine, pixel, uvec4(sum));
}
