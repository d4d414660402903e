// Packing of the traced lobes into the denoiser's slots.
#include "catch.h"
#include "engine/commands.h"
#include "engine/transfer.h"
#include "lobe_signal.h"
#include "relax_slots.h"
#include "scene_cornell.h"
#include "tracer_fixture.h"

#include <set>

using namespace sample;

namespace
{
constexpr uint32_t kWidth = 21, kHeight = 8; // odd: the last column has half a neighbour

// A frame of the Cornell box.
class TracedBox
{
public:
    TracedBox() : m_scene(makeCornellBox()), m_tracer(test::device(), m_scene, nullptr, desc())
    {
        const ScenePose pose(m_scene);
        m_tracer.setPose(m_scene, pose, nullptr);
        View view;
        view.camera = findCamera(m_scene, pose, float(kWidth) / float(kHeight)).value();
        engine::submitAndWait(test::device(), [&](VkCommandBuffer cmd) { m_tracer.recordFrame(cmd, view); });
    }
    FrameImages& images() { return m_tracer.images(); }

private:
    static TracerDesc desc()
    {
        TracerDesc desc;
        desc.width = kWidth;
        desc.height = kHeight;
        return desc;
    }
    Scene m_scene;
    PathTracer m_tracer;
};

LobeSignalDesc signalDesc(Lobe lobe, LobeFormat format, Family family)
{
    LobeSignalDesc desc;
    desc.lobe = lobe;
    desc.format = format;
    desc.family = family;
    desc.width = kWidth;
    desc.height = kHeight;
    return desc;
}

// The lobe unpacked from output slots that hold what `given` packs into its input slots, a denoiser's that changes
// nothing.
std::vector<glm::vec4> unpacked(FrameImages& frame, const LobeSignalDesc& desc, const LobeSignalDesc& given)
{
    LobeSignal signal(test::device(), desc), source(test::device(), given);
    engine::submitAndWait(test::device(), [&](VkCommandBuffer cmd) { source.recordPack(cmd, frame, 0); });
    const std::vector<SlotImage> from = source.slots(), to = signal.slots(); // inputs, then outputs
    for (size_t i = 0; i < from.size() / 2; ++i)
        engine::upload(test::device(), *to[to.size() / 2 + i].second,
                       engine::readBack(test::device(), *from[i].second));
    engine::submitAndWait(test::device(), [&](VkCommandBuffer cmd) { signal.recordUnpack(cmd, frame, 1e30f); });
    return engine::readBackAs<glm::vec4>(test::device(), signal.values());
}

bool isNear(const glm::vec3& a, const glm::vec3& b, float tolerance)
{
    return glm::all(glm::lessThanEqual(glm::abs(a - b), glm::vec3(tolerance)));
}

// The first input slot of a lobe as words of the image: two per texel of four half floats.
std::vector<glm::uvec2> packed(FrameImages& frame, Lobe lobe, nrd::CheckerboardMode mode, uint32_t frameIndex)
{
    LobeSignalDesc desc = signalDesc(lobe, LobeFormat::Radiance, Family::Reblur);
    desc.checkerboard = mode;
    LobeSignal signal(test::device(), desc);
    engine::submitAndWait(test::device(), [&](VkCommandBuffer cmd) { signal.recordPack(cmd, frame, frameIndex); });
    return engine::readBackAs<glm::uvec2>(test::device(), *signal.slots().front().second);
}
} // namespace

