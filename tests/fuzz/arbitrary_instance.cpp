#include "arbitrary_instance.h"
#include "fuzz.h"

namespace fuzz
{
using namespace nrd;

namespace
{
// Each field is wild by itself: the first that is refused hides those after it.
DenoiserDesc arbitraryDenoiser(ByteReader& reader, uint32_t index)
{
    constexpr uint32_t kWildness = 64; // one in so many
    DenoiserDesc result;
    const auto isWild = [&] { return reader.below(kWildness) == 0; };
    result.identifier = isWild() ? arbitraryIdentifier(reader) : index;
    result.denoiser = isWild() ? reader.value<Denoiser>()
                               : static_cast<Denoiser>(reader.below(static_cast<uint32_t>(Denoiser::MAX_NUM)));
    if (reader.below(4) == 0) result.resolutionDivisor = isWild() ? reader.value<uint32_t>() : 1 + reader.below(8);
    // Beyond what some denoisers offer too.
    if (reader.below(4) == 0)
        result.fullSize = isWild() ? reader.value<FullSize>()
                                   : static_cast<FullSize>(reader.below(static_cast<uint32_t>(FullSize::MAX_NUM)));
    result.hasHistory = !isWild();
    return result;
}
} // namespace

void makeArbitrary(ArbitraryInstance& instance, ByteReader& reader, uint32_t& reportNum)
{
    InstanceCreationDesc& desc = instance.desc;
    desc = {};
    desc.denoisersNum = reader.below(kMaxDenoiserNum + 1);
    for (uint32_t i = 0; i < desc.denoisersNum; i++) instance.denoisers[i] = arbitraryDenoiser(reader, i);
    const auto isWild = [&] { return reader.below(64) == 0; };
    desc.denoisers = isWild() ? nullptr : instance.denoisers;
    if (isWild()) desc.headerVersion = reader.value<uint32_t>();
    desc.normalEncoding = isWild() ? reader.value<NormalEncoding>() : static_cast<NormalEncoding>(reader.below(5));
    desc.roughnessEncoding =
        isWild() ? reader.value<RoughnessEncoding>() : static_cast<RoughnessEncoding>(reader.below(3));
    if (reader.below(4) == 0) desc.confidenceTileSize = isWild() ? reader.value<uint32_t>() : reader.below(9);
    desc.isSoftwareDevice = reader.below(2) == 1;
    desc.messageSink.userArg = &reportNum;
    desc.messageSink.report = [](void* userArg, Result result, const char* text)
    {
        require(result != Result::SUCCESS && text && *text, "a report is a sentence about a refusal");
        ++*static_cast<uint32_t*>(userArg);
    };
}

Identifier arbitraryIdentifier(ByteReader& reader)
{
    return reader.below(16) == 0 ? kConfidenceIdentifier : reader.below(kIdentifierNum);
}
} // namespace fuzz
