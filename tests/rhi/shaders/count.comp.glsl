// Counts workgroups, and the largest index in each dimension.
#version 460
layout(local_size_x = 1) in;
layout(set = 0, binding = 0, std430) buffer Out { uint count; uint maxX; uint maxY; uint maxZ; } gOut;

void main()
{
    atomicAdd(gOut.count, 1);
    atomicMax(gOut.maxX, gl_WorkGroupID.x);
    atomicMax(gOut.maxY, gl_WorkGroupID.y);
    atomicMax(gOut.maxZ, gl_WorkGroupID.z);
}
