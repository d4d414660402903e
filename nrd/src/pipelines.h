// One pipeline per shader and combination of its pass's switches, whichever denoisers use it.
#pragma once
#include "expand.h"
#include <memory_resource>
#include <nrd/descs.h>
#include <vector>

namespace nrd
{
class PipelineTable
{
public:
    PipelineTable(const InstanceCreationDesc& desc, std::pmr::memory_resource* memory)
        : m_blocks(memory), m_normalEncoding(desc.normalEncoding), m_roughnessEncoding(desc.roughnessEncoding),
          m_isSoftwareDevice(desc.isSoftwareDevice)
    {
    }

    // Index of the pass's pipeline with all switches off; add bit i for switch i.
    uint16_t add(const Pass& pass);
    uint16_t addClear(Shader shader);

    // The descriptions point into the constants. Throws std::bad_alloc, as the others do.
    void finish(std::pmr::vector<PipelineDesc>& pipelines, std::pmr::vector<SpecializationConstant>& constants) const;

private:
    // All combinations of the switches of one shader lie one after another.
    struct Block
    {
        Shader shader = Shader::Count;
        uint32_t textureNum = 0;
        uint32_t storageTextureNum = 0;
        bool hasConstants = true;
        uint8_t step = 0;
        FixedList<SwitchRow, 5> switches;
        uint32_t firstPipeline = 0;
    };
    uint16_t add(const Block& block);
    static uint32_t pipelineNum(const Block& block) { return 1u << block.switches.size(); }
    static uint32_t constantNum(const Block& block);

    std::pmr::vector<Block> m_blocks;
    uint32_t m_pipelineNum = 0;
    NormalEncoding m_normalEncoding;
    RoughnessEncoding m_roughnessEncoding;
    bool m_isSoftwareDevice;
};
} // namespace nrd
