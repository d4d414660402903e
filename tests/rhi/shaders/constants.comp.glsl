// Specialisation constants of every type, and a slot of a uniform buffer chosen by its dynamic offset.
#version 460
layout(local_size_x = 1) in;
layout(constant_id = 0) const bool kBool = false;
layout(constant_id = 1) const int kInt = 11;
layout(constant_id = 7) const uint kUint = 12;
layout(constant_id = 9) const float kFloat = 13.5;
layout(set = 0, binding = 0, std140) uniform Constants { uvec4 slot; } gConstants; // .x index, .y value
layout(set = 0, binding = 1, std430) writeonly buffer Out { uvec4 values[]; } gOut;

void main()
{
    uint index = gConstants.slot.x * 2;
    gOut.values[index] = uvec4(kBool ? 1 : 0, uint(kInt), kUint, floatBitsToUint(kFloat));
    gOut.values[index + 1] = gConstants.slot;
}
