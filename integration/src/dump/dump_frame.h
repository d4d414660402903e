// One frame of a dump: what the application said of it, and its images turned into what the capture format records,
// physical units without any denoiser's packing.
#pragma once
#include "exr_writer.h"
#include <nrd/nrd.h>

namespace nrd::dump
{
/// Of the call that used a slot.
struct SlotContext
{
    ResourceType type = ResourceType::MAX_NUM;
    Denoiser denoiser = Denoiser::MAX_NUM;
    HitDistanceParameters hitDistanceParameters = {}; // REBLUR only
    uint32_t width = 0, height = 0;                   // of the image
};

struct FrameContext
{
    CommonSettings common = {};
    NormalEncoding normalEncoding = NormalEncoding::R10_G10_B10_A2_UNORM;
    RoughnessEncoding roughnessEncoding = RoughnessEncoding::LINEAR;
    HitDistanceParameters hitDistanceParameters = {};
    bool hasLight = false; // SIGMA ran
    SigmaSettings light = {};
};

/// The capture format has a place for the slot.
bool isRecorded(ResourceType type);

/// Copied texels of one slot, four floats each, rows of the image.
struct SlotTexels
{
    SlotContext context;
    const float* texels;
};

/// The channels of frame_NNNN.exr over the active rectangle. What the format cannot hold is told in `notes`.
Channels unpackFrame(const FrameContext& frame, const std::vector<SlotTexels>& slots, std::vector<std::string>& notes);
} // namespace nrd::dump
