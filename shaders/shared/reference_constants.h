// Constants of the progressive mean.
#ifndef REFERENCE_CONSTANTS_H
#define REFERENCE_CONSTANTS_H
#include "shared_types.h"

SHARED_BEGIN
struct ReferenceConstants
{
    vec2 rectSize;        // pixels
    float splitScreen;
    float weight;         // 1 / (1 + frames already in the mean); 1 replaces the history
};
SHARED_END

#endif
