#include "switched_light.h"
#include "catch.h"
#include "engine/transfer.h"
#include "measures.h"
#include "renderer.h"
#include "sample_device.h"
#include "scene_cornell.h"
#include "scene_shapes.h"

using namespace sample;

namespace confidence
{
namespace
{
constexpr uint32_t kReferenceSamples = 256;
constexpr const char* kDenoisers = "REBLUR_DIFFUSE_SPECULAR,RELAX_DIFFUSE_SPECULAR";

void addLight(Scene& scene, const glm::vec3& position, const glm::vec3& intensity, float radius)
{
    PunctualLight light;
    light.intensity = intensity;
    light.radius = radius;
    Node node = makeNode("light", kNone, position, 0.0f);
    node.light = int(scene.lights.size());
    scene.lights.push_back(light);
    scene.nodes.push_back(node);
}

// Nothing moves.
Stage makeStage(const Room& room)
{
    Stage stage;
    stage.scene = makeCornellBox();
    stage.scene.channels.clear();
    stage.scene.duration = 0.0f;
    for (Material& material : stage.scene.materials)
        if (!room.hasLamp) material.emission = glm::vec3(0.0f);
    const glm::vec3 intensity = room.strength * glm::vec3(14.0f, 13.0f, 12.0f);
    addLight(stage.scene, glm::vec3(-1.6f, 1.8f, 1.4f), intensity, 0.2f); // is switched off
    addLight(stage.scene, glm::vec3(0.3f, 3.2f, 0.6f), glm::vec3(7.0f, 6.0f, 5.0f), 0.02f);
    return stage;
}

Picture readComposed(DenoiseStage& stage)
{
    engine::Image& source = stage.composed();
    Image picture(static_cast<int>(source.desc().width), static_cast<int>(source.desc().height));
    picture.rgba = engine::readBackAs<float>(test::sampleDevice(), source);
    return test::toPicture(picture);
}

std::optional<double> meanConfidence(DenoiseStage& stage, Lobe lobe)
{
    engine::Image* image = stage.confidence(lobe);
    if (!image) return {};
    double sum = 0.0;
    const std::vector<uint8_t> texels = engine::readBackAs<uint8_t>(test::sampleDevice(), *image);
    for (uint8_t texel : texels) sum += double(texel) / 255.0;
    return sum / double(texels.size());
}

// Stages without confidence, with nothing in their history.
void addStages(Renderer& renderer, const Stage& stage, Options options, size_t first)
{
    options.hasConfidence = false;
    for (size_t i = 0; i < options.sets.size(); ++i)
        renderer.setStage(first + i, std::make_unique<DenoiseStage>(
                                         test::sampleDevice(), denoiseDesc(options, stage.scene, options.sets[i])));
}

// Both denoisers with confidence, then both without.
std::unique_ptr<Renderer> makeRenderer(const Stage& stage, Options& options)
{
    options.width = 96;
    options.height = 64;
    options.sets = parseDenoiserSets(kDenoisers);
    options.hasConfidence = true;
    settleDenoisers(options, stage.scene);
    auto renderer = std::make_unique<Renderer>(test::sampleDevice(), stage, options);
    addStages(*renderer, stage, options, options.sets.size());
    return renderer;
}

struct Recorded
{
    FrameFigures figures;
    Picture composed;
};

Recorded recordFrame(DenoiseStage& stage, bool isSwitched)
{
    Recorded now;
    now.figures.diffuse = meanConfidence(stage, Lobe::Diffuse);
    now.figures.specular = meanConfidence(stage, Lobe::Specular);
    if (isSwitched) now.composed = readComposed(stage);
    return now;
}

Frames measure(std::vector<Recorded>& recorded, const Picture& reference)
{
    const Mask all(reference.pixelCount(), 1);
    const Picture seen = toneMapped(reference), compressed = rangeCompressed(reference);
    Frames frames;
    for (Recorded& now : recorded)
    {
        if (now.composed.exists()) now.figures.rmse = rmse(toneMapped(now.composed), seen, all);
        if (now.composed.exists()) now.figures.flip = flip(rangeCompressed(now.composed), compressed, all);
        frames.push_back(now.figures);
    }
    return frames;
}
} // namespace

std::vector<Comparison> runSwitchedLight(const Room& room)
{
    Stage stage = makeStage(room);
    Options options;
    const std::unique_ptr<Renderer> renderer = makeRenderer(stage, options);
    const size_t count = options.sets.size();
    std::vector<std::vector<Recorded>> recorded(3 * count);
    for (uint32_t frame = 0; frame < kSwitchFrame + kFramesAfter; ++frame)
    {
        if (frame == kSwitchFrame)
        {
            stage.scene.lights[0].intensity = glm::vec3(0.0f);
            renderer->refreshScene();
            addStages(*renderer, stage, options, 2 * count);
        }
        renderer->renderFrame();
        for (size_t i = 0; i < (frame < kSwitchFrame ? 2 : 3) * count; ++i)
            recorded[i].push_back(recordFrame(renderer->stage(i), frame >= kSwitchFrame));
    }
    const Picture reference =
        test::toPicture(composedOf(renderer->traceReference(renderer->readFrame(), kReferenceSamples, [](double) {})));
    std::vector<Comparison> comparisons;
    for (size_t i = 0; i < count; ++i)
        comparisons.push_back({options.sets[i].lobes->name, measure(recorded[i], reference),
                               measure(recorded[count + i], reference), measure(recorded[2 * count + i], reference)});
    CHECK(test::sampleDevice().validationMessageCount() == 0);
    return comparisons;
}
} // namespace confidence
