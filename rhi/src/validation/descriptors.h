#pragma once
#include "objects.h"

namespace rhi::validation
{
struct BoundResource
{
    const Binding* binding = nullptr; // of the set's list
    std::shared_ptr<ViewFacts> view;
    Layout layout = Layout::Undefined;
    std::shared_ptr<BufferFacts> buffer;
    uint64_t offset = 0;
    uint64_t size = 0;
};

struct SetFacts : Resource
{
    SetFacts(const char* poolName, const PipelineFacts& pipeline, uint32_t set);
    std::vector<Binding> bindings;
    std::vector<BoundResource> bound; // by binding number, samplers left out; empty until written
    uint32_t dynamicCount = 0;
    bool isWritten = false;
};

class ValidSet final : public DescriptorSet
{
public:
    ValidSet(Validator& validator, const DeviceLimits& limits, DescriptorSet& inner, std::shared_ptr<SetFacts> facts);
    ~ValidSet() override { m_validator.retire(this); }
    void write(Span<const DescriptorWrite> writes) override;
    uint64_t nativeHandle() const override { return m_inner.nativeHandle(); }
    DescriptorSet& inner() const { return m_inner; }
    const std::shared_ptr<SetFacts>& facts() const { return m_facts; }

private:
    bool checkWrite(const Binding& binding, const DescriptorWrite& write) const;
    bool checkView(const Binding& binding, const DescriptorWrite& write) const;
    bool checkBuffer(const Binding& binding, const DescriptorWrite& write) const;
    bool fail(const Binding& binding, const std::string& text) const;

    Validator& m_validator;
    const DeviceLimits& m_limits;
    DescriptorSet& m_inner;
    std::shared_ptr<SetFacts> m_facts;
};

class ValidPool final : public Decorator<DescriptorPool, Resource>
{
public:
    ValidPool(Validator& validator, const DeviceLimits& limits, std::unique_ptr<DescriptorPool> inner,
              const char* poolName)
        : Decorator(validator, std::move(inner), std::make_shared<Resource>("descriptor pool", poolName), poolName),
          m_limits(limits)
    {
    }
    DescriptorSet& allocate(const Pipeline& pipeline, uint32_t set) override;
    void reset() override;

private:
    const DeviceLimits& m_limits;
    std::vector<std::unique_ptr<ValidSet>> m_sets;
    std::vector<std::unique_ptr<ValidSet>> m_retired; // of before the last reset: kept, so that their use is noticed
};
} // namespace rhi::validation
