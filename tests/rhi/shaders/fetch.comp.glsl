// What a shader sees of the texels, as 32-bit components.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
#if CLASS == 0
layout(set = 0, binding = 0) uniform texture2D gIn;
#define BITS(v) floatBitsToUint(v)
#elif CLASS == 1
layout(set = 0, binding = 0) uniform itexture2D gIn;
#define BITS(v) uvec4(v)
#else
layout(set = 0, binding = 0) uniform utexture2D gIn;
#define BITS(v) (v)
#endif
layout(set = 0, binding = 1, std430) writeonly buffer Out { uvec4 texels[]; } gOut;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(gIn, 0);
    if (any(greaterThanEqual(pixel, size))) return;
    gOut.texels[pixel.y * size.x + pixel.x] = BITS(texelFetch(gIn, pixel, 0));
}
