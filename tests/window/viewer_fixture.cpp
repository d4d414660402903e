#include "viewer_fixture.h"
#include "engine/transfer.h"
#include "sample_device.h"

using namespace sample;

namespace test
{
Options optionsFor(const char* scene, const char* denoiser)
{
    Options options;
    options.builtIn = findBuiltInScene(scene);
    options.width = 32;
    options.height = 20;
    options.sets = parseDenoiserSets(denoiser);
    return options;
}

Viewer makeViewer(const char* scene, const char* denoiser, FirstPicture first)
{
    const Options options = optionsFor(scene, denoiser);
    return Viewer(sampleDevice(), loadStage(options), options, 2, first);
}

std::string show(Viewer& viewer)
{
    engine::submitAndWait(sampleDevice(), [&](VkCommandBuffer cmd) { viewer.recordPicture(cmd, 0); });
    std::string bytes;
    for (std::byte b : engine::readBack(sampleDevice(), viewer.picture())) bytes += std::to_integer<char>(b);
    return bytes;
}
} // namespace test
