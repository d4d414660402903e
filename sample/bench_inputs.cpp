#include "bench_inputs.h"

#include "bench_shaders.h"

#include "engine/commands.h"
#include "engine/transfer.h"

namespace sample::bench
{
namespace
{
constexpr uint32_t kGroupSize = 8;

engine::ComputePipeline makePipeline(const engine::Device& device, size_t setCount)
{
    const bench_shaders::ShaderBlob blob = bench_shaders::shaderBlob(bench_shaders::Shader::BenchTrace);
    engine::ComputeDesc desc;
    desc.name = blob.name;
    desc.words = blob.words;
    desc.byteSize = blob.byteSize;
    desc.pushConstantByteSize = sizeof(BenchConstants);
    desc.setCount = static_cast<uint32_t>(setCount);
    desc.bindings = {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
    return {device, desc};
}
} // namespace

Inputs::Inputs(const engine::Device& device, const std::vector<BenchSlot>& slots, const Workload& workload, Extent size)
{
    for (const BenchSlot& slot : slots)
    {
        if (slot.isOutput) continue;
        Sequence sequence{slot, {}};
        const Extent own = divided(size, slot.divisor);
        for (uint32_t i = 0; i < kInputFrameCount; i++)
            sequence.frames.emplace_back(
                device, engine::ImageDesc{std::string(nrd::toString(slot.type)) + " " + std::to_string(i), own.width,
                                          own.height, slot.format});
        m_sequences.push_back(std::move(sequence));
    }
    const engine::ComputePipeline pipeline = makePipeline(device, m_sequences.size() * kInputFrameCount);
    const auto record = [&](VkCommandBuffer cmd, Sequence& sequence, uint32_t frame)
    {
        engine::Image& image = sequence.frames[frame];
        BenchConstants constants = traceConstants(workload, size, frame);
        constants.target = {sequence.slot.content, sequence.slot.isSpecular ? 1u : 0u, sequence.slot.divisor, 0};
        engine::transition(cmd, image, engine::kStorage);
        pipeline.dispatch(cmd, pipeline.createSet({image}), std::as_bytes(std::span(&constants, 1)),
                          {engine::groupCount(size.width, kGroupSize), engine::groupCount(size.height, kGroupSize), 1});
        engine::transition(cmd, image, engine::kSampled);
    };
    // One submission per image: a slow device must not be taken for a hanging one.
    for (Sequence& sequence : m_sequences)
        for (uint32_t i = 0; i < kInputFrameCount; i++)
            engine::submitAndWait(device, [&](VkCommandBuffer cmd) { record(cmd, sequence, i); });
}

Inputs::Sequence* Inputs::find(nrd::ResourceType slot)
{
    for (Sequence& sequence : m_sequences)
        if (sequence.slot.type == slot) return &sequence;
    return nullptr;
}

engine::Image& Inputs::image(nrd::ResourceType slot, uint32_t inputFrame) { return find(slot)->frames.at(inputFrame); }

std::optional<double> Inputs::skyPercent(const engine::Device& device)
{
    Sequence* depth = find(nrd::ResourceType::IN_VIEWZ);
    if (!depth) return std::nullopt;
    size_t skyCount = 0, count = 0;
    for (engine::Image& image : depth->frames)
    {
        for (float viewZ : engine::readBackAs<float>(device, image)) skyCount += viewZ == kSkyViewZ ? 1 : 0;
        count += size_t(image.desc().width) * image.desc().height;
    }
    return 100.0 * static_cast<double>(skyCount) / static_cast<double>(count);
}
} // namespace sample::bench
