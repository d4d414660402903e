// REFERENCE: the progressive mean of any signal, for measuring denoisers and samplers.
#include "reference.h"
#include "families.h"
#include "frame_state.h"
#include "reference_constants.h"
#include <algorithm>
#include <cstring>
#include <iterator>

namespace nrd
{
namespace
{
enum Tex : uint8_t
{
    Mean
};

constexpr TextureRow kTextures[] = {
    {Mean, "Mean", fixed(Format::RGBA32_SFLOAT), Lifetime::Permanent},
};
static_assert(rowsMatchKeys(kTextures));

bool always(const Conditions&) { return true; }

// The mean is updated in place: each invocation reads and writes its own texel only.
constexpr PassRow kPasses[] = {
    {"Accumulate", Shader::ReferenceAccumulate, {ResourceType::IN_SIGNAL, Mean}, {Mean}, {16, 16}, always},
    {"Copy", Shader::ReferenceCopy, {Mean}, {ResourceType::OUT_SIGNAL}, {16, 16}, always},
};

constexpr SignalRow kSignal = {ResourceType::IN_SIGNAL, ResourceType::OUT_SIGNAL, Format::RGBA32_SFLOAT, kNoLobe};

constexpr Variant kVariants[] = {
    {Denoiser::REFERENCE, kNoLobe, kRadiance, {kSignal}},
};
static_assert(shadersMatchVariants(kPasses, kVariants));

// Another camera, another size or the application's word; what moves in the scene is not noticed.
bool isRestarted(const Request& request)
{
    const RequestHistory& last = request.history;
    return request.isReset ||
           !std::equal(std::begin(last.rectSize), std::end(last.rectSize), request.common.rectSize) ||
           !std::equal(std::begin(last.worldToClip), std::end(last.worldToClip), request.frame.worldToClipAbsolute.m);
}

void fillConstants(const Request& request, void* block)
{
    const shared::ReferenceConstants constants = makeReferenceConstants(request);
    std::memcpy(block, &constants, sizeof(constants));
}

RequestHistory advance(const Request& request)
{
    RequestHistory next = request.history;
    next.isValid = true;
    next.meanFrameNum = findMeanFrameNum(request);
    std::copy(std::begin(request.common.rectSize), std::end(request.common.rectSize), next.rectSize);
    std::copy(std::begin(request.frame.worldToClipAbsolute.m), std::end(request.frame.worldToClipAbsolute.m),
              next.worldToClip);
    return next;
}
} // namespace

uint32_t findMeanFrameNum(const Request& request)
{
    constexpr uint32_t kMaxFrameNum = 4095;
    const uint32_t maxFrameNum = std::get<ReferenceSettings>(request.settings).maxAccumulatedFrameNum;
    if (isRestarted(request)) return 0;
    return std::min({request.history.meanFrameNum + 1, maxFrameNum, kMaxFrameNum});
}

shared::ReferenceConstants makeReferenceConstants(const Request& request)
{
    shared::ReferenceConstants constants = {};
    constants.rectSize = {static_cast<float>(request.common.rectSize[0]),
                          static_cast<float>(request.common.rectSize[1])};
    constants.splitScreen = request.common.splitScreen;
    constants.weight = 1.0f / static_cast<float>(1 + findMeanFrameNum(request));
    return constants;
}

// The output may be the very image that holds the input, so it is never cleared.
const Family kReference = {
    ReferenceSettings{}, kVariants, kTextures, kPasses, sizeof(shared::ReferenceConstants), false,
    fillConstants,       advance};
} // namespace nrd
