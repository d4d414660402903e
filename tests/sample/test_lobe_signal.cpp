// Packing of the traced lobes into the denoiser's slots.
#include "catch.h"
#include "engine/commands.h"
#include "engine/transfer.h"
#include "lobe_signal.h"
#include "scene_cornell.h"
#include "tracer_fixture.h"

using namespace sample;

namespace
{
constexpr uint32_t kWidth = 21, kHeight = 8; // odd: the last column has half a neighbour

// The first input slot of a lobe as words of the image: two per texel of four half floats.
std::vector<glm::uvec2> packed(FrameImages& frame, Lobe lobe, nrd::CheckerboardMode mode, uint32_t frameIndex)
{
    LobeSignalDesc desc;
    desc.lobe = lobe;
    desc.width = kWidth;
    desc.height = kHeight;
    desc.checkerboard = mode;
    LobeSignal signal(test::device(), desc);
    engine::submitAndWait(test::device(), [&](VkCommandBuffer cmd) { signal.recordPack(cmd, frame, frameIndex); });
    return engine::readBackAs<glm::uvec2>(test::device(), *signal.slots().front().second);
}
} // namespace

TEST_CASE("a lobe's samples of a checkerboard lie side by side in the left half", "[gpu]")
{
    const Scene scene = makeCornellBox();
    TracerDesc tracerDesc;
    tracerDesc.width = kWidth;
    tracerDesc.height = kHeight;
    PathTracer tracer(test::device(), scene, nullptr, tracerDesc);
    const ScenePose pose(scene);
    tracer.setPose(scene, pose, nullptr);
    View view;
    view.camera = findCamera(scene, pose, float(kWidth) / float(kHeight)).value();
    engine::submitAndWait(test::device(), [&](VkCommandBuffer cmd) { tracer.recordFrame(cmd, view); });
    const auto mode = GENERATE(nrd::CheckerboardMode::BLACK, nrd::CheckerboardMode::WHITE);
    for (uint32_t frameIndex = 0; frameIndex < 2; ++frameIndex)
        for (Lobe lobe : kLobes)
        {
            const auto full = packed(tracer.images(), lobe, nrd::CheckerboardMode::OFF, frameIndex);
            const auto half = packed(tracer.images(), lobe, mode, frameIndex);
            size_t sampleCount = 0, wrongCount = 0;
            for (uint32_t i = 0; i < kWidth * kHeight; ++i)
            {
                const uint32_t x = i % kWidth, y = i / kWidth;
                const bool isEven = ((x ^ y ^ frameIndex) & 1u) == 0;
                const bool isBlack = (mode == nrd::CheckerboardMode::BLACK) == (lobe == Lobe::Diffuse);
                if (isEven != isBlack) continue;
                ++sampleCount;
                wrongCount += half[y * kWidth + (x >> 1)] != full[i];
            }
            CHECK(sampleCount == kWidth * kHeight / 2);
            CHECK(wrongCount == 0);
        }
    CHECK(test::device().validationMessageCount() == 0);
}

TEST_CASE("every denoiser of the table has slots for the lobes it takes", "[gpu]")
{
    for (const SampleDenoiser& denoiser : sampleDenoisers())
        for (Lobe lobe : kLobes)
        {
            if (denoiser.format(lobe) == LobeFormat::None) continue;
            INFO(denoiser.name);
            LobeSignalDesc desc;
            desc.lobe = lobe;
            desc.format = denoiser.format(lobe);
            desc.width = desc.height = 8;
            LobeSignal signal(test::device(), desc);
            CHECK(signal.slots().size() == (desc.format == LobeFormat::Sh ? 4 : 2));
        }
}
