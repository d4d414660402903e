// NrdIntegration: every public call in any order over a device that records what reaches it and fails now and then,
// with arbitrary native handles, creation descs, user pools, identifiers and sizes.
#include "arbitrary_instance.h"
#include "arbitrary_integration.h"
#include "arbitrary_settings.h"
#include "fake_images.h"
#include "fuzz.h"
#include "integration_access.h"
#include "valid_settings.h"

#include <rhi/recording.h>

namespace
{
using fuzz::ByteReader;
using fuzz::kIdentifierNum;
using fuzz::require;
using namespace nrd;

// Where a diagnosis may be recorded: its read-back memory is real.
constexpr uint32_t kMaxDiagnosedSize = 64;

VkCommandBuffer commandBufferOf(uintptr_t number) { return reinterpret_cast<VkCommandBuffer>(number); }

class Calls
{
public:
    explicit Calls(ByteReader& reader) : m_reader(reader) {}
    ~Calls();
    Calls(const Calls&) = delete;
    Calls& operator=(const Calls&) = delete;

    void callSomething();
    void expectUsable(); // after whatever was refused

private:
    void create();
    void createNative();
    void resize();
    void setCommon();
    void setDenoiser();
    void denoise();
    void diagnose();
    void observe();
    void recordDiagnosis();

    void fillPool(NrdUserPool& pool, const Identifier* identifiers, uint32_t identifierNum);
    CommonSettings nextFrame();
    void check(Result result);

