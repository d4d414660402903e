// Settings in, compute dispatches out: no graphics API, no allocation after CreateInstance().
// One thread per Instance at a time; instances are independent. What a getter returns stays valid until the next call
// of that getter, descriptions until DestroyInstance(). Nothing throws; a refused call changes nothing.
#pragma once
#include <nrd/descs.h>
#include <nrd/settings.h>

namespace nrd
{
class Instance;

NRD_API const LibraryDesc& GetLibraryDesc();

// INVALID_ARGUMENT, UNSUPPORTED (denoiser, encoding, header version), NON_UNIQUE_IDENTIFIER, FAILURE (memory);
// instance is null then.
NRD_API Result CreateInstance(const InstanceCreationDesc& desc, Instance*& instance);
NRD_API void DestroyInstance(Instance* instance); // null is allowed
NRD_API const InstanceDesc& GetInstanceDesc(const Instance& instance);

// Once per frame, before GetComputeDispatches(); or once per view.
NRD_API Result SetCommonSettings(Instance& instance, const CommonSettings& settings);

// Copied; kept until set again. INVALID_ARGUMENT if no denoiser has this identifier or it is of another family.
NRD_API Result SetDenoiserSettings(Instance& instance, Identifier identifier, const ReblurSettings& settings);
NRD_API Result SetDenoiserSettings(Instance& instance, Identifier identifier, const RelaxSettings& settings);
NRD_API Result SetDenoiserSettings(Instance& instance, Identifier identifier, const SigmaSettings& settings);
NRD_API Result SetDenoiserSettings(Instance& instance, Identifier identifier, const ReferenceSettings& settings);
// Of what kConfidenceIdentifier stands for. INVALID_ARGUMENT if the instance has no confidenceTileSize.
NRD_API Result SetConfidenceSettings(Instance& instance, const ConfidenceSettings& settings);

// The dispatches of the named denoisers, in the order of the list. Each identifier at most once per
// SetCommonSettings(), in one call or several. Allocates nothing. INVALID_ARGUMENT: unknown or repeated identifier, no
// common settings yet.
NRD_API Result GetComputeDispatches(Instance& instance, const Identifier* identifiers, uint32_t identifiersNum,
                                    const DispatchDesc*& dispatches, uint32_t& dispatchesNum);

// Which user-pool slots the denoiser reads and writes under its present settings, inputs first.
NRD_API Result GetRequiredResources(const Instance& instance, Identifier identifier,
                                    const ResourceRequirement*& requirements, uint32_t& requirementsNum);

// The last refusal's sentence on this instance; empty if none. For callers without a message sink.
NRD_API const char* GetLastMessage(const Instance& instance);
} // namespace nrd
