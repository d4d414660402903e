// Every misuse of every public call is refused, changes nothing, and the sentence names field, value and expectation.
#include "fixture.h"
#include <cmath>
#include <functional>
#include <limits>

using namespace test;

namespace
{
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <class Settings> struct Misuse
{
    std::string field;
    std::function<void(Settings&)> change;
    std::string value = ""; // as printed, empty = not printed
    Result result = Result::INVALID_ARGUMENT;
};

// Runs every misuse against a setter that starts from good settings.
template <class Settings, class Setter>
void checkMisuses(const std::vector<Misuse<Settings>>& misuses, const Settings& good, const char* structName,
                  Messages& messages, const Setter& set)
{
    REQUIRE(set(good) == Result::SUCCESS);
    for (const Misuse<Settings>& misuse : misuses)
    {
        Settings bad = good;
        misuse.change(bad);
        messages.texts.clear();
        INFO(misuse.field << " " << misuse.value);
        CHECK(set(bad) == misuse.result);
        REQUIRE(messages.texts.size() == 1);
        CHECK_THAT(messages.texts[0], containing(std::string(structName) + "::" + misuse.field));
        if (!misuse.value.empty()) CHECK_THAT(messages.texts[0], containing(" is " + misuse.value + ","));
    }
}

using Common = Misuse<CommonSettings>;
using Reblur = Misuse<ReblurSettings>;

template <class Member> std::vector<Common> badMatrices(const char* field, Member member)
{
    return {
        {std::string(field) + "[5]", [=](CommonSettings& s) { (s.*member)[5] = kNan; }},
        {std::string(field) + "[12]", [=](CommonSettings& s) { (s.*member)[12] = kInfinity; }},
        {field, [=](CommonSettings& s) { std::fill(std::begin(s.*member), std::end(s.*member), 0.0f); }},
        {field, [=](CommonSettings& s) { (s.*member)[0] = 0.0f; }},
        {field, [=](CommonSettings& s) { (s.*member)[3] = 1.0f; }},
    };
}

std::vector<Common> sizeMisuses()
{
    return {
        {"resourceSize[0]", [](CommonSettings& s) { s.resourceSize[0] = 0; }, "0"},
        {"resourceSizePrev[1]", [](CommonSettings& s) { s.resourceSizePrev[1] = 0; }, "0"},
        {"rectSize[1]", [](CommonSettings& s) { s.rectSize[1] = 0; }, "0"},
        {"rectSizePrev[0]", [](CommonSettings& s) { s.rectSizePrev[0] = 0; }, "0"},
        {"rectSize[0]", [](CommonSettings& s) { s.rectSize[0] = 101; }, "101"},
        {"rectSizePrev[1]", [](CommonSettings& s) { s.rectSizePrev[1] = 61; }, "61"},
        {"rectOrigin[0]", [](CommonSettings& s) { s.rectOrigin[0] = 1; }, "1"},
        {"rectOrigin[1]", [](CommonSettings& s) { s.rectOrigin[1] = 65535; }, "65535"},
    };
}

std::vector<Common> motionMisuses()
{
    return {
        {"motionVectorScale[0]", [](CommonSettings& s) { s.motionVectorScale[0] = 0.0f; }, "0"},
        {"motionVectorScale[1]", [](CommonSettings& s) { s.motionVectorScale[1] = kNan; }, "nan"},
        {"motionVectorScale[2]", [](CommonSettings& s) { s.motionVectorScale[2] = kInfinity; }, "inf"},
        {"cameraJitter[0]", [](CommonSettings& s) { s.cameraJitter[0] = 0.75f; }, "0.75"},
        {"cameraJitterPrev[1]", [](CommonSettings& s) { s.cameraJitterPrev[1] = kNan; }, "nan"},
        {"cameraDelta[2]",
         [](CommonSettings& s)
         {
             s.isCameraDeltaAvailable = true;
             s.cameraDelta[2] = std::numeric_limits<double>::infinity();
         },
         "inf"},
    };
}

std::vector<Common> scalarMisuses()
{
    return {
        {"viewZScale", [](CommonSettings& s) { s.viewZScale = 0.0f; }, "0"},
        {"timeDeltaBetweenFrames", [](CommonSettings& s) { s.timeDeltaBetweenFrames = -1.0f; }, "-1"},
        {"denoisingRange", [](CommonSettings& s) { s.denoisingRange = -1.0f; }, "-1"},
        {"denoisingRange", [](CommonSettings& s) { s.denoisingRange = kNan; }, "nan"},
        {"denoisingRange", [](CommonSettings& s) { s.denoisingRange = kInfinity; }, "inf"},
        {"disocclusionThreshold", [](CommonSettings& s) { s.disocclusionThreshold = 0.0f; }, "0"},
        {"disocclusionThresholdAlternate", [](CommonSettings& s) { s.disocclusionThresholdAlternate = 1.5f; }, "1.5"},
        {"strandThickness", [](CommonSettings& s) { s.strandThickness = 0.0f; }, "0"},
        {"splitScreen", [](CommonSettings& s) { s.splitScreen = 1.25f; }, "1.25"},
        {"splitScreen", [](CommonSettings& s) { s.splitScreen = kNan; }, "nan"},
        {"accumulationMode", [](CommonSettings& s) { s.accumulationMode = AccumulationMode(9); }, "9"},
    };
}

std::vector<Reblur> historyMisuses()
{
    return {
        {"maxAccumulatedFrameNum", [](ReblurSettings& s) { s.maxAccumulatedFrameNum = 64; }, "64"},
        {"maxFastAccumulatedFrameNum", [](ReblurSettings& s) { s.maxFastAccumulatedFrameNum = 64; }, "64"},
        {"maxStabilizedFrameNum", [](ReblurSettings& s) { s.maxStabilizedFrameNum = 256; }, "256"},
        {"historyFixFrameNum", [](ReblurSettings& s) { s.historyFixFrameNum = 9; }, "9"},
        {"historyFixFrameNum", [](ReblurSettings& s) { s.historyFixFrameNum = 6; }, "6"},
        {"historyFixBasePixelStride", [](ReblurSettings& s) { s.historyFixBasePixelStride = 0; }, "0"},
        {"historyFixAlternatePixelStride", [](ReblurSettings& s) { s.historyFixAlternatePixelStride = 65; }, "65"},
        {"responsiveAccumulationSettings.roughnessThreshold",
         [](ReblurSettings& s) { s.responsiveAccumulationSettings.roughnessThreshold = 1.5f; }, "1.5"},
        {"responsiveAccumulationSettings.minAccumulatedFrameNum",
         [](ReblurSettings& s)
         {
             s.responsiveAccumulationSettings.roughnessThreshold = 0.5f;
             s.responsiveAccumulationSettings.minAccumulatedFrameNum = 4;
         },
         "4"},
        {"antilagSettings.luminanceSigmaScale", [](ReblurSettings& s) { s.antilagSettings.luminanceSigmaScale = 0.0f; },
         "0"},
        {"antilagSettings.luminanceSensitivity",
         [](ReblurSettings& s) { s.antilagSettings.luminanceSensitivity = 101.0f; }, "101"},
        {"convergenceSettings.s", [](ReblurSettings& s) { s.convergenceSettings.s = 0.0f; }, "0"},
        {"convergenceSettings.b", [](ReblurSettings& s) { s.convergenceSettings.b = -0.5f; }, "-0.5"},
        {"convergenceSettings.p", [](ReblurSettings& s) { s.convergenceSettings.p = kNan; }, "nan"},
    };
}

std::vector<Reblur> filterMisuses()
{
    return {
        {"hitDistanceParameters.A", [](ReblurSettings& s) { s.hitDistanceParameters.A = 0.0f; }, "0"},
        {"hitDistanceParameters.B", [](ReblurSettings& s) { s.hitDistanceParameters.B = -1.0f; }, "-1"},
        {"hitDistanceParameters.C", [](ReblurSettings& s) { s.hitDistanceParameters.C = 0.5f; }, "0.5"},
        {"fastHistoryClampingSigmaScale", [](ReblurSettings& s) { s.fastHistoryClampingSigmaScale = 0.5f; }, "0.5"},
        {"diffusePrepassBlurRadius", [](ReblurSettings& s) { s.diffusePrepassBlurRadius = 300.0f; }, "300"},
        {"specularPrepassBlurRadius", [](ReblurSettings& s) { s.specularPrepassBlurRadius = -1.0f; }, "-1"},
        {"minHitDistanceWeight", [](ReblurSettings& s) { s.minHitDistanceWeight = 0.25f; }, "0.25"},
        {"minBlurRadius", [](ReblurSettings& s) { s.minBlurRadius = kNan; }, "nan"},
        {"maxBlurRadius", [](ReblurSettings& s) { s.maxBlurRadius = kInfinity; }, "inf"},
        {"lobeAngleFraction", [](ReblurSettings& s) { s.lobeAngleFraction = 2.0f; }, "2"},
        {"roughnessFraction", [](ReblurSettings& s) { s.roughnessFraction = -0.25f; }, "-0.25"},
        {"planeDistanceSensitivity", [](ReblurSettings& s) { s.planeDistanceSensitivity = 0.0f; }, "0"},
        {"fireflySuppressorMinRelativeScale", [](ReblurSettings& s) { s.fireflySuppressorMinRelativeScale = 4.0f; },
         "4"},
        {"prePassMode", [](ReblurSettings& s) { s.prePassMode = PrePassMode(5); }, "5"},
        {"checkerboardMode", [](ReblurSettings& s) { s.checkerboardMode = CheckerboardMode(7); }, "7"},
        {"hitDistanceReconstructionMode",
         [](ReblurSettings& s) { s.hitDistanceReconstructionMode = HitDistanceReconstructionMode(9); }, "9"},
    };
}

InstancePtr withMessages(Messages& messages, NormalEncoding encoding = NormalEncoding::R10_G10_B10_A2_UNORM)
{
    InstanceCreationDesc desc;
    desc.messageSink = messages.sink();
    desc.normalEncoding = encoding;
    return makeInstance({kReblurBoth, Denoiser::REFERENCE}, desc);
}

Result create(InstanceCreationDesc desc, const std::vector<DenoiserDesc>& denoisers, Messages& messages)
{
    messages = {};
    desc.messageSink = messages.sink();
    if (!denoisers.empty()) desc.denoisers = denoisers.data();
    if (desc.denoisersNum == 0) desc.denoisersNum = static_cast<uint32_t>(denoisers.size());
    Instance* instance = reinterpret_cast<Instance*>(&desc); // must be overwritten
    const Result result = CreateInstance(desc, instance);
    CHECK(instance == nullptr);
    REQUIRE(messages.texts.size() == 1);
    CHECK(messages.results[0] == result);
    return result;
}
} // namespace

