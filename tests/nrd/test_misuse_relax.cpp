// Every field of RelaxSettings keeps to its range: the ends are inside, what lies beyond is refused by name and value.
#include "fixture.h"
#include "validate.h"
#include <limits>

using namespace test;

namespace
{
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void requireRefused(const RelaxSettings& bad, const std::string& field, const std::string& value,
                    const std::string& expected)
{
    INFO(field << " " << value);
    const Error error = findError(bad);
    CHECK(error.result == Result::INVALID_ARGUMENT);
    CHECK(std::string(error.text.c_str()) == "RelaxSettings::" + field + " is " + value + ", expected " + expected);
}

struct Bad
{
    float value;
    const char* text;
};

struct FloatRow
{
    const char* field;
    float& (*of)(RelaxSettings&);
    std::vector<Bad> bad; // besides NaN and the infinities
    std::vector<float> good;
    const char* expected;
};

FloatRow fraction(const char* field, float& (*of)(RelaxSettings&))
{
    return {field, of, {{-0.25f, "-0.25"}, {1.25f, "1.25"}}, {0.0f, 1.0f}, "[0; 1]"};
}

std::vector<FloatRow> historyRows()
{
    using S = RelaxSettings;
    const std::vector<Bad> beyondSigma = {{0.0f, "0"}, {-1.0f, "-1"}, {101.0f, "101"}};
    const std::vector<Bad> beyondRadius = {{-1.0f, "-1"}, {257.0f, "257"}};
    return {
        fraction("antilagSettings.accelerationAmount",
                 [](S& s) -> float& { return s.antilagSettings.accelerationAmount; }),
        {"antilagSettings.spatialSigmaScale",
         [](S& s) -> float& { return s.antilagSettings.spatialSigmaScale; },
         beyondSigma,
         {1e-6f, 100.0f},
         "(0; 100]"},
        {"antilagSettings.temporalSigmaScale",
         [](S& s) -> float& { return s.antilagSettings.temporalSigmaScale; },
         beyondSigma,
         {1e-6f, 100.0f},
         "(0; 100]"},
        fraction("antilagSettings.resetAmount", [](S& s) -> float& { return s.antilagSettings.resetAmount; }),
        {"historyFixEdgeStoppingNormalPower",
         [](S& s) -> float& { return s.historyFixEdgeStoppingNormalPower; },
         {{0.0f, "0"}, {129.0f, "129"}},
         {1e-6f, 128.0f},
         "(0; 128]"},
        {"fastHistoryClampingSigmaScale",
         [](S& s) -> float& { return s.fastHistoryClampingSigmaScale; },
         {{0.5f, "0.5"}, {3.5f, "3.5"}},
         {1.0f, 3.0f},
         "[1; 3]"},
        {"diffusePrepassBlurRadius",
         [](S& s) -> float& { return s.diffusePrepassBlurRadius; },
         beyondRadius,
         {0.0f, 256.0f},
         "[0; 256]"},
        {"specularPrepassBlurRadius",
         [](S& s) -> float& { return s.specularPrepassBlurRadius; },
         beyondRadius,
         {0.0f, 256.0f},
         "[0; 256]"},
        {"minHitDistanceWeight",
         [](S& s) -> float& { return s.minHitDistanceWeight; },
         {{0.0f, "0"}, {0.25f, "0.25"}},
         {1e-6f, 0.2f},
         "(0; 0.2]"},
    };
}

std::vector<FloatRow> waveletRows()
{
    using S = RelaxSettings;
    const std::vector<Bad> beyondPhi = {{-1.0f, "-1"}, {101.0f, "101"}};
    return {
        {"diffusePhiLuminance",
         [](S& s) -> float& { return s.diffusePhiLuminance; },
         beyondPhi,
         {0.0f, 100.0f},
         "[0; 100]"},
        {"specularPhiLuminance",
         [](S& s) -> float& { return s.specularPhiLuminance; },
         beyondPhi,
         {0.0f, 100.0f},
         "[0; 100]"},
        fraction("diffuseMinLuminanceWeight", [](S& s) -> float& { return s.diffuseMinLuminanceWeight; }),
        fraction("specularMinLuminanceWeight", [](S& s) -> float& { return s.specularMinLuminanceWeight; }),
        {"specularVarianceBoost",
         [](S& s) -> float& { return s.specularVarianceBoost; },
         {{-1.0f, "-1"}, {65505.0f, "65505"}},
         {0.0f, 65504.0f},
         "[0; 65504]"},
        {"depthThreshold",
         [](S& s) -> float& { return s.depthThreshold; },
         {{0.0f, "0"}, {1.5f, "1.5"}},
         {1e-6f, 1.0f},
         "(0; 1]"},
        fraction("lobeAngleFraction", [](S& s) -> float& { return s.lobeAngleFraction; }),
        {"specularLobeAngleSlack",
         [](S& s) -> float& { return s.specularLobeAngleSlack; },
         {{-0.5f, "-0.5"}, {91.0f, "91"}},
         {0.0f, 90.0f},
         "[0; 90]"},
        fraction("roughnessFraction", [](S& s) -> float& { return s.roughnessFraction; }),
        fraction("luminanceEdgeStoppingRelaxation", [](S& s) -> float& { return s.luminanceEdgeStoppingRelaxation; }),
        fraction("normalEdgeStoppingRelaxation", [](S& s) -> float& { return s.normalEdgeStoppingRelaxation; }),
        fraction("roughnessEdgeStoppingRelaxation", [](S& s) -> float& { return s.roughnessEdgeStoppingRelaxation; }),
        fraction("confidenceDrivenRelaxationMultiplier",
                 [](S& s) -> float& { return s.confidenceDrivenRelaxationMultiplier; }),
        fraction("confidenceDrivenLuminanceEdgeStoppingRelaxation",
                 [](S& s) -> float& { return s.confidenceDrivenLuminanceEdgeStoppingRelaxation; }),
        fraction("confidenceDrivenNormalEdgeStoppingRelaxation",
                 [](S& s) -> float& { return s.confidenceDrivenNormalEdgeStoppingRelaxation; }),
    };
}

void checkRows(std::vector<FloatRow> rows)
{
    for (FloatRow& row : rows)
    {
        for (const Bad& never : {Bad{kNan, "nan"}, Bad{kInfinity, "inf"}, Bad{-kInfinity, "-inf"}})
            row.bad.push_back(never);
        RelaxSettings s;
        for (const Bad& bad : row.bad)
        {
            row.of(s) = bad.value;
            requireRefused(s, row.field, bad.text, row.expected);
        }
        for (const float good : row.good)
        {
            INFO(row.field << " " << good);
            row.of(s) = good;
            CHECK_FALSE(findError(s));
        }
    }
}

struct CountRow
{
    const char* field;
    uint32_t RelaxSettings::*member;
    std::vector<uint32_t> bad;
    std::vector<uint32_t> good;
    const char* expected;
};

std::vector<CountRow> countRows()
{
    using S = RelaxSettings;
    return {
        {"diffuseMaxAccumulatedFrameNum", &S::diffuseMaxAccumulatedFrameNum, {64}, {0, 63}, "[0; 63]"},
        {"specularMaxAccumulatedFrameNum", &S::specularMaxAccumulatedFrameNum, {64}, {0, 63}, "[0; 63]"},
        {"diffuseMaxFastAccumulatedFrameNum", &S::diffuseMaxFastAccumulatedFrameNum, {64}, {4, 63}, "[0; 63]"},
        {"specularMaxFastAccumulatedFrameNum", &S::specularMaxFastAccumulatedFrameNum, {64}, {4, 63}, "[0; 63]"},
        {"historyFixFrameNum", &S::historyFixFrameNum, {4}, {0, 3}, "[0; 3]"},
        {"historyFixBasePixelStride", &S::historyFixBasePixelStride, {0, 65}, {1, 64}, "[1; 64]"},
        {"historyFixAlternatePixelStride", &S::historyFixAlternatePixelStride, {0, 65}, {1, 64}, "[1; 64]"},
        {"atrousIterationNum", &S::atrousIterationNum, {0, 1, 9}, {2, 8}, "[2; 8]"},
        {"spatialVarianceEstimationHistoryThreshold",
         &S::spatialVarianceEstimationHistoryThreshold,
         {64},
         {0, 63},
         "[0; 63]"},
    };
}
} // namespace

