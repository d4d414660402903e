// An image of any format as floats, row by row, for the host.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Image;
layout(set = 0, binding = 1, std430) writeonly buffer Texels { vec4 gOut_Texels[]; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(gIn_Image, 0);
    if (any(greaterThanEqual(pixel, size))) return;
    gOut_Texels[pixel.y * size.x + pixel.x] = texelFetch(gIn_Image, pixel, 0);
}
