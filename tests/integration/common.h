// What the tests over the recording device and those on a GPU share.
#pragma once
#include "catch.h"
#include <nrd/integration.h>
#include <string>

namespace test
{
/// A camera at the origin that never moves, so that REFERENCE goes on counting.
inline nrd::CommonSettings stillCamera(uint32_t width, uint32_t height, uint32_t frameIndex)
{
    nrd::CommonSettings result;
    for (float* matrix : {result.worldToViewMatrix, result.worldToViewMatrixPrev})
        for (int i = 0; i < 4; i++) matrix[i * 5] = 1.0f;
    for (float* matrix : {result.viewToClipMatrix, result.viewToClipMatrixPrev})
    {
        matrix[0] = matrix[5] = matrix[11] = 1.0f;
        matrix[14] = 0.1f;
    }
    for (uint16_t* size : {result.resourceSize, result.resourceSizePrev, result.rectSize, result.rectSizePrev})
    {
        size[0] = static_cast<uint16_t>(width);
        size[1] = static_cast<uint16_t>(height);
    }
    result.timeDeltaBetweenFrames = 16.0f;
    result.frameIndex = frameIndex;
    return result;
}

inline void require(nrd::Result result, const nrd::NrdIntegration& integration)
{
    INFO(integration.GetLastMessage());
    REQUIRE(result == nrd::Result::SUCCESS);
}

/// The call is refused with INVALID_ARGUMENT and this sentence.
inline void requireRefusal(nrd::Result result, const nrd::NrdIntegration& integration, const std::string& sentence)
{
    CHECK(result == nrd::Result::INVALID_ARGUMENT);
    REQUIRE(integration.GetLastMessage() == sentence);
}
} // namespace test
