// A request -> dispatches, in memory reserved at creation.
#include "instance.h"
#include <algorithm>
#include <cstring>
#include <iterator>

namespace nrd
{
namespace
{
constexpr uint32_t kClearGroupSize = 16;

uint32_t divideUp(uint32_t a, uint32_t b) { return (a + b - 1) / b; }

// A cut that nobody announced: the camera looks elsewhere, or the "previous" view is not the one of the last request.
bool isCut(const CommonSettings& common, const RequestHistory& last)
{
    constexpr double kMinOverlap = 0.1;
    constexpr double kMaxMismatch = 30.0; // degrees
    if (!common.enableCutDetection || !last.isValid) return false;
    return findViewOverlap(common) < kMinOverlap ||
           angleBetween(common.worldToViewMatrixPrev, last.worldToView) > kMaxMismatch;
}

// A texture that one dispatch both reads and writes needs one state for both.
void mergeStates(ResourceDesc* resources, size_t num)
{
    const auto isSame = [](const ResourceDesc& a, const ResourceDesc& b)
    { return a.type == b.type && a.indexInPool == b.indexInPool; };
    for (size_t i = 0; i < num; i++)
    {
        for (size_t j = i + 1; j < num; j++)
        {
            if (!isSame(resources[i], resources[j]) || resources[i].descriptorType == resources[j].descriptorType)
                continue;
            resources[i].state = resources[j].state = ResourceState::SAMPLED_AND_STORAGE;
        }
    }
}
} // namespace

void Instance::push(const CompiledDenoiser& denoiser, const Binding& binding, DescriptorType descriptorType)
{
    const ResourceState state =
        descriptorType == DescriptorType::TEXTURE ? ResourceState::SAMPLED : ResourceState::STORAGE;
    ResourceDesc resource = {descriptorType, state, binding.type, 0};
    if (binding.isTexture())
    {
        // Odd requests write the second of a pair and read the first as the previous one.
        const PoolPlace& place = denoiser.places[binding.texture];
        const bool isOdd = (denoiser.history.requestNum & 1u) != 0;
        resource.type = place.pool;
        resource.indexInPool = isOdd != binding.isPrevious ? place.pairedIndex : place.index;
    }
    m_resources.push_back(resource);
}

void Instance::emitClears(const CompiledDenoiser& denoiser)
{
    for (const ClearTarget& clear : denoiser.clears)
    {
        DispatchDesc dispatch = {};
        dispatch.name = denoiser.clearName.c_str();
        dispatch.identifier = denoiser.identifier;
        dispatch.pipelineIndex = clear.pipeline;
        dispatch.resources = m_resources.data() + m_resources.size();
        dispatch.resourcesNum = 1;
        dispatch.gridWidth = divideUp(divideUp(m_common.resourceSize[0], clear.downsampleFactor), kClearGroupSize);
        dispatch.gridHeight = divideUp(divideUp(m_common.resourceSize[1], clear.downsampleFactor), kClearGroupSize);
        dispatch.indirectBufferIndex = kNoBuffer;
        m_resources.push_back(clear.resource);
        m_dispatches.push_back(dispatch);
    }
}

void Instance::emitPass(const CompiledDenoiser& denoiser, size_t index, const Conditions& conditions)
{
    const Pass& pass = denoiser.program.passes[index];
    const size_t firstResource = m_resources.size();
    for (const BoundSlot& slot : pass.reads) push(denoiser, slot.pick(conditions), DescriptorType::TEXTURE);
    for (const BoundSlot& slot : pass.writes) push(denoiser, slot.pick(conditions), DescriptorType::STORAGE_TEXTURE);
    mergeStates(m_resources.data() + firstResource, m_resources.size() - firstResource);

    DispatchDesc dispatch = {};
    dispatch.name = denoiser.passNames[index].c_str();
    dispatch.identifier = denoiser.identifier;
    dispatch.pipelineIndex = denoiser.pipelines[index];
    for (uint32_t i = 0; i < pass.switches.size(); i++)
    {
        const uint32_t bit = pass.switches[i].isOn(conditions) ? 1u << i : 0u;
        dispatch.pipelineIndex = static_cast<uint16_t>(dispatch.pipelineIndex + bit);
    }
    dispatch.resources = m_resources.data() + firstResource;
    dispatch.resourcesNum = static_cast<uint32_t>(m_resources.size() - firstResource);

    const uint32_t byteSize = denoiser.program.family->constantByteSize;
    const DispatchDesc* last = m_dispatches.empty() ? nullptr : &m_dispatches.back();
    dispatch.constantBufferData = m_constantBlock;
    dispatch.constantBufferDataSize = byteSize;
    dispatch.constantBufferDataMatchesPreviousDispatch =
        last && last->constantBufferDataSize == byteSize &&
        (last->constantBufferData == m_constantBlock ||
         std::memcmp(last->constantBufferData, m_constantBlock, byteSize) == 0);

    const CommonSettings& common = pass.row->isFullSize ? m_common : conditions.common;
    const uint16_t(&extent)[2] = denoiser.program.family->spansResource ? common.resourceSize : common.rectSize;
    dispatch.gridWidth = divideUp(divideUp(extent[0], pass.row->gridFactor), pass.row->group.x);
    dispatch.gridHeight = divideUp(divideUp(extent[1], pass.row->gridFactor), pass.row->group.y);
    dispatch.indirectBufferIndex = kNoBuffer;
    m_dispatches.push_back(dispatch);
}

const uint8_t* Instance::emitConstants(const CompiledDenoiser& denoiser, const Request& request)
{
    uint8_t* block = m_constants.data() + kConstantMaxByteSize * m_constantBlockNum++;
    std::memset(block, 0, kConstantMaxByteSize);
    denoiser.program.family->fillConstants(request, block);
    return block;
}

void Instance::emit(CompiledDenoiser& denoiser)
{
    const RequestHistory& last = denoiser.history;
    const AccumulationMode mode = m_common.accumulationMode;
    const bool isCleared = !last.isCleared || mode == AccumulationMode::CLEAR_AND_RESTART;
    const bool isReset = isCleared || !last.isValid || mode == AccumulationMode::RESTART || isCut(m_common, last);

    const Program& program = denoiser.program;
    const uint32_t divisor = denoiser.resolutionDivisor;
    const CommonSettings resized =
        program.isUpsampled() ? atPickedPixels(m_common, divisor) : atResolution(m_common, divisor);
    const CommonSettings common = isReset ? withoutPreviousFrame(resized) : resized;
    const FrameState frame = makeFrameState(common, m_frameRateScale);
    const Variant& variant = *program.variant;
    const CommonSettings& full = program.isUpsampled() ? m_common : common;
    const uint32_t guideStride = program.isUpsampled() ? divisor : 1;
    const uint32_t signalStride = program.isDownsampled() ? divisor : 1;
    const Request request = {common, full, denoiser.settings, frame, last, variant, isReset, guideStride, signalStride};
    m_constantBlock = emitConstants(denoiser, request);

    if (isCleared) emitClears(denoiser);
    const Conditions conditions = {common, denoiser.settings, m_desc.normalEncoding, variant};
    for (size_t i = 0; i < denoiser.program.passes.size(); i++)
    {
        if (denoiser.program.passes[i].row->runsIf(conditions)) emitPass(denoiser, i, conditions);
    }

    RequestHistory next = program.family->advance(request);
    next.requestNum = last.requestNum + 1;
    std::copy(std::begin(m_common.worldToViewMatrix), std::end(m_common.worldToViewMatrix), next.worldToView);
    next.isCleared = true;
    denoiser.history = next;
    denoiser.isRequested = true;
}
} // namespace nrd