TEST_CASE("a lobe's samples of a checkerboard lie side by side in the left half", "[gpu]")
{
    TracedBox box;
    const auto mode = GENERATE(nrd::CheckerboardMode::BLACK, nrd::CheckerboardMode::WHITE);
    for (uint32_t frameIndex = 0; frameIndex < 2; ++frameIndex)
        for (Lobe lobe : kLobes)
        {
            const auto full = packed(box.images(), lobe, nrd::CheckerboardMode::OFF, frameIndex);
            const auto half = packed(box.images(), lobe, mode, frameIndex);
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
    for (const SampleDenoiser& denoiser : sampleDenoiserTable())
        for (Lobe lobe : kLobes)
        {
            if (denoiser.format(lobe) == LobeFormat::None) continue;
            INFO(denoiser.name);
            LobeSignalDesc desc;
            desc.lobe = lobe;
            desc.format = denoiser.format(lobe);
            desc.family = denoiser.family;
            desc.width = desc.height = 8;
            LobeSignal signal(test::device(), desc);
            CHECK(signal.slots().size() == (desc.format == LobeFormat::Sh ? 4 : 2));
        }
}

TEST_CASE("the sample has the slots that the library's RELAX denoisers are specified with", "[gpu]")
{
    size_t count = 0;
    for (const SampleDenoiser& denoiser : sampleDenoiserTable())
    {
        if (denoiser.family != Family::Relax) continue;
        INFO(denoiser.name);
        count++;
        std::set<nrd::ResourceType> slots;
        for (Lobe lobe : kLobes)
        {
            if (denoiser.format(lobe) == LobeFormat::None) continue;
            LobeSignal signal(test::device(), {lobe, denoiser.format(lobe), Family::Relax, 8, 8});
            for (const auto& [type, image] : signal.slots()) slots.insert(type);
        }
        const std::vector<nrd::ResourceType> expected = relaxLobeSlots(denoiser.name);
        CHECK(slots == std::set<nrd::ResourceType>(expected.begin(), expected.end()));
    }
    CHECK(count == 6);
}

TEST_CASE("RELAX's slots take and return a lobe's radiance as it is, with the hit distance in world units", "[gpu]")
{
    TracedBox box;
    for (Lobe lobe : kLobes)
    {
        engine::Image& traced = lobe == Lobe::Diffuse ? box.images().diffuse : box.images().specular;
        const auto expected = engine::readBackAs<glm::vec4>(test::device(), traced);
        const LobeSignalDesc desc = signalDesc(lobe, LobeFormat::Radiance, Family::Relax);
        const std::vector<glm::vec4> values = unpacked(box.images(), desc, desc);
        REQUIRE(values.size() == expected.size());
        size_t litCount = 0;
        for (size_t i = 0; i < values.size(); ++i)
        {
            const float brightest = std::max({expected[i].x, expected[i].y, expected[i].z});
            CHECK(isNear(values[i], expected[i], brightest / 2048.0f + 1e-7f));
            CHECK(values[i].w == Approx(std::min(expected[i].w, 65504.0f)).epsilon(1.0 / 2048.0));
            litCount += brightest > 0.0f && expected[i].w > 0.0f;
        }
        CHECK(litCount > values.size() / 4);
    }
    CHECK(test::device().validationMessageCount() == 0);
}

// RELAX takes linear SH0 and returns it in YCoCg, which is how REBLUR takes it.
TEST_CASE("RELAX's and REBLUR's SH results are unpacked alike", "[gpu]")
{
    TracedBox box;
    for (Lobe lobe : kLobes)
    {
        const LobeSignalDesc reblur = signalDesc(lobe, LobeFormat::Sh, Family::Reblur);
        const LobeSignalDesc relax = signalDesc(lobe, LobeFormat::Sh, Family::Relax);
        const std::vector<glm::vec4> expected = unpacked(box.images(), reblur, reblur);
        CHECK(unpacked(box.images(), relax, reblur) == expected);
        CHECK(unpacked(box.images(), relax, relax) != expected);
        LobeSignal a(test::device(), reblur), b(test::device(), relax);
        engine::submitAndWait(test::device(),
                              [&](VkCommandBuffer cmd)
                              {
                                  a.recordPack(cmd, box.images(), 0);
                                  b.recordPack(cmd, box.images(), 0);
                              });
        CHECK(engine::readBack(test::device(), *a.slots()[1].second) ==
              engine::readBack(test::device(), *b.slots()[1].second)); // SH1
    }
    CHECK(test::device().validationMessageCount() == 0);
}
