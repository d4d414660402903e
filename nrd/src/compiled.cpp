#include "compiled.h"
#include "bindings.h"
#include "denoisers/families.h"
#include "pipelines.h"
#include "pool_planner.h"
#include <algorithm>

namespace nrd
{
namespace
{
using Memory = std::pmr::memory_resource;

uint16_t factorOf(const CompiledDenoiser& denoiser, const Texture& texture)
{
    const uint32_t factor = uint32_t{texture.row->downsampleFactor} * denoiser.resolutionDivisor;
    return static_cast<uint16_t>(std::min(factor, uint32_t{kOneTexel}));
}

uint16_t outputDivisor(const CompiledDenoiser& denoiser)
{
    return denoiser.program.isUpsampled() ? uint16_t{1} : denoiser.resolutionDivisor;
}

void addPermanentTextures(CompiledDenoiser& denoiser, std::pmr::vector<TextureDesc>& pool)
{
    for (const Texture& texture : denoiser.program.textures)
    {
        const TextureDesc desc = {texture.format, factorOf(denoiser, texture)};
        PoolPlace place = {ResourceType::PERMANENT_POOL, static_cast<uint16_t>(pool.size()), 0};
        switch (texture.row->lifetime)
        {
        case Lifetime::Transient:
        case Lifetime::Lent:
            place.pool = ResourceType::TRANSIENT_POOL;
            break;
        case Lifetime::Permanent:
            pool.push_back(desc);
            break;
        case Lifetime::PingPong:
            pool.insert(pool.end(), 2, desc);
            break;
        }
        place.pairedIndex = texture.row->lifetime == Lifetime::PingPong ? place.index + 1 : place.index;
        denoiser.places.push(place);
    }
}

// Denoisers run one after another, so the passes of all of them are numbered through.
void placeTransientTextures(Compiled& compiled, Memory* memory)
{
    std::pmr::vector<TransientTexture> textures(memory);
    std::pmr::vector<PoolPlace*> places(memory);
    uint32_t firstPass = 0;
    for (CompiledDenoiser& denoiser : compiled.denoisers)
    {
        const Program& program = denoiser.program;
        for (size_t i = 0; i < program.textures.size(); i++)
        {
            if (!program.textures[i].isTransient()) continue;
            const Life life = lifeOf(program, i);
            textures.push_back({program.textures[i].format, factorOf(denoiser, program.textures[i]),
                                firstPass + life.first, firstPass + life.last});
            places.push_back(&denoiser.places[i]);
        }
        firstPass += static_cast<uint32_t>(program.passes.size());
    }
    const PoolPlan plan = planPool(textures, memory);
    for (size_t i = 0; i < places.size(); i++) places[i]->index = places[i]->pairedIndex = plan.indices[i];
    compiled.transientPool.assign(plan.pool.begin(), plan.pool.end());
}

bool isInteger(Format format)
{
    return format == Format::R8_UINT || format == Format::RG8_UINT || format == Format::R16_UINT ||
           format == Format::R32_UINT || format == Format::RG32_UINT;
}

class ClearPlanner
{
public:
    ClearPlanner(CompiledDenoiser& denoiser, PipelineTable& pipelines) : m_denoiser(denoiser), m_pipelines(pipelines) {}

    void add(const Binding& binding)
    {
        if (!binding.isTexture())
        {
            if (m_denoiser.program.family->areOutputsCleared && isSignal(binding.type))
                add(binding.type, 0, Format::RGBA16_SFLOAT, outputDivisor(m_denoiser));
            return;
        }
        const Texture& texture = m_denoiser.program.textures[binding.texture];
        const PoolPlace& place = m_denoiser.places[binding.texture];
        add(place.pool, place.index, texture.format, factorOf(m_denoiser, texture));
        add(place.pool, place.pairedIndex, texture.format, factorOf(m_denoiser, texture));
    }

private:
    // What else a user may bind is there only at times, and written whole by its pass.
    bool isSignal(ResourceType type) const
    {
        const auto& signals = m_denoiser.program.variant->signals;
        const auto isOutput = [type](const SignalRow& signal) { return signal.output == type; };
        return std::any_of(signals.begin(), signals.end(), isOutput);
    }

    void add(ResourceType type, uint16_t index, Format format, uint16_t factor)
    {
        for (const ClearTarget& clear : m_denoiser.clears)
        {
            if (clear.resource.type == type && clear.resource.indexInPool == index) return;
        }
        const Shader shader = isInteger(format) ? Shader::ClearUint : Shader::ClearFloat;
        m_denoiser.clears.push({{DescriptorType::STORAGE_TEXTURE, ResourceState::STORAGE, type, index},
                                m_pipelines.addClear(shader),
                                factor});
    }