TEST_CASE("bad common settings are refused with the field's name and value", "[unit]")
{
    Messages messages;
    const InstancePtr instance = withMessages(messages);
    const auto set = [&](const CommonSettings& s) { return SetCommonSettings(*instance, s); };
    const CommonSettings good = makeCommon();
    checkMisuses(sizeMisuses(), good, "CommonSettings", messages, set);
    checkMisuses(motionMisuses(), good, "CommonSettings", messages, set);
    checkMisuses(scalarMisuses(), good, "CommonSettings", messages, set);
    checkMisuses(badMatrices("viewToClipMatrix", &CommonSettings::viewToClipMatrix), good, "CommonSettings", messages,
                 set);
    checkMisuses(badMatrices("viewToClipMatrixPrev", &CommonSettings::viewToClipMatrixPrev), good, "CommonSettings",
                 messages, set);
    checkMisuses(badMatrices("worldToViewMatrix", &CommonSettings::worldToViewMatrix), good, "CommonSettings", messages,
                 set);
    checkMisuses(badMatrices("worldToViewMatrixPrev", &CommonSettings::worldToViewMatrixPrev), good, "CommonSettings",
                 messages, set);
}

TEST_CASE("projections that are none, and scaled views, are refused", "[unit]")
{
    Messages messages;
    const InstancePtr instance = withMessages(messages);
    const std::vector<Common> misuses = {
        {"viewToClipMatrix", [](CommonSettings& s) { s.viewToClipMatrix[5] = -1.0f; }}, // Y down
        {"viewToClipMatrix", [](CommonSettings& s) { s.viewToClipMatrix[14] = 0.0f; }}, // no depth
        {"viewToClipMatrix", [](CommonSettings& s) { s.viewToClipMatrix[15] = 1.0f; }}, // w = z + 1
        {"viewToClipMatrix", [](CommonSettings& s) { s.viewToClipMatrix[4] = 0.5f; }},  // shear
        {"viewToClipMatrix", [](CommonSettings& s) { std::swap(s.viewToClipMatrix[11], s.viewToClipMatrix[14]); }},
        {"worldToViewMatrix", [](CommonSettings& s) { s.worldToViewMatrix[0] = 2.0f; }},
        {"worldToViewMatrix", [](CommonSettings& s) { s.worldToViewMatrix[15] = 2.0f; }},
    };
    checkMisuses(misuses, makeCommon(), "CommonSettings", messages,
                 [&](const CommonSettings& s) { return SetCommonSettings(*instance, s); });
}

