// One texel read, one written: what the device moves at best when a compute shader does it.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Source;
layout(set = 0, binding = 1) uniform writeonly image2D gOut_Target;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy); // the grid covers the image exactly
    imageStore(gOut_Target, pixel, texelFetch(gIn_Source, pixel, 0));
}
