#include "bench_emission.h"
#include "bench_camera.h"
#include "bench_statistics.h"

#include "engine/resources.h"

#include <nrd/nrd.h>

#include <chrono>
#include <memory>

namespace sample::bench
{
namespace
{
constexpr uint32_t kCallCount = 1000;
constexpr nrd::Identifier kIdentifier = 0;

struct InstanceDeleter
{
    void operator()(nrd::Instance* instance) const { nrd::DestroyInstance(instance); }
};
using InstancePtr = std::unique_ptr<nrd::Instance, InstanceDeleter>;

void check(nrd::Result result, const InstancePtr& instance)
{
    if (result == nrd::Result::SUCCESS) return;
    throw engine::Error(std::string("cannot emit dispatches: ") +
                        (instance ? nrd::GetLastMessage(*instance) : nrd::toString(result)));
}

InstancePtr makeInstance(const ReplayDenoiser& denoiser, const Workload& workload, const ReplaySettings& settings)
{
    const nrd::DenoiserDesc row = denoiserDesc(kIdentifier, denoiser.denoiser, workload.resolution);
    nrd::InstanceCreationDesc desc;
    desc.denoisers = &row;
    desc.denoisersNum = 1;
    nrd::Instance* raw = nullptr;
    const nrd::Result result = nrd::CreateInstance(desc, raw);
    InstancePtr instance(raw);
    check(result, instance);
    const auto set = [&](const auto& own) { return nrd::SetDenoiserSettings(*instance, kIdentifier, own); };
    check(setDenoiserSettings(settings, denoiser.family, set), instance);
    return instance;
}
} // namespace

Emission measureEmission(const ReplayDenoiser& denoiser, Extent size, const Workload& workload,
                         const std::vector<BenchSlot>& slots)
{
    const InstancePtr instance = makeInstance(denoiser, workload, settingsOf(workload, denoiser, size, 0));
    const nrd::DispatchDesc* dispatches = nullptr;
    uint32_t count = 0;
    std::vector<double> times;
    for (uint32_t i = 0; i < kCallCount; i++)
    {
        const nrd::CommonSettings common = settingsOf(workload, denoiser, size, i).common;
        const auto start = std::chrono::steady_clock::now();
        check(nrd::SetCommonSettings(*instance, common), instance);
        check(nrd::GetComputeDispatches(*instance, &kIdentifier, 1, dispatches, count), instance);
        times.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    }
    SlotTexels texels = {};
    for (const BenchSlot& slot : slots)
        texels[static_cast<size_t>(slot.type)] = {engine::texelByteSize(slot.format), slot.divisor};
    return {quantile(std::move(times), 0.5),
            findTraffic(nrd::GetInstanceDesc(*instance), {dispatches, count}, texels, size)};
}
} // namespace sample::bench