TEST_CASE("bad REBLUR settings are refused with the field's name and value", "[unit]")
{
    Messages messages;
    const InstancePtr instance = withMessages(messages);
    const auto set = [&](const ReblurSettings& s) { return SetDenoiserSettings(*instance, 0, s); };
    checkMisuses(historyMisuses(), ReblurSettings{}, "ReblurSettings", messages, set);
    checkMisuses(filterMisuses(), ReblurSettings{}, "ReblurSettings", messages, set);
    ReblurSettings off; // the limits themselves are fine
    off.maxAccumulatedFrameNum = off.maxFastAccumulatedFrameNum = off.historyFixFrameNum = 0;
    CHECK(set(off) == Result::SUCCESS);
}

TEST_CASE("bad REFERENCE settings are refused with the field's name and value", "[unit]")
{
    Messages messages;
    const InstancePtr instance = withMessages(messages);
    const std::vector<Misuse<ReferenceSettings>> misuses = {
        {"maxAccumulatedFrameNum", [](ReferenceSettings& s) { s.maxAccumulatedFrameNum = 4096; }, "4096"}};
    checkMisuses(misuses, ReferenceSettings{}, "ReferenceSettings", messages,
                 [&](const ReferenceSettings& s) { return SetDenoiserSettings(*instance, 1, s); });
}