TEST_CASE("RELAX settings beyond their range are refused with the field's name and value", "[unit]")
{
    CHECK_FALSE(findError(RelaxSettings{}));
    checkRows(historyRows());
    checkRows(waveletRows());
    for (const CountRow& row : countRows())
    {
        RelaxSettings s;
        for (const uint32_t bad : row.bad)
        {
            s.*row.member = bad;
            requireRefused(s, row.field, std::to_string(bad), row.expected);
        }
        for (const uint32_t good : row.good)
        {
            INFO(row.field << " " << good);
            s.*row.member = good;
            CHECK_FALSE(findError(s));
        }
    }
}

TEST_CASE("RELAX modes that are none are refused", "[unit]")
{
    RelaxSettings s;
    s.prePassMode = PrePassMode::MAX_NUM;
    requireRefused(s, "prePassMode", "3", "an enumerator");
    s = {};
    s.checkerboardMode = CheckerboardMode::MAX_NUM;
    requireRefused(s, "checkerboardMode", "3", "an enumerator");
    s = {};
    s.hitDistanceReconstructionMode = HitDistanceReconstructionMode(9);
    requireRefused(s, "hitDistanceReconstructionMode", "9", "an enumerator");
}

TEST_CASE("RELAX repairs history only while both fast histories are shorter than their maxima", "[unit]")
{
    RelaxSettings s;
    s.diffuseMaxFastAccumulatedFrameNum = 3;
    requireRefused(s, "historyFixFrameNum", "3", "0 or below diffuseMaxFastAccumulatedFrameNum");
    s.diffuseMaxFastAccumulatedFrameNum = 4;
    s.specularMaxFastAccumulatedFrameNum = 2;
    requireRefused(s, "historyFixFrameNum", "3", "0 or below specularMaxFastAccumulatedFrameNum");
    s.historyFixFrameNum = 0;
    s.diffuseMaxFastAccumulatedFrameNum = s.specularMaxFastAccumulatedFrameNum = 0;
    CHECK_FALSE(findError(s));
}

