#include "fixture.h"
#include <algorithm>

namespace test
{
MessageSink Messages::sink()
{
    const auto report = [](void* userArg, Result result, const char* text)
    {
        Messages& messages = *static_cast<Messages*>(userArg);
        messages.texts.emplace_back(text);
        messages.results.push_back(result);
    };
    return {report, this};
}

InstancePtr makeInstance(const std::vector<Denoiser>& denoisers, InstanceCreationDesc desc)
{
    std::vector<DenoiserDesc> descs;
    for (Denoiser denoiser : denoisers) descs.push_back({static_cast<Identifier>(descs.size()), denoiser});
    desc.denoisers = descs.data();
    desc.denoisersNum = static_cast<uint32_t>(descs.size());
    Instance* instance = nullptr;
    REQUIRE(CreateInstance(desc, instance) == Result::SUCCESS);
    REQUIRE(instance);
    return InstancePtr(instance);
}

std::vector<DispatchDesc> request(Instance& instance, const std::vector<Identifier>& identifiers)
{
    const DispatchDesc* dispatches = nullptr;
    uint32_t num = 0;
    const Result result =
        GetComputeDispatches(instance, identifiers.data(), static_cast<uint32_t>(identifiers.size()), dispatches, num);
    INFO(GetLastMessage(instance));
    REQUIRE(result == Result::SUCCESS);
    return {dispatches, dispatches + num};
}

std::vector<DispatchDesc> requestFrame(Instance& instance, CommonSettings& common,
                                       const std::vector<Identifier>& identifiers)
{
    common.frameIndex++;
    const Result result = SetCommonSettings(instance, common);
    INFO(GetLastMessage(instance));
    REQUIRE(result == Result::SUCCESS);
    return request(instance, identifiers);
}

std::vector<std::string> passNames(const std::vector<DispatchDesc>& dispatches)
{
    std::vector<std::string> names;
    for (const DispatchDesc& dispatch : dispatches)
    {
        const std::string name = dispatch.name;
        const size_t separator = name.find(" - ");
        REQUIRE(separator != std::string::npos);
        names.push_back(name.substr(separator + 3));
    }
    return names;
}

const DispatchDesc* findPass(const std::vector<DispatchDesc>& dispatches, const std::string& name)
{
    const std::vector<std::string> names = passNames(dispatches);
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? nullptr : &dispatches[static_cast<size_t>(found - names.begin())];
}

bool isPool(ResourceType type) { return type == ResourceType::TRANSIENT_POOL || type == ResourceType::PERMANENT_POOL; }

shared::DenoiserConstants reblurConstants(const std::vector<DispatchDesc>& dispatches)
{
    const DispatchDesc* pass = findPass(dispatches, "Blur");
    REQUIRE(pass);
    return constantsOf<shared::DenoiserConstants>(*pass);
}
} // namespace test
