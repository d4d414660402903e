// Constants of the history confidence. World positions have their origin at the current camera.
#ifndef CONFIDENCE_CONSTANTS_H
#define CONFIDENCE_CONSTANTS_H
#include "shared_types.h"

SHARED_BEGIN
struct ConfidenceConstants
{
    mat4 viewToWorldPrev;
    vec4 frustumPrev;     // .xy slopes of the top left corner, .zw extent: Xv.xy = (xy + uv * zw) * z
    vec2 rectSizePrev;    // tiles of the last frame, whose samples were traced again
    vec2 outputSizeInv;   // 1 / tiles of the resource
    float isOrthographic; // 1: rays are parallel
    float planeDistance;  // world units at z = 1, or at any z if orthographic
    float denoisingRange;
    float viewZScale;
    float minLuminance;
    float maxLuminance;
    float tolerance;
    float sensitivity;
    uint isHistoryReset; // 1: there is no last frame
};
SHARED_END

#endif