TEST_CASE("material IDs need an encoding that carries them", "[unit]")
{
    Messages messages;
    const InstancePtr instance = withMessages(messages, NormalEncoding::RGBA16_SNORM);
    const std::vector<Common> misuses = {
        {"strandMaterialID", [](CommonSettings& s) { s.strandMaterialID = 2; }, "2"},
        {"cameraAttachedReflectionMaterialID", [](CommonSettings& s) { s.cameraAttachedReflectionMaterialID = 1; },
         "1"},
        {"historyFixAlternatePixelStrideMaterialID",
         [](CommonSettings& s) { s.historyFixAlternatePixelStrideMaterialID = 0; }, "0"},
    };
    checkMisuses(misuses, makeCommon(), "CommonSettings", messages,
                 [&](const CommonSettings& s) { return SetCommonSettings(*instance, s); });
}

TEST_CASE("refused settings leave the old ones in force", "[unit]")
{
    Messages messages;
    const InstancePtr instance = withMessages(messages);
    CommonSettings common = makeCommon();
    requestFrame(*instance, common);

    ReblurSettings bad;
    bad.maxStabilizedFrameNum = 0;
    bad.minBlurRadius = -1.0f;
    CHECK(SetDenoiserSettings(*instance, 0, bad) == Result::INVALID_ARGUMENT);
    CommonSettings badCommon = common;
    badCommon.splitScreen = 1.0f;
    badCommon.denoisingRange = 0.0f;
    CHECK(SetCommonSettings(*instance, badCommon) == Result::INVALID_ARGUMENT);
    CHECK(std::string(GetLastMessage(*instance)) == messages.texts.back());

    const std::vector<DispatchDesc> dispatches = requestFrame(*instance, common);
    CHECK(dispatches.size() == 5);
    CHECK(findPass(dispatches, "Temporal stabilization"));
}