    CompiledDenoiser& m_denoiser;
    PipelineTable& m_pipelines;
};

void addPipelinesAndClears(CompiledDenoiser& denoiser, PipelineTable& pipelines)
{
    ClearPlanner clears(denoiser, pipelines);
    for (const Pass& pass : denoiser.program.passes)
    {
        denoiser.pipelines.push(pipelines.add(pass));
        for (const BoundSlot& slot : pass.writes)
        {
            for (const BoundChoice& choice : slot.choices) clears.add(choice.binding);
        }
    }
}

void addNames(CompiledDenoiser& denoiser)
{
    const char* name = nameOf(*denoiser.program.variant);
    denoiser.clearName << name << " - Clear";
    for (const Pass& pass : denoiser.program.passes) denoiser.passNames.push(Name() << name << " - " << pass.row->name);
}

void addTotals(const CompiledDenoiser& denoiser, Compiled& compiled)
{
    DescriptorPoolDesc& totals = compiled.totals;
    for (const Pass& pass : denoiser.program.passes)
    {
        totals.setsMaxNum += 2; // constants and samplers; resources
        totals.constantBuffersMaxNum += 1;
        totals.samplersMaxNum += static_cast<uint32_t>(Sampler::MAX_NUM);
        totals.texturesMaxNum += static_cast<uint32_t>(pass.reads.size());
        totals.storageTexturesMaxNum += static_cast<uint32_t>(pass.writes.size());
        compiled.resourceMaxNum += static_cast<uint32_t>(pass.reads.size() + pass.writes.size());
    }
    const uint32_t clearNum = static_cast<uint32_t>(denoiser.clears.size());
    totals.setsMaxNum += clearNum;
    totals.storageTexturesMaxNum += clearNum;
    compiled.resourceMaxNum += clearNum;
    compiled.dispatchMaxNum += static_cast<uint32_t>(denoiser.program.passes.size()) + clearNum;
}

DenoiserInfo makeInfo(const CompiledDenoiser& denoiser)
{
    const auto isPingPong = [](const Texture& texture) { return texture.row->lifetime == Lifetime::PingPong; };
    const auto& textures = denoiser.program.textures;
    const bool hasPairs = std::any_of(textures.begin(), textures.end(), isPingPong);
    return {denoiser.identifier, denoiser.program.variant->key, hasPairs ? 2u : 1u};
}
} // namespace

Compiled::Compiled(Memory* memory)
    : denoisers(memory), infos(memory), pipelines(memory), constants(memory), permanentPool(memory),
      transientPool(memory)
{
}

void compile(const InstanceCreationDesc& desc, Compiled& compiled)
{
    Memory* memory = compiled.denoisers.get_allocator().resource();
    PipelineTable pipelines(desc, memory);
    compiled.denoisers.reserve(desc.denoisersNum + 1);
    const auto add = [&](Identifier identifier, uint32_t divisor, FullSize fullSize, const VariantOfFamily& which)
    {
        CompiledDenoiser& denoiser = compiled.denoisers.emplace_back();
        denoiser.identifier = identifier;
        denoiser.resolutionDivisor = static_cast<uint16_t>(divisor);
        denoiser.program = expand(which, desc.normalEncoding, fullSize);
        denoiser.settings = denoiser.program.family->defaults;
        addPermanentTextures(denoiser, compiled.permanentPool);
    };
    for (uint32_t i = 0; i < desc.denoisersNum; i++)
        add(desc.denoisers[i].identifier, desc.denoisers[i].resolutionDivisor, fullSizeOf(desc.denoisers[i]),
            findVariant(desc.denoisers[i].denoiser, keptBy(desc.denoisers[i])));
    if (desc.confidenceTileSize > 0)
        add(kConfidenceIdentifier, desc.confidenceTileSize, FullSize::NOTHING, {&kHistoryConfidence, 0});
    placeTransientTextures(compiled, memory);
    for (CompiledDenoiser& denoiser : compiled.denoisers)
    {
        addPipelinesAndClears(denoiser, pipelines);
        addNames(denoiser);
        addTotals(denoiser, compiled);
        if (denoiser.identifier != kConfidenceIdentifier) compiled.infos.push_back(makeInfo(denoiser));
    }
    pipelines.finish(compiled.pipelines, compiled.constants);
}
} // namespace nrd
