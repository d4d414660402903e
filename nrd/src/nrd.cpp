#include "denoisers/families.h"
#include "instance.h"
#include <memory>

namespace nrd
{
namespace
{
constexpr size_t kDenoiserNum = static_cast<size_t>(Denoiser::MAX_NUM);

struct Library
{
    FixedList<Denoiser, kDenoiserNum> denoisers;
    LibraryDesc desc = {};

    Library()
    {
        for (const Family* family : kFamilies)
        {
            for (const Variant& variant : family->variants)
                if (variant.keeps == Keeps::History) denoisers.push(variant.key); // once each
        }
        desc = {kVersionMajor,  kVersionMinor,     kVersionBuild,
                kHeaderVersion, denoisers.begin(), static_cast<uint32_t>(denoisers.size())};
    }
};

// Owns the memory of an instance until it is constructed.
struct Deallocate
{
    std::pmr::memory_resource* memory;
    void operator()(void* block) const { memory->deallocate(block, sizeof(Instance), alignof(Instance)); }
};
} // namespace

const LibraryDesc& GetLibraryDesc()
{
    static const Library library; // constant once made
    return library.desc;
}

Result CreateInstance(const InstanceCreationDesc& desc, Instance*& instance)
{
    instance = nullptr;
    if (const Error error = findError(desc)) return report(desc.messageSink, error);
    try
    {
        CallbackMemory memory(desc.allocationCallbacks);
        std::unique_ptr<void, Deallocate> block(memory.allocate(sizeof(Instance), alignof(Instance)), {&memory});
        instance = std::construct_at(static_cast<Instance*>(block.get()), desc);
        static_cast<void>(block.release());
        return Result::SUCCESS;
    }
    catch (const std::bad_alloc&)
    {
        Error error;
        error.result = Result::FAILURE;
        error.text << "out of memory while creating an instance of " << desc.denoisersNum << " denoisers";
        return report(desc.messageSink, error);
    }
}

void DestroyInstance(Instance* instance)
{
    if (!instance) return;
    CallbackMemory memory(instance->allocationCallbacks());
    std::destroy_at(instance);
    memory.deallocate(instance, sizeof(Instance), alignof(Instance));
}

const InstanceDesc& GetInstanceDesc(const Instance& instance) { return instance.desc(); }

Result SetCommonSettings(Instance& instance, const CommonSettings& settings)
{
    return instance.setCommonSettings(settings);
}

Result SetDenoiserSettings(Instance& instance, Identifier identifier, const ReblurSettings& settings)
{
    return instance.setDenoiserSettings(identifier, settings);
}

Result SetDenoiserSettings(Instance& instance, Identifier identifier, const RelaxSettings& settings)
{
    return instance.setDenoiserSettings(identifier, settings);
}

Result SetDenoiserSettings(Instance& instance, Identifier identifier, const SigmaSettings& settings)
{
    return instance.setDenoiserSettings(identifier, settings);
}

Result SetDenoiserSettings(Instance& instance, Identifier identifier, const ReferenceSettings& settings)
{
    return instance.setDenoiserSettings(identifier, settings);
}

Result SetConfidenceSettings(Instance& instance, const ConfidenceSettings& settings)
{
    return instance.setDenoiserSettings(kConfidenceIdentifier, settings);
}

Result GetComputeDispatches(Instance& instance, const Identifier* identifiers, uint32_t identifiersNum,
                            const DispatchDesc*& dispatches, uint32_t& dispatchesNum)
{
    return instance.getComputeDispatches(identifiers, identifiersNum, dispatches, dispatchesNum);
}

Result GetRequiredResources(const Instance& instance, Identifier identifier, const ResourceRequirement*& requirements,
                            uint32_t& requirementsNum)
{
    return instance.getRequiredResources(identifier, requirements, requirementsNum);
}

const char* GetLastMessage(const Instance& instance) { return instance.lastMessage(); }
} // namespace nrd
