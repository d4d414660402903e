// One step of a chain in a storage buffer: order and repetitions show in the result.
#version 460
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kAddend = 1;
layout(set = 0, binding = 0, std430) buffer Data { uint values[]; } gData;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < gData.values.length()) gData.values[i] = gData.values[i] * 3 + kAddend;
}
