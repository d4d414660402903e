// Fills an unsigned texture with a value.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kValue = 1;
layout(set = 0, binding = 0) uniform writeonly uimage2D gOut;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, imageSize(gOut)))) imageStore(gOut, pixel, uvec4(kValue));
}
