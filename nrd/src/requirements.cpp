// Which user-pool slots a denoiser needs, and in which format: derived from its passes.
#include "instance.h"
#include <algorithm>

namespace nrd
{
namespace
{
// The smallest format that keeps what the slot carries.
Format minFormat(ResourceType type, const Conditions& c)
{
    const CommonSettings& common = c.common;
    const bool hasMotionZ = common.isMotionVectorInWorldSpace || common.motionVectorScale[2] != 0.0f;
    switch (type)
    {
    case ResourceType::IN_MV:
        return hasMotionZ ? Format::RGBA16_SFLOAT : Format::RG16_SFLOAT;
    case ResourceType::IN_NORMAL_ROUGHNESS:
    case ResourceType::IN_STORED_NORMAL_ROUGHNESS:
        return guideFormat(c.normalEncoding);
    case ResourceType::IN_VIEWZ:
    case ResourceType::IN_PENUMBRA:
        return Format::R16_SFLOAT;
    case ResourceType::IN_DIFF_CONFIDENCE:
    case ResourceType::IN_SPEC_CONFIDENCE:
    case ResourceType::IN_DISOCCLUSION_THRESHOLD_MIX:
    case ResourceType::IN_DIFF_HITDIST:
    case ResourceType::IN_SPEC_HITDIST:
    case ResourceType::OUT_DIFF_HITDIST:
    case ResourceType::OUT_SPEC_HITDIST:
        return Format::R8_UNORM;
    case ResourceType::IN_DIFF_DIRECTION_HITDIST:
        return Format::RGBA8_SNORM;
    case ResourceType::OUT_DIFF_DIRECTION_HITDIST:
        return Format::RGBA16_SNORM;
    case ResourceType::IN_TRANSLUCENCY:
    case ResourceType::OUT_VALIDATION:
        return Format::RGBA8_UNORM;
    case ResourceType::OUT_SHADOW_TRANSLUCENCY:
        return has(c.variant, kTranslucentShadow) ? Format::RGBA8_UNORM : Format::R8_UNORM;
    case ResourceType::IN_SIGNAL:
    case ResourceType::OUT_SIGNAL:
        return Format::R8_UNORM;
    case ResourceType::IN_SPEC_MV:
    case ResourceType::IN_STORED_SAMPLE:
    case ResourceType::IN_RETRACED_SAMPLE:
    case ResourceType::IN_DIFF_RADIANCE_HITDIST:
    case ResourceType::IN_SPEC_RADIANCE_HITDIST:
    case ResourceType::IN_DIFF_SH0:
    case ResourceType::IN_DIFF_SH1:
    case ResourceType::IN_SPEC_SH0:
    case ResourceType::IN_SPEC_SH1:
    case ResourceType::OUT_DIFF_RADIANCE_HITDIST:
    case ResourceType::OUT_SPEC_RADIANCE_HITDIST:
    case ResourceType::OUT_DIFF_SH0:
    case ResourceType::OUT_DIFF_SH1:
    case ResourceType::OUT_SPEC_SH0:
    case ResourceType::OUT_SPEC_SH1:
        return Format::RGBA16_SFLOAT;
    case ResourceType::TRANSIENT_POOL:
    case ResourceType::PERMANENT_POOL:
    case ResourceType::MAX_NUM:
        break;
    }
    return Format::MAX_NUM;
}

struct Need
{
    bool isBound = false;    // in some pass under some settings
    bool isRequired = false; // under the present ones
};

constexpr size_t kUserSlotNum = static_cast<size_t>(ResourceType::TRANSIENT_POOL);

// Where the denoiser is smaller than the guides.
bool isFullSize(ResourceType type, const Program& program)
{
    if (!program.isUpsampled()) return false;
    const auto& signals = program.variant->signals;
    const auto hasOutput = [type](const SignalRow& signal) { return signal.output == type; };
    const auto hasInput = [type](const SignalRow& signal) { return signal.input == type; };
    const bool isGuide =
        type == ResourceType::IN_MV || type == ResourceType::IN_NORMAL_ROUGHNESS || type == ResourceType::IN_VIEWZ;
    if (isGuide || std::any_of(signals.begin(), signals.end(), hasOutput)) return true;
    const bool isTraced = type == ResourceType::IN_SPEC_MV || std::any_of(signals.begin(), signals.end(), hasInput);
    return isTraced && program.isDownsampled();
}

template <class Slots>
void addNeeds(const Slots& slots, bool isRunning, const Conditions& conditions, Need (&needs)[kUserSlotNum])
{
    for (const BoundSlot& slot : slots)
    {
        for (const BoundChoice& choice : slot.choices)
            if (!choice.binding.isTexture()) needs[static_cast<size_t>(choice.binding.type)].isBound = true;
        const Binding& picked = slot.pick(conditions);
        if (isRunning && !picked.isTexture()) needs[static_cast<size_t>(picked.type)].isRequired = true;
    }
}
} // namespace

Result Instance::getRequiredResources(Identifier identifier, const ResourceRequirement*& requirements,
                                      uint32_t& num) const
{
    requirements = nullptr;
    num = 0;
    const CompiledDenoiser* denoiser = nullptr;
    for (const CompiledDenoiser& candidate : m_compiled.denoisers)
    {
        if (candidate.identifier == identifier) denoiser = &candidate;
    }
    if (!denoiser) return fail(unknownIdentifier(identifier));

    const Program& program = denoiser->program;
    const Conditions conditions = {m_common, denoiser->settings, m_desc.normalEncoding, *program.variant};
    m_requirements.clear();
    Need reads[kUserSlotNum], writes[kUserSlotNum];
    for (const Pass& pass : program.passes)
    {
        const bool isRunning = pass.row->runsIf(conditions);
        addNeeds(pass.reads, isRunning, conditions, reads);
        addNeeds(pass.writes, isRunning, conditions, writes);
    }
    for (size_t i = 0; i < kUserSlotNum; i++) // inputs come before outputs
    {
        const ResourceType type = static_cast<ResourceType>(i);
        const Need &read = reads[i], &written = writes[i];
        if (!read.isBound && !written.isBound) continue;
        m_requirements.push({type, written.isBound ? DescriptorType::STORAGE_TEXTURE : DescriptorType::TEXTURE,
                             read.isRequired || written.isRequired, read.isBound && written.isBound,
                             minFormat(type, conditions),
                             isFullSize(type, program) ? 1u : denoiser->resolutionDivisor});
    }
    requirements = m_requirements.begin();
    num = static_cast<uint32_t>(m_requirements.size());
    return Result::SUCCESS;
}
} // namespace nrd
