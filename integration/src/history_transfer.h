// What Resize() leaves to the next call of Denoise(): history moves from the pools of the old size to those of the new.
#pragma once
#include "pools.h"
#include <nrd/integration.h>

namespace nrd
{
/// The pipelines of all transfers, created at the first one.
class TransferPipelines
{
public:
    /// `name` as in IntegrationCreationDesc; borrowed.
    TransferPipelines(rhi::Device& device, const char* name) : m_device(device), m_name(name) {}
    /// Throws rhi::Error.
    const rhi::Pipeline& get(rhi::FormatClass formatClass);

private:
    rhi::Device& m_device;
    const char* m_name;
    std::unique_ptr<rhi::Pipeline> m_ofFloats;
    std::unique_ptr<rhi::Pipeline> m_ofUints;
};

class HistoryTransfer
{
public:
    /// `lastFrame`: the last one that used `source`.
    HistoryTransfer(std::unique_ptr<Pools> source, uint64_t lastFrame);

    /// Whether the settings go on from the old size; those that don't want none of its history.
    bool isContinuedBy(const CommonSettings& settings) const;
    /// These settings as the library needs them, for which the last frame lies in textures of the new size.
    CommonSettings adapt(const CommonSettings& settings) const;

    /// Takes `target` to the states that record() leaves it in. Throws rhi::Error, and `target` is as before.
    void plan(rhi::Device& device, TransferPipelines& pipelines, LayoutPolicy layoutPolicy, Pools& target);
    /// What was planned will not be recorded.
    void cancel(Pools& target) const;
    void record(rhi::CommandBuffer& commands) const;

    bool isPending() const { return m_source != nullptr; }
    /// Ends what is pending: `queue` has room for two more. `frame`: the one that recorded it.
    void finish(uint64_t frame, RetireQueue& queue);
    void drop(RetireQueue& queue) { finish(m_lastFrame, queue); }

private:
    struct Move
    {
        const rhi::Pipeline* pipeline;
        const rhi::DescriptorSet* set;
        uint32_t texture; // of the permanent pool
        uint32_t groups[2];
    };
    /// Descriptors of the moves, until the GPU is done with them.
    struct Sets final : Retirable
    {
        std::unique_ptr<rhi::DescriptorPool> pool;
    };
    void planMove(const rhi::Pipeline& pipeline, const rhi::TextureState& sampled, const Pools& target,
                  uint32_t texture);

    std::unique_ptr<Pools> m_source; // null once all is done
    uint32_t m_size[2];              // pixels, its resource size
    uint64_t m_lastFrame;
    std::unique_ptr<Sets> m_sets; // of the plan
    std::vector<Move> m_moves;
    std::vector<rhi::TextureBarrier> m_barriers;
};
} // namespace nrd
