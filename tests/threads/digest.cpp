#include "digest.h"

namespace test
{
void Digest::addBytes(const void* bytes, size_t byteSize)
{
    constexpr uint64_t kPrime = 1099511628211ull;
    for (size_t i = 0; i < byteSize; i++) m_value = (m_value ^ static_cast<const uint8_t*>(bytes)[i]) * kPrime;
    m_value = (m_value ^ byteSize) * kPrime; // "ab", "c" is not "a", "bc"
}

void Digest::add(const nrd::DispatchDesc& dispatch)
{
    add(dispatch.name);
    for (const uint64_t number :
         {uint64_t{dispatch.identifier}, uint64_t{dispatch.pipelineIndex}, uint64_t{dispatch.gridWidth},
          uint64_t{dispatch.gridHeight}, uint64_t{dispatch.indirectBufferIndex}})
        add(number);
    for (uint32_t i = 0; i < dispatch.resourcesNum; i++)
    {
        add(static_cast<uint64_t>(dispatch.resources[i].type));
        add(uint64_t{dispatch.resources[i].indexInPool});
    }
    addBytes(dispatch.constantBufferData, dispatch.constantBufferDataSize);
}

void Digest::add(const rhi::RecordedCall& call)
{
    add(static_cast<uint64_t>(call.type));
    add(call.name);
    add(call.other);
    for (const uint64_t number : {uint64_t{call.index}, call.offset, call.size, call.handle}) add(number);
    for (const uint32_t groups : call.groups) add(uint64_t{groups});
    for (const uint32_t offset : call.dynamicOffsets) add(uint64_t{offset});
    for (const rhi::SpecConstant& constant : call.constants) add(uint64_t{constant.value});
    for (const rhi::RecordedBarrier& barrier : call.barriers)
    {
        add(barrier.name);
        add(static_cast<uint64_t>(barrier.before.layout) << 32 | static_cast<uint64_t>(barrier.after.layout));
    }
    for (const rhi::RecordedBinding& binding : call.bindings)
    {
        add(binding.name);
        add(uint64_t{binding.binding} << 32 | binding.offset);
    }
}
} // namespace test
