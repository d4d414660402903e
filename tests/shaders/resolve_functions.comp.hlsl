#include "resolve_functions.glsl"
