#include "shadow_functions.glsl"
