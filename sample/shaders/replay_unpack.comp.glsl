// One output slot of a denoiser to floats: radiance and, where there is one, normalised hit distance in .w.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "nrd_frontend.glsl"
#include "replay_modes.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Slot;
layout(set = 0, binding = 1) uniform writeonly image2D gOut_Values;
layout(push_constant) uniform Constants
{
    uvec2 size; // pixels
    uint mode;  // REPLAY_UNPACK_...
}
g;

void main()
{
    uvec2 id = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(id, g.size))) return;
    vec4 data = texelFetch(gIn_Slot, ivec2(id), 0);
    bool isReblur = g.mode == REPLAY_UNPACK_REBLUR_RADIANCE;
    imageStore(gOut_Values, ivec2(id), isReblur ? REBLUR_BackEnd_UnpackRadianceAndNormHitDist(data) : data);
}
