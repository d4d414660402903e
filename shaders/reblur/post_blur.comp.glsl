// Second recurrent blur, of occlusion, which nothing stabilises: its result is history and output.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#define IS_POST_BLUR 1
#include "blur_pass.glsl"