    ByteReader& m_reader;
    std::unique_ptr<rhi::RecordingDevice> m_device = rhi::makeRecordingDevice();
    NrdIntegration m_integration; // goes before the device
    fuzz::ArbitraryInstance m_instance;
    uint32_t m_width = 0, m_height = 0;
    uint32_t m_lastWidth = 0, m_lastHeight = 0; // of the last frame, 0: there was none
    uint32_t m_frameIndex = 0;                  // of the last frame
    sample::ReplaySettings m_settings = {test::makeCommon(), {}, {}, {}, {}, {}};
    uint32_t m_reportNum = 0;
};

Calls::~Calls()
{
    m_integration.Destroy();
    require(m_device->objectCount() == 0, "a destroyed integration gives every object back");
}

void Calls::check(Result result)
{
    fuzz::countCall();
    m_device->failCreation(0);
    const bool isRefused = result != Result::SUCCESS;
    require(result < Result::MAX_NUM, "a result is one of the enumeration");
    require(m_reportNum == 0 || (isRefused && m_reportNum == 1), "one sentence for a refused call, else none");
    require(!isRefused || *m_integration.GetLastMessage() != 0, "a refused call is explained");
    m_reportNum = 0;
    m_device->clearCalls();
}

void Calls::create()
{
    if (m_reader.below(8) != 0) m_integration.Destroy();
    const bool wasCreated = m_integration.IsCreated();
    if (wasCreated) // the desc of what lives must stay as it is
    {
        check(IntegrationAccess::Create(m_integration, *m_device, {}, {}));
        return;
    }
    const IntegrationCreationDesc desc = fuzz::arbitraryDesc(m_reader, kMaxDiagnosedSize);
    fuzz::makeArbitrary(m_instance, m_reader, m_reportNum);
    if (m_reader.below(8) == 0) m_device->failCreation(1 + m_reader.below(32));
    const Result result = IntegrationAccess::Create(m_integration, *m_device, desc, m_instance.desc);
    require((result == Result::SUCCESS) == m_integration.IsCreated(), "created means created");
    require(m_integration.IsCreated() || m_device->objectCount() == 0, "a refused creation leaves nothing");
    m_width = desc.resourceWidth;
    m_height = desc.resourceHeight;
    check(result);
}

// Over a loader that has no function.
void Calls::createNative()
{
    IntegrationCreationDesc desc = fuzz::arbitraryDesc(m_reader, kMaxDiagnosedSize);
    NativeDevice& native = desc.native;
    native.instance = reinterpret_cast<VkInstance>(m_reader.value<uintptr_t>());
    native.physicalDevice = reinterpret_cast<VkPhysicalDevice>(m_reader.value<uintptr_t>());
    native.device = reinterpret_cast<VkDevice>(m_reader.value<uintptr_t>());
    native.queueFamilyIndex = m_reader.value<uint32_t>();
    if (m_reader.below(4) != 0)
        native.getInstanceProcAddr = [](VkInstance, const char*) -> PFN_vkVoidFunction { return nullptr; };
    if (m_reader.flag()) native.getDeviceProcAddr = [](VkDevice, const char*) -> PFN_vkVoidFunction { return nullptr; };
    native.isSynchronization2Enabled = m_reader.flag();
    native.isDebugUtilsEnabled = m_reader.flag();
    VkPhysicalDeviceFeatures features = {};
    if (m_reader.flag()) native.enabledFeatures = &features;
    DenoiserDesc denoiser = {0, Denoiser::REFERENCE};
    InstanceCreationDesc instanceDesc;
    instanceDesc.denoisers = &denoiser;
    instanceDesc.denoisersNum = 1;
    NrdIntegration integration;
    const Result result = integration.Create(desc, instanceDesc);
    fuzz::countCall();
    require(result != Result::SUCCESS && !integration.IsCreated(), "nothing is created without functions");
    require(*integration.GetLastMessage() != 0, "a refused creation is explained");
}

void Calls::resize()
{
    const bool isSmall = m_reader.below(4) != 0;
    const auto width = static_cast<uint16_t>(isSmall ? m_reader.below(kMaxDiagnosedSize) : m_reader.value<uint16_t>());
    const auto height = static_cast<uint16_t>(isSmall ? m_reader.below(kMaxDiagnosedSize) : m_reader.value<uint16_t>());
    if (m_reader.below(4) == 0) m_device->failCreation(1 + m_reader.below(8));
    const Result result = m_integration.Resize(width, height, fuzz::arbitraryMemory(m_reader));
    if (result == Result::SUCCESS)
    {
        m_width = width;
        m_height = height;
    }
    check(result);
}

// Settings of a frame that follows the last one.
CommonSettings Calls::nextFrame()
{
    CommonSettings common = test::makeCommon();
    for (uint16_t* size : {common.resourceSize, common.resourceSizePrev, common.rectSize, common.rectSizePrev})
    {
        size[0] = static_cast<uint16_t>(m_width);
        size[1] = static_cast<uint16_t>(m_height);
    }
    const uint32_t last[] = {m_lastWidth, m_lastHeight}; // mostly as it was: a history then survives another size
    for (uint16_t* size : {common.resourceSizePrev, common.rectSizePrev})
        for (size_t axis = 0; axis < 2; axis++)
            if (m_lastWidth != 0 && m_reader.below(8) != 0) size[axis] = static_cast<uint16_t>(last[axis]);
    m_lastWidth = m_width;
    m_lastHeight = m_height;
    common.frameIndex = ++m_frameIndex;
    return common;
}

void Calls::setCommon()
{
    if (m_reader.below(2) == 0) check(m_integration.NewFrame());
    if (m_reader.below(2) == 0) m_settings.common = nextFrame();
    if (m_reader.below(2) == 0) fuzz::changeSettings(m_settings, sample::Family::None, m_reader);
    const Result result = m_integration.SetCommonSettings(m_settings.common);
    if (result == Result::SUCCESS) m_frameIndex = m_settings.common.frameIndex; // the next may not repeat it
    check(result);
}

void Calls::setDenoiser()
{
    const Identifier identifier = fuzz::arbitraryIdentifier(m_reader);
    const auto family = static_cast<sample::Family>(1 + m_reader.below(4));
    if (m_reader.below(4) == 0) m_settings = {m_settings.common, {}, {}, {}, {}, {}};
    fuzz::changeSettings(m_settings, family, m_reader);
    check(sample::setDenoiserSettings(m_settings, family,
                                      [&](const auto& settings)
                                      { return m_integration.SetDenoiserSettings(identifier, settings); }));
}

void Calls::fillPool(NrdUserPool& pool, const Identifier* identifiers, uint32_t identifierNum)
{
    for (uint32_t i = 0; i < identifierNum; i++)
        test::fillSlots(m_integration, identifiers[i], m_width, m_height, pool);
}

void Calls::denoise()
{
    Identifier identifiers[kIdentifierNum];
    for (Identifier& identifier : identifiers) identifier = fuzz::arbitraryIdentifier(m_reader);
    const uint32_t identifierNum = m_reader.below(4) != 0 ? m_reader.below(2) : m_reader.below(kIdentifierNum + 1);
    NrdUserPool pool;
    if (m_integration.IsCreated()) fillPool(pool, identifiers, identifierNum);
    if (m_reader.flag()) fuzz::damagePool(m_reader, pool);
    const NrdUserPool before = pool;
    if (m_reader.below(8) == 0) m_device->failCreation(1 + m_reader.below(16));
    DenoiseOptions options;
    options.restoreInitialStates = m_reader.flag();
    options.recording = m_reader.below(4);
    if (m_reader.below(4) == 0) options.transientBefore.stages = m_reader.value<VkPipelineStageFlags>();
    if (m_reader.below(4) == 0) options.transientAfter.stages = m_reader.below(2);
    m_device->clearCalls();
    bool isRepeated = false, isRecordingNeeded = false;
    Result result = Result::SUCCESS;
    if (m_reader.below(4) == 0)
    {
        result = m_integration.Repeat(identifiers, identifierNum, pool, options, isRecordingNeeded);
        isRepeated = result != Result::SUCCESS || !isRecordingNeeded;
    }
    if (!isRepeated)
        result = m_integration.Denoise(commandBufferOf(m_reader.below(20)),
                                       m_reader.below(16) == 0 ? nullptr : identifiers, identifierNum, pool, options);
    if (result != Result::SUCCESS || isRepeated)
        for (const rhi::RecordedCall& call : m_device->calls())
            require(call.type != rhi::CallType::Dispatch && call.type != rhi::CallType::Barriers &&
                        call.type != rhi::CallType::MemoryBarrier,
                    "a refused call records nothing, nor does one that repeats");
    if (result != Result::SUCCESS)
    {
        for (uint32_t i = 0; i < NrdUserPool::kSlotsNum; i++)
            require(pool[static_cast<ResourceType>(i)].state == before[static_cast<ResourceType>(i)].state,
                    "a refused call changes no state");
    }
    check(result);
}

void Calls::recordDiagnosis()
{
    const uint32_t denoiserNum = m_instance.desc.denoisersNum;
    Identifier all[fuzz::kMaxDenoiserNum];
    for (uint32_t i = 0; i < denoiserNum; i++) all[i] = m_instance.denoisers[i].identifier;
    NrdUserPool pool;
    if (m_integration.IsCreated()) fillPool(pool, all, denoiserNum);
    if (m_reader.below(4) == 0) fuzz::damagePool(m_reader, pool);
    NrdDiagnosisImages images;
    images.diffuseFactor = images.specularDirection = pool[ResourceType::IN_MV];
    if (m_reader.flag()) fuzz::changeImage(m_reader, images.diffuseFactor);
    if (m_reader.below(4) == 0) m_device->failCreation(1 + m_reader.below(8));
    check(
        m_integration.RecordDiagnosis(commandBufferOf(m_reader.below(20)), pool, m_reader.flag() ? &images : nullptr));
}

void Calls::diagnose()
{
    const uint32_t call = m_reader.below(8);
    if (call == 0)
        check(m_integration.EndDiagnosis());
    else if (call < 4)
    {
        const Finding* findings = nullptr;
        uint32_t findingNum = 0;
        const Result result = m_integration.Diagnose(findings, findingNum, m_reader.flag());
        for (uint32_t i = 0; i < findingNum; i++)
            require(findings[i].text && *findings[i].text, "a finding is a sentence");
        check(result);
    }
    else if (m_width <= kMaxDiagnosedSize && m_height <= kMaxDiagnosedSize)
        recordDiagnosis();
}

void Calls::observe()
{
    const Timings timings = m_integration.GetTimings();
    for (uint32_t i = 0; i < timings.passesNum; i++) require(*timings.passes[i].name != 0, "a timed pass has a name");
    const MemoryStatistics memory = m_integration.GetMemoryStatistics();
    require(memory.total >= memory.permanent + memory.transient, "the total holds its parts");
    (void)m_integration.GetStatistics();
    if (m_reader.below(4) == 0)
    {
        NrdIntegration moved = std::move(m_integration);
        m_integration = std::move(moved);
    }
    check(m_integration.Forget(reinterpret_cast<VkImage>(uintptr_t{m_reader.below(4)})));
}

void Calls::callSomething()
{
    const uint32_t call = m_reader.below(32);
    if (call == 0)
        createNative();
    else if (!m_integration.IsCreated() ? call < 24 : call == 1)
        create();
    else if (call < 4)
        resize();
    else if (call < 12)
        setCommon();
    else if (call < 16)
        setDenoiser();
    else if (call < 24)
        denoise();
    else if (call < 28)
        diagnose();
    else
        observe();
}

void Calls::expectUsable()
{
    if (!m_integration.IsCreated()) return;
    // The pools of denoisers at a fraction of the resolution may fit the device, but no image of the full one does.
    if (std::max(m_width, m_height) > m_device->limits().maxTextureSize) return;
    for (uint32_t i = 0; i < m_instance.desc.denoisersNum;
         i++) // a frame each: one call a frame is what every desc allows
    {
        check(m_integration.NewFrame());
        check(m_integration.SetCommonSettings(nextFrame()));
        const Identifier identifier = m_instance.denoisers[i].identifier;
        NrdUserPool pool;
        fillPool(pool, &identifier, 1);
        const Result result = m_integration.Denoise(commandBufferOf(1), &identifier, 1, pool);
        require(result == Result::SUCCESS, "a refused call leaves an integration that denoises");
        check(result);
    }
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    ByteReader reader(bytes, size);
    Calls calls(reader);
    while (!reader.isEmpty()) calls.callSomething();
    calls.expectUsable();
    return 0;
}
