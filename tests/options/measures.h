// What the tests look at in a frame's outputs.
#pragma once
#include "runner.h"

namespace options
{
// Root mean square distance of an output's signal from its mean, over what is in range; hit distances beside a
// radiance are left out.
double signalError(const Result& result, nrd::ResourceType output);
double noisyError(const Result& result, nrd::ResourceType output); // of the input, the same way
double signalMean(const Result& result, nrd::ResourceType output); // of luma, or occlusion

double hitDistError(const Result& result, nrd::ResourceType output); // of the channel w

// Texels in the rectangle and in range that are not finite; texels elsewhere that were written.
size_t countBroken(const Result& result);
size_t countStray(const Result& result);
size_t countDifferent(const Result& a, const Result& b); // in-range texels that are not equal bit for bit
double worstDifference(const Result& a, const Result& b);

// Calls visit(pixel, texel) for everything in the rectangle that is in range.
template <class Visit> void forEachPixel(const Frame& frame, Visit&& visit)
{
    for (int y = 0; y < frame.rect.y; y++)
        for (int x = 0; x < frame.rect.x; x++)
            if (frame.isInRange(x, y)) visit(frame.pixel(x, y), frame.texel(x, y));
}
} // namespace options
