// Needs gIn_Cut.
#ifndef HISTORY_RESET_GLSL
#define HISTORY_RESET_GLSL
#include "denoiser.glsl"

// Announced by the application or seen by the device.
bool isHistoryReset()
{
    return g.isHistoryReset != 0u || (g.isCutDetected != 0u && texelFetch(gIn_Cut, ivec2(0), 0).x > 0.5);
}

#endif
