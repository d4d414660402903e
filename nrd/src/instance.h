// The state behind the public functions. Every function checks first and changes something afterwards.
#pragma once
#include "compiled.h"
#include "frame_state.h"
#include "memory.h"
#include "validate.h"
#include <nrd/nrd.h>

namespace nrd
{
class Instance
{
public:
    // Throws std::bad_alloc; the description is valid.
    explicit Instance(const InstanceCreationDesc& desc);
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    const InstanceDesc& desc() const { return m_desc; }
    const char* lastMessage() const { return m_lastMessage.c_str(); }
    const AllocationCallbacks& allocationCallbacks() const { return m_allocationCallbacks; }

    Result setCommonSettings(const CommonSettings& settings);
    template <class Settings> Result setDenoiserSettings(Identifier identifier, const Settings& settings);
    Result getComputeDispatches(const Identifier* identifiers, uint32_t num, const DispatchDesc*& dispatches,
                                uint32_t& dispatchNum);
    Result getRequiredResources(Identifier identifier, const ResourceRequirement*& requirements, uint32_t& num) const;

private:
    void describe(const InstanceCreationDesc& desc);
    CompiledDenoiser* find(Identifier identifier);
    Error findRequestError(const Identifier* identifiers, uint32_t num);
    Result fail(const Error& error) const;

    void emit(CompiledDenoiser& denoiser);
    void emitClears(const CompiledDenoiser& denoiser);
    void emitPass(const CompiledDenoiser& denoiser, size_t pass, const Conditions& conditions);
    const uint8_t* emitConstants(const CompiledDenoiser& denoiser, const Request& request);
    void push(const CompiledDenoiser& denoiser, const Binding& binding, DescriptorType type);

    AllocationCallbacks m_allocationCallbacks;
    MessageSink m_messageSink;
    CallbackMemory m_memory; // before everything that uses it
    Compiled m_compiled;
    InstanceDesc m_desc = {};

    CommonSettings m_common;
    bool m_hasCommon = false;
    FrameClock m_clock;
    float m_frameRateScale = 1.0f;

    // Room for one request of every denoiser; never grows.
    std::pmr::vector<DispatchDesc> m_dispatches;
    std::pmr::vector<ResourceDesc> m_resources;
    std::pmr::vector<uint8_t> m_constants;
    const uint8_t* m_constantBlock = nullptr; // of the denoiser being emitted
    size_t m_constantBlockNum = 0;

    mutable Sentence m_lastMessage;
    mutable FixedList<ResourceRequirement, static_cast<size_t>(ResourceType::MAX_NUM)> m_requirements;
};

// For errors before there is an instance.
Result report(const MessageSink& sink, const Error& error);
Error unknownIdentifier(Identifier identifier);
} // namespace nrd
