#include "front_end_functions.glsl"
