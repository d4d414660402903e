// Several views, as of a stereo pair, in one object: an identifier each, common settings before each.
#include "reblur_engine.h"

using test::kHeight;
using test::kReblur;
using test::kWidth;
using test::require;

namespace
{
constexpr nrd::Identifier kEyes[] = {kReblur, kReblur + 1};
using Pictures = std::vector<std::vector<float>>;

nrd::CommonSettings cameraOf(size_t eye, uint32_t frame)
{
    nrd::CommonSettings common = test::stillCamera(kWidth, kHeight, frame);
    const float position = eye == 0 ? -0.3f : 0.3f, step = 0.01f * static_cast<float>(frame);
    common.worldToViewMatrix[12] = position + step;
    common.worldToViewMatrixPrev[12] = position + (frame == 0 ? step : step - 0.01f);
    common.isMotionVectorInWorldSpace = true;
    return common;
}

// The last frame of each eye, both in one object or each in its own.
Pictures run(const std::vector<size_t>& eyes)
{
    test::Gpu gpu;
    test::FrameRing frames(gpu, 2);
    std::deque<test::ReblurImages> images;
    std::vector<nrd::DenoiserDesc> denoisers;
    for (const size_t eye : eyes)
    {
        images.emplace_back(gpu);
        denoisers.push_back({kEyes[eye], nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR});
    }
    nrd::IntegrationCreationDesc desc;
    desc.native = gpu.native();
    desc.resourceWidth = kWidth;
    desc.resourceHeight = kHeight;
    desc.framesInFlight = 2;
    nrd::InstanceCreationDesc instance;
    instance.denoisers = denoisers.data();
    instance.denoisersNum = static_cast<uint32_t>(denoisers.size());
    nrd::NrdIntegration integration;
    require(integration.Create(desc, instance), integration);
    for (uint32_t frame = 0; frame < 6; frame++)
    {
        rhi::CommandBuffer& commands = frames.begin();
        require(integration.NewFrame(), integration);
        for (size_t i = 0; i < eyes.size(); i++)
        {
            std::vector<float> noise(size_t(kWidth) * kHeight * 4, 0.5f);
            for (size_t p = 0; p < noise.size(); p += 4)
                noise[p] = static_cast<float>((p + eyes[i] * 13) * 7919 % 101) * 0.02f;
            if (frame == 0)
            {
                images[i].upload(commands);
                for (const size_t signal : {3u, 4u}) images[i].images[signal].upload(commands, noise.data());
            }
            require(integration.SetCommonSettings(cameraOf(eyes[i], frame)), integration);
            images[i].denoise(integration, commands, {}, kEyes[eyes[i]]);
            if (frame == 5) images[i].images[6].download(commands);
        }
        frames.end();
    }
    frames.wait();
    Pictures pictures;
    for (const test::ReblurImages& image : images) pictures.push_back(image.images[6].texels<float>());
    gpu.finish();
    return pictures;
}
} // namespace

TEST_CASE("two views in one object are those of two objects, bit for bit", "[gpu]")
{
    const Pictures both = run({0, 1});
    CHECK(both[0] == run({0})[0]);
    CHECK(both[1] == run({1})[0]);
    CHECK(both[0] != both[1]);
}
