#include "instance.h"
#include "bindings.h"
#include <algorithm>
#include <chrono>

namespace nrd
{
namespace
{
constexpr Sampler kSamplers[] = {Sampler::NEAREST_CLAMP, Sampler::LINEAR_CLAMP};
static_assert(std::size(kSamplers) == static_cast<size_t>(Sampler::MAX_NUM));

double monotonicTime() // ms
{
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(now).count();
}

} // namespace

Error unknownIdentifier(Identifier identifier)
{
    Error error;
    error.result = Result::INVALID_ARGUMENT;
    if (identifier == kConfidenceIdentifier)
        error.text << "InstanceCreationDesc::confidenceTileSize is 0, expected [1; 8] where confidence is made";
    else
        error.text << "identifier is " << identifier << ", expected one of InstanceCreationDesc::denoisers";
    return error;
}

Result report(const MessageSink& sink, const Error& error)
{
    if (sink.report) sink.report(sink.userArg, error.result, error.text.c_str());
    return error.result;
}

Instance::Instance(const InstanceCreationDesc& desc)
    : m_allocationCallbacks(desc.allocationCallbacks), m_messageSink(desc.messageSink),
      m_memory(desc.allocationCallbacks), m_compiled(&m_memory), m_dispatches(&m_memory), m_resources(&m_memory),
      m_constants(&m_memory)
{
    compile(desc, m_compiled);
    m_dispatches.reserve(m_compiled.dispatchMaxNum);
    m_resources.reserve(m_compiled.resourceMaxNum);
    m_constants.resize(m_compiled.denoisers.size() * kConstantMaxByteSize);
    describe(desc);
}

void Instance::describe(const InstanceCreationDesc& desc)
{
    uint32_t constantByteSize = 0;
    for (const CompiledDenoiser& denoiser : m_compiled.denoisers)
        constantByteSize = std::max(constantByteSize, denoiser.program.family->constantByteSize);

    m_desc.constantsAndSamplersSet = SET_CONSTANTS;
    m_desc.constantBufferBinding = BINDING_CONSTANTS;
    m_desc.samplersBaseBinding = BINDING_SAMPLERS;
    m_desc.resourcesSet = SET_RESOURCES;
    m_desc.constantBufferMaxDataSize = constantByteSize;
    m_desc.shaderEntryPoint = "main";
    m_desc.samplers = kSamplers;
    m_desc.samplersNum = static_cast<uint32_t>(std::size(kSamplers));
    m_desc.pipelines = m_compiled.pipelines.data();
    m_desc.pipelinesNum = static_cast<uint32_t>(m_compiled.pipelines.size());
    m_desc.permanentPool = m_compiled.permanentPool.data();
    m_desc.permanentPoolSize = static_cast<uint32_t>(m_compiled.permanentPool.size());
    m_desc.transientPool = m_compiled.transientPool.data();
    m_desc.transientPoolSize = static_cast<uint32_t>(m_compiled.transientPool.size());
    m_desc.denoisers = m_compiled.infos.data();
    m_desc.denoisersNum = static_cast<uint32_t>(m_compiled.infos.size());
    m_desc.descriptorPoolDesc = m_compiled.totals;
    m_desc.normalEncoding = desc.normalEncoding;
    m_desc.roughnessEncoding = desc.roughnessEncoding;
}

Result Instance::fail(const Error& error) const
{
    m_lastMessage = error.text;
    return report(m_messageSink, error);
}

CompiledDenoiser* Instance::find(Identifier identifier)
{
    for (CompiledDenoiser& denoiser : m_compiled.denoisers)
    {
        if (denoiser.identifier == identifier) return &denoiser;
    }
    return nullptr;
}

Result Instance::setCommonSettings(const CommonSettings& settings)
{
    if (const Error error = findError(settings, m_desc.normalEncoding)) return fail(error);
    m_common = settings;
    m_hasCommon = true;
    m_clock = tick(m_clock, settings.frameIndex, monotonicTime());
    const double given = settings.timeDeltaBetweenFrames;
    m_frameRateScale = frameRateScale(given > 0.0 ? given : m_clock.smoothed);
    for (CompiledDenoiser& denoiser : m_compiled.denoisers) denoiser.isRequested = false;
    return Result::SUCCESS;
}

namespace
{
// Half of a signal is no signal whose pixels could be averaged.
template <class Settings> Error findCheckerboardError(const CompiledDenoiser& denoiser, const Settings& settings)
{
    Error error;
    if constexpr (requires { settings.checkerboardMode; })
    {
        if (!denoiser.program.isDownsampled() || settings.checkerboardMode == CheckerboardMode::OFF) return error;
        error.result = Result::INVALID_ARGUMENT;
        error.text << "checkerboardMode is " << static_cast<uint32_t>(settings.checkerboardMode)
                   << ", expected 0 (OFF) where DenoiserDesc::fullSize is EVERYTHING, as of identifier "
                   << denoiser.identifier;
    }
    return error;
}
} // namespace

template <class Settings> Result Instance::setDenoiserSettings(Identifier identifier, const Settings& settings)
{
    CompiledDenoiser* denoiser = find(identifier);
    if (!denoiser) return fail(unknownIdentifier(identifier));
    if (!std::holds_alternative<Settings>(denoiser->settings))
    {
        Error error;
        error.result = Result::INVALID_ARGUMENT;
        error.text << "settings are of another family than identifier " << identifier << ", which is "
                   << nameOf(*denoiser->program.variant);
        return fail(error);
    }
    if (const Error error = findError(settings)) return fail(error);
    if (const Error error = findCheckerboardError(*denoiser, settings)) return fail(error);
    denoiser->settings = settings;
    return Result::SUCCESS;
}
template Result Instance::setDenoiserSettings(Identifier, const ReblurSettings&);
template Result Instance::setDenoiserSettings(Identifier, const RelaxSettings&);
template Result Instance::setDenoiserSettings(Identifier, const SigmaSettings&);
template Result Instance::setDenoiserSettings(Identifier, const ReferenceSettings&);
template Result Instance::setDenoiserSettings(Identifier, const ConfidenceSettings&);

Error Instance::findRequestError(const Identifier* identifiers, uint32_t num)
{
    Error error;
    error.result = Result::INVALID_ARGUMENT;
    if (!m_hasCommon)
    {
        error.text << "CommonSettings are not set, expected SetCommonSettings before GetComputeDispatches";
        return error;
    }
    if (!identifiers && num > 0)
    {
        error.text << "identifiers is null, expected " << num << " elements";
        return error;
    }
    for (uint32_t i = 0; i < num; i++)
    {
        const CompiledDenoiser* denoiser = find(identifiers[i]);
        if (!denoiser) return unknownIdentifier(identifiers[i]);
        const bool isRepeated = std::find(identifiers, identifiers + i, identifiers[i]) != identifiers + i;
        // Without history one denoiser serves any number of lights; each call overwrites the dispatches of the last.
        const bool mayReturn = denoiser->program.variant->keeps == Keeps::Nothing;
        if (!isRepeated && (!denoiser->isRequested || mayReturn)) continue;
        error.text << "identifiers[" << i << "] is " << identifiers[i]
                   << " again, expected each identifier once per SetCommonSettings";
        return error;
    }
    return {};
}

Result Instance::getComputeDispatches(const Identifier* identifiers, uint32_t num, const DispatchDesc*& dispatches,
                                      uint32_t& dispatchNum)
{
    dispatches = nullptr;
    dispatchNum = 0;
    if (const Error error = findRequestError(identifiers, num)) return fail(error);
    m_dispatches.clear();
    m_resources.clear();
    m_constantBlockNum = 0;
    for (uint32_t i = 0; i < num; i++) emit(*find(identifiers[i]));
    dispatches = m_dispatches.data();
    dispatchNum = static_cast<uint32_t>(m_dispatches.size());
    return Result::SUCCESS;
}
} // namespace nrd
