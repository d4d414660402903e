// What the examples denoise, and their tests with NrdIntegration: a wall in front of a camera that moves to the right,
// under noise that differs from frame to frame. And the file of their last picture.
#pragma once
#include <cstring>
#include <fstream>
#include <nrd/nrd.h>
#include <random>
#include <string>
#include <vector>

namespace example
{
constexpr uint16_t kWidth = 96, kHeight = 64; // pixels
constexpr uint32_t kFrameNum = 12;
constexpr float kDepth = 5.0f, kStep = 0.02f; // units
constexpr nrd::Identifier kIdentifier = 0;
constexpr nrd::Denoiser kDenoiser = nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR;
constexpr nrd::ResourceType kSlots[] = {
    nrd::ResourceType::IN_MV,
    nrd::ResourceType::IN_NORMAL_ROUGHNESS,
    nrd::ResourceType::IN_VIEWZ,
    nrd::ResourceType::IN_DIFF_RADIANCE_HITDIST,
    nrd::ResourceType::IN_SPEC_RADIANCE_HITDIST,
    nrd::ResourceType::OUT_DIFF_RADIANCE_HITDIST,
    nrd::ResourceType::OUT_SPEC_RADIANCE_HITDIST,
};

inline nrd::InstanceCreationDesc instanceDesc()
{
    static constexpr nrd::DenoiserDesc kDesc = {kIdentifier, kDenoiser};
    nrd::InstanceCreationDesc result;
    result.denoisers = &kDesc;
    result.denoisersNum = 1;
    result.normalEncoding = nrd::NormalEncoding::RGBA16_SNORM; // of float images
    return result;
}

inline nrd::CommonSettings settings(uint32_t frame)
{
    nrd::CommonSettings s;
    for (float* m : {s.viewToClipMatrix, s.viewToClipMatrixPrev})
    {
        m[0] = m[5] = m[10] = m[11] = 1.0f; // 45 degrees to each side, far plane at infinity
        m[14] = -0.1f;
    }
    for (float* m : {s.worldToViewMatrix, s.worldToViewMatrixPrev}) m[0] = m[5] = m[10] = m[15] = 1.0f;
    s.worldToViewMatrix[12] = -kStep * float(frame);
    s.worldToViewMatrixPrev[12] = -kStep * float(frame == 0 ? 0 : frame - 1);
    s.isMotionVectorInWorldSpace = true; // IN_MV holds the scene's own motion: zero
    for (uint16_t* size : {s.resourceSize, s.resourceSizePrev, s.rectSize, s.rectSizePrev})
        size[0] = kWidth, size[1] = kHeight;
    s.timeDeltaBetweenFrames = 16.0f; // ms; measured time would differ from run to run
    s.frameIndex = frame;
    return s;
}

/// RGBA of a slot.
inline std::vector<float> texels(nrd::ResourceType slot, uint32_t frame)
{
    std::mt19937 random(frame * 64 + static_cast<uint32_t>(slot));
    std::vector<float> result(size_t(kWidth) * kHeight * 4, 0.0f);
    for (size_t i = 0; i < result.size(); i += 4)
    {
        if (slot == nrd::ResourceType::IN_NORMAL_ROUGHNESS) result[i + 2] = -1.0f, result[i + 3] = 0.5f;
        if (slot == nrd::ResourceType::IN_VIEWZ) result[i] = kDepth;
        if (slot == nrd::ResourceType::IN_DIFF_RADIANCE_HITDIST || slot == nrd::ResourceType::IN_SPEC_RADIANCE_HITDIST)
            result[i] = random() % 4 == 0 ? 4.0f : 0.0f, result[i + 3] = 0.5f; // luma, normalised hit distance
    }
    return result;
}

inline bool isInput(nrd::ResourceType slot) { return slot < nrd::ResourceType::OUT_DIFF_RADIANCE_HITDIST; }

inline void writePicture(const std::string& path, const std::vector<float>& rgba)
{
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(rgba.data()), static_cast<std::streamsize>(rgba.size() * sizeof(float)));
}
} // namespace example
