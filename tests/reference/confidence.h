// History confidence from samples of tiles that were traced again.
#pragma once
#include "vectors.h"
#include <cstddef>
#include <vector>

namespace nrdtest
{
// Of a tile of last frame's screen.
struct ConfidenceTile
{
    glm::dvec3 stored, retraced; // luminance of diffuse and specular, view depth
    glm::dvec3 position;         // of what was stored
    glm::dvec3 normal;
};

struct ConfidenceInput
{
    int width = 0, height = 0;
    std::vector<ConfidenceTile> tiles; // row by row
    double planeDistance = 0.0;        // tolerated at a depth of 1
    double denoisingRange = 0.0;
    double sensitivity = 0.0, tolerance = 0.0, minLuminance = 0.0, maxLuminance = 0.0;
    int blurPassNum = 0;
};

// Of diffuse and specular.
std::vector<glm::dvec2> confidences(const ConfidenceInput& input);
} // namespace nrdtest
