// Cuts: no frame may show what was there before.
#include "catch.h"
#include "harness.h"
#include "noise.h"

using namespace quality;

namespace
{
constexpr int kWidth = 80, kHeight = 48;
constexpr size_t kCount = kWidth * kHeight;

Frame noisyFrame(int frame, float mean)
{
    return {renderGuides(makeCamera(frame, 0.05f, kWidth, kHeight), kWidth, kHeight),
            makeNoise(kCount, mean, unsigned(frame)), makeNoise(kCount, mean, unsigned(frame + 50))};
}

// Frames after `restart` frames of something else, against a fresh instance given the same frame indices.
void checkAgainstFresh(nrd::AccumulationMode mode)
{
    Harness used(kWidth, kHeight), fresh(kWidth, kHeight);
    for (int frame = 0; frame < 8; frame++) used.denoise(noisyFrame(frame, 50.0f));
    for (int frame = 8; frame < 12; frame++)
    {
        const Frame input = noisyFrame(frame, 1.0f);
        used.denoise(input,
                     [&](nrd::CommonSettings& common)
                     {
                         if (frame == 8) common.accumulationMode = mode;
                     });
        fresh.denoise(input, [&](nrd::CommonSettings& common) { common.frameIndex = static_cast<uint32_t>(frame); });
        INFO("frame " << frame);
        size_t different = 0;
        for (size_t i = 0; i < kCount; i++)
        {
            if (input.guides.viewZ[i] > kDenoisingRange) continue;
            different += used.diffuse()[i] != fresh.diffuse()[i] || used.specular()[i] != fresh.specular()[i];
        }
        CHECK(different == 0);
    }
}
} // namespace

TEST_CASE("after a restart every frame is that of a fresh instance, bit for bit", "[gpu]")
{
    checkAgainstFresh(nrd::AccumulationMode::RESTART);
}

TEST_CASE("after clear and restart every frame is that of a fresh instance, bit for bit", "[gpu]")
{
    checkAgainstFresh(nrd::AccumulationMode::CLEAR_AND_RESTART);
}
