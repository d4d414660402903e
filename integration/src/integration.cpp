#include "convert.h"
#include "core.h"
#include "integration_access.h"
#include <cstdio>
#include <new>
#include <rhi/vulkan.h>

namespace nrd
{
namespace
{
constexpr char kNotCreated[] = "Create() must succeed before any other call";

// There is no object yet that could keep a message.
Result failWithoutMemory(const MessageSink& sink)
{
    if (sink.report) sink.report(sink.userArg, Result::FAILURE, "Create(): out of host memory");
    return Result::FAILURE;
}
} // namespace

struct NrdIntegration::Impl
{
    std::unique_ptr<rhi::Device> ownedDevice; // wraps the application's; empty over a given device
    std::unique_ptr<Core> core;               // null unless created
    MessageSink sink;
    char message[512] = "";

    ~Impl() { writeDump(true); }

    /// What cannot be written is told, and does no harm to the call that has tried.
    void writeDump(bool isGpuIdle)
    {
        if (core) (void)guarded("DumpInputs", [&] { core->writeDump(isGpuIdle); });
    }

    Result fail(Result result, const char* text, const char* more = "")
    {
        std::snprintf(message, sizeof(message), "%s%s", text, more);
        if (sink.report) sink.report(sink.userArg, result, message);
        return result;
    }

    Result failOnLoss(const rhi::Error& error)
    {
        const LastPass last = core ? core->lastPass() : LastPass{};
        char where[256] = "";
        if (last.frame != 0)
            std::snprintf(where, sizeof(where), "; the last pass that began is '%s' of frame %llu, %s", last.name,
                          static_cast<unsigned long long>(last.frame), last.isFinished ? "finished" : "not finished");
        else if (core)
            std::snprintf(where, sizeof(where), "; %s",
                          core->isTraced() ? "no pass of the last frames had begun"
                                           : "with isPassTracingEnabled it would say in which pass");
        return fail(toResult(error.code()), error.what(), where);
    }

    // The one place where exceptions end.
    template <class Body> Result guarded(const char* call, Body&& body)
    {
        try
        {
            body();
            return Result::SUCCESS;
        }
        catch (const Refusal& error)
        {
            return fail(error.result(), error.what());
        }
        catch (const rhi::Error& error)
        {
            return error.code() == rhi::ErrorCode::DeviceLost ? failOnLoss(error)
                                                              : fail(toResult(error.code()), error.what());
        }
        catch (const std::bad_alloc&)
        {
            return fail(Result::FAILURE, call, "(): out of host memory");
        }
        catch (const std::exception& error)
        {
            return fail(Result::FAILURE, error.what());
        }
    }

    /// `self` may be null, before the first Create().
    template <class Body> static Result withCore(Impl* self, const char* call, Body&& body)
    {
        if (!self) return Result::INVALID_ARGUMENT;
        if (!self->core) return self->fail(Result::INVALID_ARGUMENT, kNotCreated);
        return self->guarded(call, [&] { body(*self->core); });
    }

    Result create(rhi::Device* device, const IntegrationCreationDesc& desc, const InstanceCreationDesc& instanceDesc)
    {
        if (core) return fail(Result::INVALID_ARGUMENT, "Create() was called before: Destroy() must come in between");
        sink = instanceDesc.messageSink;
        const Result result =
            guarded("Create",
                    [&]
                    {
                        if (!device) ownedDevice = wrapDevice(desc.native);
                        core = std::make_unique<Core>(device ? *device : *ownedDevice, desc, instanceDesc);
                    });
        if (result != Result::SUCCESS) ownedDevice.reset();
        return result;
    }

    static std::unique_ptr<rhi::Device> wrapDevice(const NativeDevice& native);

