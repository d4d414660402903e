#version 460
#extension GL_GOOGLE_include_directive : require
#include "front_end_functions.glsl"
