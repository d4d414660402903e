// Needs gIn_Cut.
#ifndef HISTORY_RESET_GLSL
#define HISTORY_RESET_GLSL
#include "cut.glsl"

// Announced by the application or seen by the device.
bool readHistoryReset() { return g.isHistoryReset != 0u || isCut(texelFetch(gIn_Cut, ivec2(0), 0).x); }

shared uint sIsReset;

// By one invocation, before a barrier: what is asked for again and again would take a register all the way.
void shareHistoryReset() { sIsReset = readHistoryReset() ? 1u : 0u; }

// A processor, which suspends every invocation at a barrier, has none.
bool isHistoryReset() { return kIsSoftware ? readHistoryReset() : sIsReset != 0u; }

#endif
