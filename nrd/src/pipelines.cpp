#include "pipelines.h"
#include "bindings.h"
#include <algorithm>

namespace nrd
{
uint32_t PipelineTable::constantNum(const Block& block)
{
    constexpr uint32_t kFixedNum = 4; // the encodings, the kind of device, and the step
    return block.hasConstants ? kFixedNum + static_cast<uint32_t>(block.switches.size()) : 0;
}

uint16_t PipelineTable::add(const Block& block)
{
    const auto isSameSwitch = [](const SwitchRow& a, const SwitchRow& b) { return a.constantId == b.constantId; };
    for (const Block& other : m_blocks)
    {
        if (other.shader == block.shader && other.step == block.step &&
            std::equal(other.switches.begin(), other.switches.end(), block.switches.begin(), block.switches.end(),
                       isSameSwitch))
        {
            return static_cast<uint16_t>(other.firstPipeline);
        }
    }
    Block& added = m_blocks.emplace_back(block);
    added.firstPipeline = m_pipelineNum;
    m_pipelineNum += pipelineNum(added);
    return static_cast<uint16_t>(added.firstPipeline);
}

uint16_t PipelineTable::add(const Pass& pass)
{
    Block block;
    block.shader = pass.shader;
    block.textureNum = static_cast<uint32_t>(pass.reads.size());
    block.storageTextureNum = static_cast<uint32_t>(pass.writes.size());
    block.switches = pass.switches;
    block.step = pass.row->step;
    return add(block);
}

uint16_t PipelineTable::addClear(Shader shader)
{
    Block block;
    block.shader = shader;
    block.storageTextureNum = 1;
    block.hasConstants = false;
    return add(block);
}

void PipelineTable::finish(std::pmr::vector<PipelineDesc>& pipelines,
                           std::pmr::vector<SpecializationConstant>& constants) const
{
    size_t total = 0;
    for (const Block& block : m_blocks) total += size_t{pipelineNum(block)} * constantNum(block);
    constants.reserve(total); // the descriptions point into it
    pipelines.reserve(m_pipelineNum);
    for (const Block& block : m_blocks)
    {
        const ShaderBlob blob = shaderBlob(block.shader);
        for (uint32_t bits = 0; bits < pipelineNum(block); bits++)
        {
            const SpecializationConstant* first = constants.data() + constants.size();
            if (block.hasConstants)
            {
                constants.push_back({SPEC_NORMAL_ENCODING, static_cast<uint32_t>(m_normalEncoding)});
                constants.push_back({SPEC_ROUGHNESS_ENCODING, static_cast<uint32_t>(m_roughnessEncoding)});
                constants.push_back({SPEC_IS_SOFTWARE, m_isSoftwareDevice ? 1u : 0u});
                constants.push_back({SPEC_STEP, block.step});
            }
            for (uint32_t i = 0; i < block.switches.size(); i++)
                constants.push_back({block.switches[i].constantId, (bits >> i) & 1u});
            const uint32_t num = constantNum(block);
            pipelines.push_back({blob.name,
                                 {blob.words, blob.byteSize},
                                 num > 0 ? first : nullptr,
                                 num,
                                 block.textureNum,
                                 block.storageTextureNum,
                                 0,
                                 block.hasConstants});
        }
    }
}
} // namespace nrd
