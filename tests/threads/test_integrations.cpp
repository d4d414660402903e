// NrdIntegration: objects are independent, and one may go from thread to thread.
#include "common.h"
#include "digest.h"
#include "fake_images.h"
#include "integration_access.h"
#include "side_by_side.h"
#include <array>
#include <memory>
#include <thread>
#include <vector>

using nrd::Denoiser;
using nrd::Identifier;

namespace
{
constexpr uint32_t kFrameNum = 60;
constexpr uint16_t kWidth = 64;
constexpr uint16_t kHeight = 48;
constexpr std::array kDenoisers = {
    nrd::DenoiserDesc{0, Denoiser::REBLUR_DIFFUSE_SPECULAR_SH},
    nrd::DenoiserDesc{1, Denoiser::RELAX_DIFFUSE_SPECULAR, 2},
    nrd::DenoiserDesc{2, Denoiser::SIGMA_SHADOW_TRANSLUCENCY},
    nrd::DenoiserDesc{3, Denoiser::REFERENCE},
};

class View
{
public:
    explicit View(uint32_t number) : m_number(number) {}

    void create();
    void renderFrame();
    uint64_t digest() const { return m_digest.value(); }

private:
    void resize();
    void denoise();
    void diagnose();

    uint32_t m_number;
    uint32_t m_frame = 0;
    uint16_t m_width = kWidth;
    test::Digest m_digest;
    std::unique_ptr<rhi::RecordingDevice> m_device = rhi::makeRecordingDevice();
    nrd::NrdIntegration m_integration; // goes before the device
};

void View::create()
{
    nrd::IntegrationCreationDesc desc;
    desc.resourceWidth = m_width;
    desc.resourceHeight = kHeight;
    desc.framesInFlight = 1 + m_number % 3;
    desc.isGpuTimingEnabled = true;
    nrd::InstanceCreationDesc instanceDesc;
    instanceDesc.denoisers = kDenoisers.data();
    instanceDesc.denoisersNum = static_cast<uint32_t>(kDenoisers.size());
    m_digest.add(nrd::IntegrationAccess::Create(m_integration, *m_device, desc, instanceDesc));
}

void View::resize()
{
    m_width = m_width == kWidth ? static_cast<uint16_t>(kWidth + m_number) : kWidth;
    m_digest.add(m_integration.Resize(m_width, kHeight));
}

void View::denoise()
{
    std::vector<Identifier> identifiers;
    nrd::NrdUserPool pool;
    // One size a call: first the denoiser of half the resolution, then the others.
    for (const bool isHalf : {true, false})
    {
        identifiers.clear();
        for (const nrd::DenoiserDesc& denoiser : kDenoisers)
        {
            if ((denoiser.resolutionDivisor == 2) != isHalf) continue;
            identifiers.push_back(denoiser.identifier);
            test::fillSlots(m_integration, denoiser.identifier, m_width, kHeight, pool);
        }
        const auto commands = reinterpret_cast<VkCommandBuffer>(uintptr_t{0xC0} + m_frame % 3);
        m_digest.add(
            m_integration.Denoise(commands, identifiers.data(), static_cast<uint32_t>(identifiers.size()), pool));
    }
}

void View::diagnose()
{
    const nrd::Finding* findings = nullptr;
    uint32_t findingNum = 0;
    m_digest.add(m_integration.Diagnose(findings, findingNum));
    const nrd::Timings timings = m_integration.GetTimings();
    for (uint32_t i = 0; i < timings.passesNum; i++) m_digest.add(timings.passes[i].name);
    m_digest.add(m_integration.GetMemoryStatistics().total);
}

void View::renderFrame()
{
    m_digest.add(m_integration.NewFrame());
    if (m_frame % 16 == 15) resize();
    m_digest.add(m_integration.Resize(0, 0)); // refused
    m_digest.add(m_integration.SetCommonSettings(test::stillCamera(m_width, kHeight, m_frame)));
    nrd::SigmaSettings sigma;
    sigma.maxStabilizedFrameNum = m_frame % 8;
    m_digest.add(m_integration.SetDenoiserSettings(2, sigma));
    denoise();
    diagnose();
    m_digest.add(m_integration.GetLastMessage());
    for (const rhi::RecordedCall& call : m_device->calls()) m_digest.add(call);
    m_device->clearCalls();
    m_frame++;
}

// Two objects in turn on one thread.
uint64_t renderTwoViews(uint32_t worker)
{
    View views[] = {View(worker), View(worker + 1)};
    for (View& view : views) view.create();
    for (uint32_t frame = 0; frame < kFrameNum; frame++)
        for (View& view : views) view.renderFrame();
    return views[0].digest() * 31 + views[1].digest();
}
} // namespace

TEST_CASE("integrations on four threads record what each of them records alone", "[unit]")
{
    test::requireUndisturbed(renderTwoViews);
}

TEST_CASE("an integration goes from thread to thread between any two calls", "[unit]")
{
    const auto onAThread = [](const auto& work) { std::thread(work).join(); };
    View still(0), moved(0);
    still.create();
    onAThread([&] { moved.create(); });
    for (uint32_t frame = 0; frame < kFrameNum; frame++)
    {
        still.renderFrame();
        onAThread([&] { moved.renderFrame(); });
    }
    CHECK(still.digest() == moved.digest());
}
