// The traced shadow in the slots of SIGMA, and back out of its output.
#include "catch.h"
#include "engine/commands.h"
#include "engine/transfer.h"
#include "scene_panes.h"
#include "shadow_signal.h"
#include "tracer_fixture.h"

#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

using namespace sample;
using nrd::ResourceType;

namespace
{
constexpr uint32_t kWidth = 61, kHeight = 34;

// A frame of the panes, under their sun or under a spot in its place.
class TracedPanes
{
public:
    explicit TracedPanes(LightType type) : m_scene(makeScene(type)), m_tracer(test::device(), m_scene, nullptr, desc())
    {
        const ScenePose pose(m_scene);
        m_tracer.setPose(m_scene, pose, nullptr);
        View view;
        view.camera = findCamera(m_scene, pose, float(kWidth) / float(kHeight)).value();
        engine::submitAndWait(test::device(), [&](VkCommandBuffer cmd) { m_tracer.recordFrame(cmd, view); });
    }
    FrameImages& images() { return m_tracer.images(); }
    const SceneLight& light() const { return *m_tracer.shadowLight(); }
    test::Pixels read(engine::Image& image) { return engine::readBackAs<glm::vec4>(test::device(), image); }

private:
    static Scene makeScene(LightType type)
    {
        Scene scene = makePanes();
        scene.lights[0].type = type;
        scene.lights[0].intensity *= type == LightType::Spot ? 100.0f : 1.0f;
        scene.lights[0].radius = 0.3f;
        scene.lights[0].outerCosine = 0.8f;
        scene.lights[0].innerCosine = 0.9f;
        scene.nodes[1].translation = glm::vec3(-4.0f, 4.5f, 5.0f); // the sun's node
        return scene;
    }
    static TracerDesc desc()
    {
        TracerDesc desc;
        desc.width = kWidth;
        desc.height = kHeight;
        desc.hasShadowSignal = true;
        return desc;
    }
    Scene m_scene;
    PathTracer m_tracer;
};

engine::Image& slotOf(ShadowSignal& signal, ResourceType type)
{
    for (const SlotImage& slot : signal.slots())
        if (slot.first == type) return *slot.second;
    throw std::logic_error("no such slot");
}

float penumbraOf(float hitDist, float distanceToLight, const SceneLight& light)
{
    if (hitDist >= 65504.0f) return 65504.0f;
    if (hitDist <= 0.0f) return 0.0f;
    const float p = distanceToLight == 0.0f ? hitDist * light.source.tanAngularRadius
                                            : light.source.radius * hitDist / (distanceToLight - hitDist);
    return std::clamp(p, 1e-4f, 32768.0f);
}
} // namespace

TEST_CASE("a traced shadow is packed by the front end's rules, of a sun and of a spot", "[gpu]")
{
    TracedPanes panes(GENERATE(LightType::Directional, LightType::Spot));
    ShadowSignal signal(test::device(), {true, kWidth, kHeight});
    engine::submitAndWait(test::device(),
                          [&](VkCommandBuffer cmd) { signal.recordPack(cmd, panes.images(), panes.light()); });
    const auto penumbra = engine::readBackAs<uint16_t>(test::device(), slotOf(signal, ResourceType::IN_PENUMBRA));
    const auto translucency =
        engine::readBackAs<uint32_t>(test::device(), slotOf(signal, ResourceType::IN_TRANSLUCENCY));
    const test::Pixels shadow = panes.read(panes.images().shadow), sun = panes.read(panes.images().sun);
    size_t litCount = 0, darkCount = 0, tintedCount = 0, awayCount = 0, wrongCount = 0;
    for (size_t i = 0; i < shadow.size(); ++i)
    {
        const float expected = penumbraOf(shadow[i].w, sun[i].w, panes.light());
        const float packed = glm::unpackHalf1x16(penumbra[i]);
        wrongCount += std::abs(packed - expected) > 1e-3f * expected + 1e-7f;
        const bool isLit = shadow[i].w >= 65504.0f;
        const glm::vec4 color = isLit ? glm::vec4(1.0f) : glm::vec4(0.0f, glm::vec3(shadow[i]));
        const glm::vec4 difference = glm::abs(glm::unpackUnorm4x8(translucency[i]) - color);
        wrongCount += glm::any(glm::greaterThan(difference, glm::vec4(0.5f / 255.0f + 1e-5f)));
        const bool isDark = glm::vec3(shadow[i]) == glm::vec3(0.0f);
        litCount += isLit;
        awayCount += shadow[i].w == 0.0f;
        darkCount += shadow[i].w > 0.0f && isDark;
        tintedCount += !isLit && !isDark;
    }
    CHECK(wrongCount == 0);
    CHECK(litCount > 500);
    CHECK(darkCount > 20);
    CHECK(tintedCount > 10);
    CHECK(awayCount > 5);
    CHECK(test::device().validationMessageCount() == 0);
}

TEST_CASE("the shadow that comes back is squared, and the sky is lit", "[gpu]")
{
    TracedPanes panes(LightType::Directional);
    const bool isTranslucent = GENERATE(false, true);
    ShadowSignal signal(test::device(), {isTranslucent, kWidth, kHeight});
    CHECK(signal.slots().size() == (isTranslucent ? 3 : 2));
    engine::Image& output = slotOf(signal, ResourceType::OUT_SHADOW_TRANSLUCENCY);
    const size_t channelCount = isTranslucent ? 4 : 1;
    std::vector<uint8_t> stored(kWidth * kHeight * channelCount);
    for (size_t i = 0; i < stored.size(); ++i) stored[i] = static_cast<uint8_t>(i * 37);
    engine::upload(test::device(), output, std::as_bytes(std::span(stored)));
    const float range = GENERATE(1e30f, 1.0f); // 1: everything is sky
    engine::submitAndWait(test::device(),
                          [&](VkCommandBuffer cmd) { signal.recordUnpack(cmd, panes.images(), range); });
    const test::Pixels values = panes.read(signal.values());
    size_t wrongCount = 0;
    for (size_t i = 0; i < values.size(); ++i)
        for (size_t c = 0; c < 4; ++c)
        {
            // Stored: visibility, then the colour; returned: the colour, then visibility.
            const float root = float(stored[i * channelCount + (isTranslucent ? (c + 1) % 4 : 0)]) / 255.0f;
            wrongCount += std::abs(values[i][int(c)] - (range > 1.0f ? root * root : 1.0f)) > 1e-5f;
        }
    CHECK(wrongCount == 0);
    CHECK(test::device().validationMessageCount() == 0);
}
