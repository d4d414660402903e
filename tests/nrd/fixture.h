// What the tests of the descriptor library share: valid settings, an owned instance, and views of what it emits.
#pragma once
#include "catch.h"
#include "denoiser_constants.h"
#include "valid_settings.h"
#include <memory>
#include <nrd/nrd.h>
#include <string>
#include <vector>

namespace test
{
using namespace nrd;

constexpr Denoiser kReblurBoth = Denoiser::REBLUR_DIFFUSE_SPECULAR;

struct Messages
{
    std::vector<std::string> texts;
    std::vector<Result> results;
    MessageSink sink();
};

struct InstanceDeleter
{
    void operator()(Instance* instance) const { nrd::DestroyInstance(instance); }
};
using InstancePtr = std::unique_ptr<Instance, InstanceDeleter>;

// Identifiers 0, 1, 2...
InstancePtr makeInstance(const std::vector<Denoiser>& denoisers, InstanceCreationDesc desc = {});

// The dispatches of one request, checked for success. The pointers live until the next request.
std::vector<DispatchDesc> request(Instance& instance, const std::vector<Identifier>& identifiers);
// Common settings with the next frame index first.
std::vector<DispatchDesc> requestFrame(Instance& instance, CommonSettings& common,
                                       const std::vector<Identifier>& identifiers = {0});
std::vector<std::string> passNames(const std::vector<DispatchDesc>& dispatches);        // without "DENOISER - "
shared::DenoiserConstants reblurConstants(const std::vector<DispatchDesc>& dispatches); // of the blur
const DispatchDesc* findPass(const std::vector<DispatchDesc>& dispatches, const std::string& name); // null = none

bool isPool(ResourceType type);

template <class T> const T& constantsOf(const DispatchDesc& dispatch)
{
    REQUIRE(dispatch.constantBufferDataSize == sizeof(T));
    return *reinterpret_cast<const T*>(dispatch.constantBufferData);
}
} // namespace test
