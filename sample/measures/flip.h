// LDR-FLIP: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", HPG 2020.
#pragma once
#include "picture.h"

namespace sample
{
inline constexpr double kFlipPixelsPerDegree =
    67.0206432766; // "67": 3840 * pi / 180, the paper's 0.7 m wide 4K screen at 0.7 m

// Error per pixel in [0; 1] of two linear RGB pictures of equal size with values in [0; 1]; symmetric in the two.
std::vector<float> flipMap(const Picture& reference, const Picture& test,
                           double pixelsPerDegree = kFlipPixelsPerDegree);
} // namespace sample
