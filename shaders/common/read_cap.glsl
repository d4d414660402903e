// Needs gIn_Cap, gIn_Cut.
#ifndef READ_CAP_GLSL
#define READ_CAP_GLSL
#include "history_reset.glsl"

// How bright a sample may be, per lobe. The tiles were looked at before a cut was known.
vec2 readTileCap(ivec2 tile)
{
    vec4 caps = texelFetch(gIn_Cap, tile, 0);
    return readHistoryReset() ? caps.zw : caps.xy;
}

#endif
