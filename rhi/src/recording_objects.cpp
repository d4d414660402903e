#include "checks.h"
#include "recording.h"
#include <array>
#include <limits>

namespace rhi::recording
{
RecordedCall& Journal::add(CallType type, const char* name)
{
    RecordedCall& call = calls.emplace_back();
    call.type = type;
    call.name = safeName(name);
    return call;
}

RecordedCall& Journal::create(CallType type, const char* name)
{
    if (failAt > 0 && --failAt == 0)
        throw Error(failCode, sentence("%s '%s': %s (injected)", toString(type), safeName(name), toString(failCode)));
    return add(type, name);
}

Alive::Alive(Journal& journal, std::string name)
    : m_journal(journal), m_name(std::move(name)), m_handle(++journal.lastHandle)
{
    journal.objectCount++;
}

Alive::~Alive()
{
    m_journal.objectCount--;
    m_journal.add(CallType::Destroy, m_name.c_str());
}

namespace
{
MemoryLedger::Entry entryOf(Journal& journal, const BufferDesc& desc, uint64_t wrapped)
{
    return wrapped ? MemoryLedger::Entry() : MemoryLedger::Entry(journal.ledger, desc.memoryTag, desc.size);
}
} // namespace

Buffer::Buffer(Journal& journal, const BufferDesc& desc, uint64_t wrapped)
    : rhi::Buffer(desc), m_alive(journal, name()), m_entry(entryOf(journal, desc, wrapped)), m_wrapped(wrapped)
{
    if (!wrapped && desc.memory != BufferMemory::Device) m_bytes.resize(desc.size);
}

void DescriptorSet::write(Span<const DescriptorWrite> writes)
{
    RecordedCall& call = m_journal.add(CallType::WriteSet, name());
    call.handle = m_handle;
    for (const DescriptorWrite& write : writes)
    {
        RecordedBinding& binding = call.bindings.emplace_back();
        binding.binding = write.binding;
        if (write.view)
        {
            binding.name = write.view->name();
            binding.mips = write.view->desc().mips;
            binding.layout = write.view->desc().type == ViewType::Storage ? Layout::General : write.layout;
        }
        if (write.buffer) binding.name = write.buffer->name();
        binding.offset = write.offset;
        binding.size = write.size;
    }
}

DescriptorPool::DescriptorPool(Journal& journal, const DescriptorPoolDesc& desc)
    : rhi::DescriptorPool(desc.name), m_journal(journal), m_alive(journal, name()), m_capacity(desc)
{
    m_capacity.name = m_used.name = "";
}

namespace
{
uint32_t& countOf(DescriptorPoolDesc& desc, BindingType type)
{
    switch (type)
    {
    case BindingType::UniformBufferDynamic:
        return desc.uniformBuffersDynamic;
    case BindingType::Sampler:
        return desc.samplers;
    case BindingType::SampledTexture:
        return desc.sampledTextures;
    case BindingType::StorageTexture:
        return desc.storageTextures;
    case BindingType::StorageBuffer:
        return desc.storageBuffers;
    }
    return desc.sets;
}
} // namespace

rhi::DescriptorSet& DescriptorPool::allocate(const rhi::Pipeline& pipeline, uint32_t set)
{
    DescriptorPoolDesc used = m_used;
    used.sets++;
    bool isRoom = used.sets <= m_capacity.sets;
    for (const BindingDesc& binding : static_cast<const Pipeline&>(pipeline).bindings())
        if (binding.set == set) isRoom = ++countOf(used, binding.type) <= countOf(m_capacity, binding.type) && isRoom;
    if (!isRoom) throw Error(ErrorCode::PoolExhausted, sentence("descriptor pool '%s': no room for a set", name()));
    RecordedCall& call = m_journal.create(CallType::AllocateSet, name());
    call.other = pipeline.name();
    call.index = set;
    call.handle = ++m_journal.lastHandle;
    m_used = used;
    return *m_sets.emplace_back(std::make_unique<DescriptorSet>(m_journal, name(), call.handle));
}

void DescriptorPool::reset()
{
    m_journal.add(CallType::ResetPool, name());
    m_used = {};
    m_used.name = "";
    m_sets.clear();
}

bool QueryPool::read(uint32_t first, Span<uint64_t> ticks) const
{
    if (first > count() || ticks.size() > count() - first)
        throwInvalid(sentence("query pool '%s': queries [%u; %u + %zu) do not exist, it has %u", name(), first, first,
                              ticks.size(), count()));
    for (uint64_t& tick : ticks) tick = ++m_journal.ticks;
    return true;
}
} // namespace rhi::recording

namespace rhi
{
const char* toString(CallType type)
{
    static constexpr const char* kNames[] = {
        "CreateTexture",
        "CreateMemory",
        "CreatePlacedTexture",
        "CreateView",
        "CreateBuffer",
        "CreatePipeline",
        "CreateDescriptorPool",
        "CreateQueryPool",
        "CreateCommandBuffer",
        "CreateFence",
        "WrapTexture",
        "WrapBuffer",
        "WrapMemory",
        "WrapCommandBuffer",
        "Destroy",
        "AllocateSet",
        "WriteSet",
        "ResetPool",
        "Begin",
        "End",
        "BindPipeline",
        "BindSet",
        "Dispatch",
        "DispatchIndirect",
        "Barriers",
        "MemoryBarrier",
        "CopyBufferToTexture",
        "CopyTextureToBuffer",
        "CopyTexture",
        "CopyBuffer",
        "FillBuffer",
        "ClearTexture",
        "ResetQueries",
        "WriteTimestamp",
        "BeginLabel",
        "EndLabel",
        "Submit",
        "WaitIdle",
    };
    static_assert(std::size(kNames) == static_cast<size_t>(CallType::WaitIdle) + 1);
    const size_t index = static_cast<size_t>(type);
    return index < std::size(kNames) ? kNames[index] : "unknown";
}
} // namespace rhi
