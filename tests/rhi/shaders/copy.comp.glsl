// Copies texels of one class: 0 float, 1 int, 2 uint.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
#if CLASS == 0
layout(set = 0, binding = 0) uniform texture2D gIn;
layout(set = 0, binding = 1) uniform writeonly image2D gOut;
#elif CLASS == 1
layout(set = 0, binding = 0) uniform itexture2D gIn;
layout(set = 0, binding = 1) uniform writeonly iimage2D gOut;
#else
layout(set = 0, binding = 0) uniform utexture2D gIn;
layout(set = 0, binding = 1) uniform writeonly uimage2D gOut;
#endif

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(gOut)))) return;
    imageStore(gOut, pixel, texelFetch(gIn, pixel, 0));
}