TEST_CASE("settings for nobody or for another family are refused", "[unit]")
{
    Messages messages;
    const InstancePtr instance = withMessages(messages);
    CHECK(SetDenoiserSettings(*instance, 77, ReblurSettings{}) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts.back(), containing("identifier is 77"));
    CHECK(SetDenoiserSettings(*instance, 1, ReblurSettings{}) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts.back(), containing("REFERENCE"));
    CHECK(SetDenoiserSettings(*instance, 0, ReferenceSettings{}) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts.back(), containing("REBLUR_DIFFUSE_SPECULAR"));
    const ResourceRequirement* requirements = nullptr;
    uint32_t num = 0;
    CHECK(GetRequiredResources(*instance, 5, requirements, num) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts.back(), containing("identifier is 5"));
}

TEST_CASE("requests that make no sense are refused and change nothing", "[unit]")
{
    Messages messages;
    const InstancePtr instance = withMessages(messages);
    const auto refused = [&](const std::vector<Identifier>& identifiers, const char* text)
    {
        const DispatchDesc* dispatches = reinterpret_cast<const DispatchDesc*>(&messages);
        uint32_t num = 99;
        CHECK(GetComputeDispatches(*instance, identifiers.empty() ? nullptr : identifiers.data(),
                                   identifiers.empty() ? 3 : static_cast<uint32_t>(identifiers.size()), dispatches,
                                   num) == Result::INVALID_ARGUMENT);
        CHECK(dispatches == nullptr);
        CHECK(num == 0);
        CHECK_THAT(messages.texts.back(), containing(text));
    };
    refused({0}, "CommonSettings are not set");
    REQUIRE(SetCommonSettings(*instance, makeCommon()) == Result::SUCCESS);
    refused({}, "identifiers is null");
    refused({0, 42}, "identifier is 42");
    refused({0, 1, 0}, "identifiers[2] is 0 again");
    const size_t firstNum = request(*instance, {0}).size();
    CHECK(firstNum > 7); // the first request that succeeded, so it clears
    refused({1, 0}, "identifiers[1] is 0 again");
}

TEST_CASE("instances that cannot be are refused and named", "[unit]")
{
    Messages messages;
    const InstanceCreationDesc good;
    InstanceCreationDesc desc = good;

    CHECK(create(good, {{0, Denoiser::REFERENCE}, {3, Denoiser::MAX_NUM}}, messages) == Result::UNSUPPORTED);
    CHECK_THAT(messages.texts[0], containing("denoisers[1].denoiser is 19 (UNKNOWN)"));
    CHECK(create(good, {{0, Denoiser::RELAX_DIFFUSE, 1, false}}, messages) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts[0], containing("denoisers[0].hasHistory is 0, expected 1: RELAX_DIFFUSE"));
    CHECK(create(good, {{4, Denoiser::REFERENCE}, {4, Denoiser::REFERENCE}}, messages) ==
          Result::NON_UNIQUE_IDENTIFIER);
    CHECK_THAT(messages.texts[0], containing("denoisers[1].identifier is 4"));

    desc.headerVersion = kHeaderVersion + 1;
    CHECK(create(desc, {}, messages) == Result::UNSUPPORTED);
    CHECK_THAT(messages.texts[0], containing("headerVersion is " + std::to_string(kHeaderVersion + 1)));
    desc = good;
    desc.denoisersNum = 2;
    CHECK(create(desc, {}, messages) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts[0], containing("denoisers is null"));
    desc = good;
    desc.normalEncoding = NormalEncoding::MAX_NUM;
    CHECK(create(desc, {}, messages) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts[0], containing("normalEncoding is 5"));
    desc = good;
    desc.roughnessEncoding = RoughnessEncoding::MAX_NUM;
    CHECK(create(desc, {}, messages) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts[0], containing("roughnessEncoding is 3"));
    desc = good;
    desc.allocationCallbacks.free = [](void*, void*) {};
    CHECK(create(desc, {}, messages) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts[0], containing("allocationCallbacks"));
}

TEST_CASE("destroying nothing is allowed", "[unit]")
{
    DestroyInstance(nullptr);
    SUCCEED();
}