    static Result memoryRequirements(rhi::Device* device, const IntegrationCreationDesc& desc,
                                     const InstanceCreationDesc& instanceDesc, PoolMemoryRequirements& requirements)
    {
        requirements = {};
        Impl impl; // for its way with errors only
        impl.sink = instanceDesc.messageSink;
        return impl.guarded("GetMemoryRequirements",
                            [&]
                            {
                                if (!device) impl.ownedDevice = wrapDevice(desc.native);
                                requirements =
                                    Core::memoryRequirements(device ? *device : *impl.ownedDevice, desc, instanceDesc);
                            });
    }
};

std::unique_ptr<rhi::Device> NrdIntegration::Impl::wrapDevice(const NativeDevice& native)
{
    const auto require = [](bool isGiven, const char* field)
    {
        if (!isGiven) throw Refusal(Result::INVALID_ARGUMENT, sentence("native.%s is null", field));
    };
    require(native.instance != VK_NULL_HANDLE, "instance");
    require(native.physicalDevice != VK_NULL_HANDLE, "physicalDevice");
    require(native.device != VK_NULL_HANDLE, "device");
    require(native.getInstanceProcAddr != nullptr, "getInstanceProcAddr");
    rhi::VulkanNativeDevice result;
    result.instance = native.instance;
    result.physicalDevice = native.physicalDevice;
    result.device = native.device;
    result.queueFamilyIndex = native.queueFamilyIndex;
    result.getInstanceProcAddr = native.getInstanceProcAddr;
    result.getDeviceProcAddr = native.getDeviceProcAddr;
    result.enabledFeatures = native.enabledFeatures;
    result.isSynchronization2Enabled = native.isSynchronization2Enabled;
    result.isDebugUtilsEnabled = native.isDebugUtilsEnabled;
    result.pipelineCache = native.pipelineCache;
    result.allocationCallbacks = native.allocationCallbacks;
    return rhi::wrapVulkanDevice(result);
}

RequiredDeviceFeatures GetRequiredDeviceFeatures()
{
    static const rhi::VulkanRequirements kRequirements = rhi::requiredVulkanFeatures();
    return {kRequirements.apiVersion, kRequirements.features, kRequirements.deviceExtensions.data(),
            static_cast<uint32_t>(kRequirements.deviceExtensions.size())};
}

NrdIntegration::NrdIntegration() = default;
NrdIntegration::~NrdIntegration() = default;
NrdIntegration::NrdIntegration(NrdIntegration&&) noexcept = default;
NrdIntegration& NrdIntegration::operator=(NrdIntegration&&) noexcept = default;

Result NrdIntegration::Create(const IntegrationCreationDesc& desc, const InstanceCreationDesc& instanceDesc)
{
    if (!m_impl) m_impl.reset(new (std::nothrow) Impl);
    return m_impl ? m_impl->create(nullptr, desc, instanceDesc) : failWithoutMemory(instanceDesc.messageSink);
}

Result IntegrationAccess::Create(NrdIntegration& integration, rhi::Device& device, const IntegrationCreationDesc& desc,
                                 const InstanceCreationDesc& instanceDesc)
{
    std::unique_ptr<NrdIntegration::Impl>& impl = integration.m_impl;
    if (!impl) impl.reset(new (std::nothrow) NrdIntegration::Impl);
    return impl ? impl->create(&device, desc, instanceDesc) : failWithoutMemory(instanceDesc.messageSink);
}

Result NrdIntegration::GetMemoryRequirements(const IntegrationCreationDesc& desc,
                                             const InstanceCreationDesc& instanceDesc,
                                             PoolMemoryRequirements& requirements)
{
    return Impl::memoryRequirements(nullptr, desc, instanceDesc, requirements);
}

Result IntegrationAccess::GetMemoryRequirements(rhi::Device& device, const IntegrationCreationDesc& desc,
                                                const InstanceCreationDesc& instanceDesc,
                                                PoolMemoryRequirements& requirements)
{
    return NrdIntegration::Impl::memoryRequirements(&device, desc, instanceDesc, requirements);
}

Pools& IntegrationAccess::GetPools(NrdIntegration& integration) { return integration.m_impl->core->pools(); }

void NrdIntegration::Destroy() { m_impl.reset(); }
bool NrdIntegration::IsCreated() const { return m_impl && m_impl->core; }

Result NrdIntegration::Resize(uint16_t resourceWidth, uint16_t resourceHeight, const NrdMemory& transientMemory)
{
    return Impl::withCore(m_impl.get(), "Resize",
                          [&](Core& core) { core.resize(resourceWidth, resourceHeight, transientMemory); });
}

Result NrdIntegration::NewFrame()
{
    const Result result = Impl::withCore(m_impl.get(), "NewFrame", [](Core& core) { core.newFrame(); });
    if (result == Result::SUCCESS) m_impl->writeDump(false);
    return result;
}

Result NrdIntegration::SetCommonSettings(const CommonSettings& settings)
{
    return Impl::withCore(m_impl.get(), "SetCommonSettings", [&](Core& core) { core.setCommonSettings(settings); });
}

Result NrdIntegration::SetDenoiserSettings(Identifier identifier, const ReblurSettings& settings)
{
    return Impl::withCore(m_impl.get(), "SetDenoiserSettings",
                          [&](Core& core) { core.setDenoiserSettings(identifier, settings); });
}

Result NrdIntegration::SetDenoiserSettings(Identifier identifier, const RelaxSettings& settings)
{
    return Impl::withCore(m_impl.get(), "SetDenoiserSettings",
                          [&](Core& core) { core.setDenoiserSettings(identifier, settings); });
}

Result NrdIntegration::SetDenoiserSettings(Identifier identifier, const SigmaSettings& settings)
{
    return Impl::withCore(m_impl.get(), "SetDenoiserSettings",
                          [&](Core& core) { core.setDenoiserSettings(identifier, settings); });
}

Result NrdIntegration::SetDenoiserSettings(Identifier identifier, const ReferenceSettings& settings)
{
    return Impl::withCore(m_impl.get(), "SetDenoiserSettings",
                          [&](Core& core) { core.setDenoiserSettings(identifier, settings); });
}

Result NrdIntegration::SetConfidenceSettings(const ConfidenceSettings& settings)
{
    return Impl::withCore(m_impl.get(), "SetConfidenceSettings",
                          [&](Core& core) { core.setDenoiserSettings(kConfidenceIdentifier, settings); });
}

Result NrdIntegration::Denoise(VkCommandBuffer commandBuffer, const Identifier* identifiers, uint32_t identifiersNum,
                               NrdUserPool& userPool, const DenoiseOptions& options)
{
    return Impl::withCore(m_impl.get(), "Denoise",
                          [&](Core& core) {
                              core.denoise(commandBuffer, {identifiers, identifiersNum}, userPool, options);
                          });
}

Result NrdIntegration::ComputeConfidence(VkCommandBuffer commandBuffer, NrdUserPool& userPool,
                                         const DenoiseOptions& options)
{
    return Denoise(commandBuffer, &kConfidenceIdentifier, 1, userPool, options);
}

Result NrdIntegration::Repeat(const Identifier* identifiers, uint32_t identifiersNum, NrdUserPool& userPool,
                              const DenoiseOptions& options, bool& isRecordingNeeded)
{
    isRecordingNeeded = true;
    return Impl::withCore(m_impl.get(), "Repeat",
                          [&](Core& core) {
                              isRecordingNeeded = !core.repeat({identifiers, identifiersNum}, userPool, options);
                          });
}

Result NrdIntegration::DumpInputs(const char* folder, uint32_t framesNum)
{
    return Impl::withCore(m_impl.get(), "DumpInputs", [&](Core& core) { core.dumpInputs(folder, framesNum); });
}

bool NrdIntegration::IsDumping() const { return IsCreated() && m_impl->core->isDumping(); }

Result NrdIntegration::RecordDiagnosis(VkCommandBuffer commandBuffer, NrdUserPool& userPool, NrdDiagnosisImages* images)
{
    return Impl::withCore(m_impl.get(), "RecordDiagnosis",
                          [&](Core& core) { core.recordDiagnosis(commandBuffer, userPool, images); });
}

Result NrdIntegration::Diagnose(const Finding*& findings, uint32_t& findingsNum, bool isGpuIdle)
{
    findings = nullptr;
    findingsNum = 0;
    return Impl::withCore(m_impl.get(), "Diagnose",
                          [&](Core& core)
                          {
                              const rhi::Span<const Finding> result = core.diagnose(isGpuIdle);
                              findings = result.data();
                              findingsNum = static_cast<uint32_t>(result.size());
                          });
}

Result NrdIntegration::EndDiagnosis()
{
    return Impl::withCore(m_impl.get(), "EndDiagnosis", [](Core& core) { core.endDiagnosis(); });
}

Result NrdIntegration::Forget(VkImage image)
{
    return Impl::withCore(m_impl.get(), "Forget", [&](Core& core) { core.forget(image); });
}

Timings NrdIntegration::GetTimings() const { return IsCreated() ? m_impl->core->timings() : Timings{}; }
LastPass NrdIntegration::GetLastPass() const { return IsCreated() ? m_impl->core->lastPass() : LastPass{}; }

MemoryStatistics NrdIntegration::GetMemoryStatistics() const
{
    MemoryStatistics result;
    if (IsCreated()) (void)m_impl->guarded("GetMemoryStatistics", [&] { result = m_impl->core->memoryStatistics(); });
    return result;
}

NrdMemory NrdIntegration::GetTransientMemory() const
{
    return IsCreated() ? m_impl->core->transientMemory() : NrdMemory{};
}

IntegrationStatistics NrdIntegration::GetStatistics() const
{
    return IsCreated() ? m_impl->core->statistics() : IntegrationStatistics{};
}

const Instance* NrdIntegration::GetInstance() const { return IsCreated() ? &m_impl->core->instance() : nullptr; }

const char* NrdIntegration::GetLastMessage() const { return m_impl ? m_impl->message : kNotCreated; }
} // namespace nrd
