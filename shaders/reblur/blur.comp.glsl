// First recurrent blur: its result is the history, but for occlusion, which is blurred twice.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#define IS_POST_BLUR 0
#include "blur_pass.glsl"