TEST_CASE("RELAX settings for a denoiser of another family are refused and change nothing", "[unit]")
{
    Messages messages;
    InstanceCreationDesc desc;
    desc.messageSink = messages.sink();
    const InstancePtr instance = makeInstance({kReblurBoth, Denoiser::REFERENCE}, desc);
    CommonSettings common = makeCommon();
    requestFrame(*instance, common); // clears
    const std::vector<std::string> before = passNames(requestFrame(*instance, common));

    RelaxSettings relax;
    relax.hitDistanceReconstructionMode = HitDistanceReconstructionMode::AREA_3X3; // would add a pass
    CHECK(SetDenoiserSettings(*instance, 0, relax) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts.back(), containing("REBLUR_DIFFUSE_SPECULAR"));
    CHECK(SetDenoiserSettings(*instance, 1, relax) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts.back(), containing("REFERENCE"));
    CHECK(SetDenoiserSettings(*instance, 77, relax) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts.back(), containing("identifier is 77"));
    CHECK(passNames(requestFrame(*instance, common)) == before);
}

TEST_CASE("refused RELAX settings leave the old ones in force", "[unit]")
{
    const InstancePtr instance = makeInstance({Denoiser::RELAX_DIFFUSE_SPECULAR});
    CommonSettings common = makeCommon();
    requestFrame(*instance, common); // clears
    const std::vector<std::string> before = passNames(requestFrame(*instance, common));

    RelaxSettings settings;
    settings.atrousIterationNum = 8; // more passes
    settings.depthThreshold = 0.0f;
    CHECK(SetDenoiserSettings(*instance, 0, settings) == Result::INVALID_ARGUMENT);
    CHECK_THAT(GetLastMessage(*instance), containing("RelaxSettings::depthThreshold is 0,"));
    CHECK(passNames(requestFrame(*instance, common)) == before);
    settings.depthThreshold = RelaxSettings{}.depthThreshold;
    CHECK(SetDenoiserSettings(*instance, 0, settings) == Result::SUCCESS);
    CHECK(passNames(requestFrame(*instance, common)).size() > before.size());
}
