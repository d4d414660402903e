#include "switched_light.h"
#include "catch.h"
#include "engine/transfer.h"
#include "measures.h"
#include "renderer.h"
#include "scene_cornell.h"
#include "scene_shapes.h"
#include <algorithm>

using namespace sample;

namespace confidence
{
namespace
{
constexpr uint32_t kReferenceSamples = 256;

engine::Device& device()
{
    static engine::Device instance(
        []
        {
            engine::DeviceDesc desc = denoiserDeviceDesc();
            desc.validation = true;
            return desc;
        }());
    return instance;
}

// Nothing moves.
Stage makeStage()
{
    Stage stage;
    stage.scene = makeCornellBox();
    stage.scene.channels.clear();
    stage.scene.duration = 0.0f;
    PunctualLight light;
    light.intensity = glm::vec3(14.0f, 13.0f, 12.0f);
    light.radius = 0.2f;
    stage.scene.lights.push_back(light);
    Node node = makeNode("light", kNone, glm::vec3(-1.6f, 1.8f, 1.4f), 0.0f);
    node.light = 0;
    stage.scene.nodes.push_back(node);
    return stage;
}

Picture toPicture(const Image& image)
{
    Picture picture(image.width, image.height, 3);
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < picture.pixelCount(); ++i) picture.planes[c][i] = image.rgba[i * 4 + c];
    return picture;
}

Picture readComposed(DenoiseStage& stage)
{
    engine::Image& source = stage.composed();
    Image picture(static_cast<int>(source.desc().width), static_cast<int>(source.desc().height));
    picture.rgba = engine::readBackAs<float>(device(), source);
    return toPicture(picture);
}

std::optional<double> meanConfidence(DenoiseStage& stage, Lobe lobe)
{
    engine::Image* image = stage.confidence(lobe);
    if (!image) return {};
    double sum = 0.0;
    const std::vector<uint8_t> texels = engine::readBackAs<uint8_t>(device(), *image);
    for (uint8_t texel : texels) sum += double(texel) / 255.0;
    return sum / double(texels.size());
}

struct Recorded
{
    Picture composed;
    FrameFigures figures;
};
} // namespace

std::vector<std::vector<FrameFigures>> runSwitchedLight(const std::string& denoisers, bool hasConfidence)
{
    Stage stage = makeStage();
    Options options;
    options.width = 144;
    options.height = 96;
    options.sets = parseDenoiserSets(denoisers);
    options.hasConfidence = hasConfidence;
    settleDenoisers(options, stage.scene);
    Renderer renderer(device(), stage, options);
    std::vector<std::vector<Recorded>> recorded(options.sets.size());
    for (uint32_t frame = 0; frame < kSwitchFrame + kFramesAfter; ++frame)
    {
        if (frame == kSwitchFrame)
        {
            stage.scene.lights[0].intensity = glm::vec3(0.0f);
            renderer.refreshScene();
        }
        renderer.renderFrame();
        for (size_t i = 0; i < recorded.size(); ++i)
        {
            Recorded& now = recorded[i].emplace_back();
            now.figures.diffuse = meanConfidence(renderer.stage(i), Lobe::Diffuse);
            now.figures.specular = meanConfidence(renderer.stage(i), Lobe::Specular);
            if (frame >= kSwitchFrame) now.composed = readComposed(renderer.stage(i));
        }
    }
    const Picture reference =
        toPicture(composedOf(renderer.traceReference(renderer.readFrame(), kReferenceSamples, [](double) {})));
    const Mask all(reference.pixelCount(), 1);
    std::vector<std::vector<FrameFigures>> figures(recorded.size());
    for (size_t i = 0; i < recorded.size(); ++i)
        for (Recorded& now : recorded[i])
        {
            if (now.composed.exists())
            {
                now.figures.rmse = rmse(toneMapped(now.composed), toneMapped(reference), all);
                now.figures.flip = flip(rangeCompressed(now.composed), rangeCompressed(reference), all);
            }
            figures[i].push_back(now.figures);
        }
    CHECK(device().validationMessageCount() == 0);
    return figures;
}
} // namespace confidence
