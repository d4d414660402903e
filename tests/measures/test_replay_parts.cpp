#include "catch.h"

#include "replay_camera.h"
#include "replay_report.h"
#include "replay_settings.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <set>

using namespace sample;

namespace
{
std::string errorOf(const std::vector<Assignment>& assignments, Family family = Family::Reblur)
{
    ReplaySettings settings;
    try
    {
        applySettings(settings, family, assignments);
    }
    catch (const SettingError& e)
    {
        return e.what();
    }
    return "";
}

size_t elementSize(const SettingField& field)
{
    return std::visit([](auto* value) { return sizeof(*value); }, field.target);
}

const unsigned char* address(const SettingField& field)
{
    return std::visit([](auto* value) { return reinterpret_cast<const unsigned char*>(value); }, field.target);
}

// Whether bytes of a struct belong to no field and are more than padding before the next one (or at the end).
template <class T> bool hasHole(const std::vector<SettingField>& fields, const T& object)
{
    std::map<size_t, const SettingField*> byOffset;
    const unsigned char* first = reinterpret_cast<const unsigned char*>(&object);
    for (const SettingField& field : fields)
        if (address(field) >= first && address(field) < first + sizeof(T))
            byOffset[static_cast<size_t>(address(field) - first)] = &field;
    size_t end = 0;
    for (const auto& [offset, field] : byOffset)
    {
        if (offset < end || offset - end >= elementSize(*field)) return true;
        end = offset + elementSize(*field) * field->count;
    }
    return sizeof(T) - end >= alignof(T);
}

std::filesystem::path tempFile(const char* name) { return std::filesystem::temp_directory_path() / name; }

CaptureInfo twoFrames()
{
    CaptureInfo info;
    info.width = 64;
    info.height = 48;
    info.metersPerUnit = 0.5;
    CaptureFrame frame;
    frame.isCut = true;
    frame.jitter = {0.25, -0.25};
    // A turn by 90 degrees about Y and a camera at (100000, 2, 3).
    frame.worldToView = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, -3, -2, 100000, 1};
    frame.viewToClip[0] = 1.0;
    info.frames.push_back(frame);
    frame.isCut = false;
    frame.worldToView[14] = 100000.001;
    frame.viewToClip[0] = 2.0;
    frame.jitter = {0.5, 0.0};
    info.frames.push_back(frame);
    return info;
}
} // namespace

TEST_CASE("--set reaches every field of the settings", "[unit]")
{
    ReplaySettings settings;
    // A setting without a row leaves a hole in the struct.
    const auto reblur = settingFields(settings, Family::Reblur);
    CHECK_FALSE(hasHole(reblur, settings.common));
    CHECK_FALSE(hasHole(reblur, settings.reblur));
    const auto relax = settingFields(settings, Family::Relax);
    CHECK_FALSE(hasHole(relax, settings.relax));
    const auto reference = settingFields(settings, Family::Reference);
    CHECK_FALSE(hasHole(reference, settings.reference));
    std::set<std::string> names;
    for (const SettingField& field : reblur) CHECK(names.insert(field.name).second);
    names.clear();
    for (const SettingField& field : relax) CHECK(names.insert(field.name).second);
    auto incomplete = reblur;
    incomplete.erase(incomplete.begin() + 20);
    CHECK(hasHole(incomplete, settings.common));
}

TEST_CASE("--set writes values of every type", "[unit]")
{
    ReplaySettings s;
    applySettings(s, Family::Reblur,
                  {{"maxBlurRadius", "12.5"},
                   {"maxAccumulatedFrameNum", "17"},
                   {"enableAntiFirefly", "false"},
                   {"hitDistanceReconstructionMode", "AREA_5X5"},
                   {"cameraJitter", "0.1,-0.2"},
                   {"rectSize", "10,20"},
                   {"cameraDelta", "1e-9,0,2"},
                   {"convergenceSettings.p", "0.5"},
                   {"accumulationMode", "CLEAR_AND_RESTART"},
                   {"maxBlurRadius", "13.5"}}); // the last one counts
    CHECK(s.reblur.maxBlurRadius == 13.5f);
    CHECK(s.reblur.maxAccumulatedFrameNum == 17);
    CHECK_FALSE(s.reblur.enableAntiFirefly);
    CHECK(s.reblur.hitDistanceReconstructionMode == nrd::HitDistanceReconstructionMode::AREA_5X5);
    CHECK(s.common.cameraJitter[1] == -0.2f);
    CHECK(s.common.rectSize[0] == 10);
    CHECK(s.common.rectSize[1] == 20);
    CHECK(s.common.cameraDelta[0] == 1e-9);
    CHECK(s.reblur.convergenceSettings.p == 0.5f);
    CHECK(s.common.accumulationMode == nrd::AccumulationMode::CLEAR_AND_RESTART);
}

TEST_CASE("a key or value that does not fit is named with what was expected", "[unit]")
{
    CHECK(errorOf({{"maxBlurRadius", "12"}}).empty());
    CHECK_THAT(errorOf({{"nothing", "1"}}), containing("--set nothing: the denoiser has no setting"));
    CHECK_THAT(errorOf({{"maxBlurRadius", "12px"}}), containing("maxBlurRadius=12px: expected a finite number"));
    CHECK_THAT(errorOf({{"maxBlurRadius", "nan"}}), containing("expected a finite number"));
    CHECK_THAT(errorOf({{"maxBlurRadius", ""}}), containing("expected a finite number"));
    CHECK_THAT(errorOf({{"maxAccumulatedFrameNum", "-1"}}), containing("a whole number of at least 0"));
    CHECK_THAT(errorOf({{"maxAccumulatedFrameNum", "1.5"}}), containing("a whole number of at least 0"));
    CHECK_THAT(errorOf({{"rectSize", "70000,1"}}), containing("from 0 to 65535"));
    CHECK_THAT(errorOf({{"rectSize", "7"}}), containing("expected 2 value(s)"));
    CHECK_THAT(errorOf({{"enableAntiFirefly", "yes"}}), containing("true or false"));
    CHECK_THAT(errorOf({{"checkerboardMode", "RED"}}), containing("one of OFF BLACK WHITE"));
    CHECK_THAT(errorOf({{"maxBlurRadius", "1"}}, Family::Reference), containing("no setting"));
    CHECK_THROWS_AS(parseAssignment("novalue"), SettingError);
    CHECK_THROWS_AS(parseAssignment("=1"), SettingError);
    CHECK(parseAssignment("a=b=c") == Assignment{"a", "b=c"});
}

TEST_CASE("the denoisers are the library's, in its order, and NONE", "[unit]")
{
    REQUIRE(replayDenoisers().size() == static_cast<size_t>(nrd::Denoiser::MAX_NUM) + 1);
    for (size_t i = 0; i < static_cast<size_t>(nrd::Denoiser::MAX_NUM); i++)
    {
        const ReplayDenoiser& row = replayDenoisers()[i];
        CHECK(static_cast<size_t>(row.denoiser) == i);
        CHECK(std::string(row.name) == nrd::toString(row.denoiser));
        CHECK(findDenoiser(row.name) == &row);
        CHECK_FALSE(row.signals.empty());
    }
    CHECK(findDenoiser("NONE")->family == Family::None);
    CHECK(findDenoiser("none") == nullptr);
}

TEST_CASE("a frame's settings come from it and the frame before, and a cut has none before", "[unit]")
{
    const CaptureInfo info = twoFrames();
    const nrd::CommonSettings first = commonSettingsOf(info, 0);
    CHECK(first.accumulationMode == nrd::AccumulationMode::RESTART);
    CHECK(std::memcmp(first.worldToViewMatrix, first.worldToViewMatrixPrev, sizeof(first.worldToViewMatrix)) == 0);
    CHECK(first.cameraDelta[0] == 0.0);
    CHECK(first.isMotionVectorInWorldSpace);
    CHECK(first.motionVectorScale[2] == 1.0f);
    CHECK(first.resourceSize[0] == 64);
    CHECK(first.rectSizePrev[1] == 48);
    CHECK(first.metersToUnits == 2.0f);
    CHECK(hitDistanceParametersOf(info).A * first.metersToUnits == 3.0f); // the capture's, in world units

    const nrd::CommonSettings second = commonSettingsOf(info, 1);
    CHECK(second.accumulationMode == nrd::AccumulationMode::CONTINUE);
    CHECK(second.frameIndex == 1);
    CHECK(second.viewToClipMatrix[0] == 2.0f);
    CHECK(second.viewToClipMatrixPrev[0] == 1.0f);
    CHECK(second.cameraJitter[0] == 0.5f);
    CHECK(second.cameraJitterPrev[0] == 0.25f);
    // Previous minus current, from doubles: floats at 100,000 are 0.0078 apart.
    CHECK(cameraPositionOf(info.frames[0].worldToView) == std::array<double, 3>{100000.0, 2.0, 3.0});
    CHECK(second.cameraDelta[0] == Approx(-0.001).epsilon(1e-3));
    CHECK(second.cameraDelta[1] == 0.0);

    CaptureInfo cut = info;
    cut.frames[1].isCut = true;
    CHECK(commonSettingsOf(cut, 1).accumulationMode == nrd::AccumulationMode::RESTART);
    CHECK(commonSettingsOf(cut, 1).viewToClipMatrixPrev[0] == 2.0f);
}

TEST_CASE("a report has the stated shape and reads back", "[unit]")
{
    ReplayReport report;
    report.capture = "some capture";
    report.denoiser = "REFERENCE";
    report.device = "some device";
    report.width = 4;
    report.height = 3;
    report.settings = {{"maxAccumulatedFrameNum", "5"}};
    report.gpuMs = 1.5;
    report.passes = {{"Copy", 0.5}};
    report.memory = ReplayReport::Memory{1.0, 2.0, 3.0};
    SequenceFrame frame;
    frame.frame = 8;
    frame.noisy[0].psnr = 20.0;
    frame.noisy[0].flicker = NAN; // no number in JSON: left out
    report.frames = {frame};
    report.noisy = frame.noisy;
    report.denoised[static_cast<size_t>(Signal::NormHitDist)].rmse = 0.25;
    report.denoised[static_cast<size_t>(Signal::SpecularNormHitDist)].rmse = 0.125;
    report.denoised[static_cast<size_t>(Signal::SpecularNormHitDist)].flicker = 0.0625;
    const std::filesystem::path file = tempFile("nrd-test-report.json");
    writeReport(file, report);
    const nlohmann::json json = nlohmann::json::parse(std::ifstream(file));
    CHECK(json["resolution"] == nlohmann::json({4, 3}));
    CHECK(json["settings"]["maxAccumulatedFrameNum"] == "5");
    CHECK(json["gpuMs"]["passes"][0]["name"] == "Copy");
    CHECK(json["memoryMiB"]["total"] == 3.0);
    CHECK(json["frames"][0]["frame"] == 8);
    CHECK(json["frames"][0]["noisy"]["composed"] == nlohmann::json({{"psnr", 20.0}}));
    CHECK(json["frames"][0]["denoised"].empty());
    CHECK(json["mean"]["denoised"]["normHitDist"]["rmse"] == 0.25);
    CHECK(json["mean"]["denoised"]["specularNormHitDist"] == nlohmann::json({{"rmse", 0.125}, {"flicker", 0.0625}}));
    CHECK_FALSE(json["mean"].contains("extracted"));
    CHECK_FALSE(json["frames"][0].contains("extracted"));

    const ReplayReport read = readReport(file);
    CHECK(read.denoiser == "REFERENCE");
    CHECK(*read.noisy[0].psnr == 20.0);
    CHECK(*read.denoised[static_cast<size_t>(Signal::NormHitDist)].rmse == 0.25);
    CHECK_THAT(formatReport(report, {}), containing("20.00"));
    CHECK_THAT(formatReport(report, {}), containing("specularNormHitDist    flicker"));
    CHECK_THAT(formatSummary({read}, {{}}), containing("0.1250"));
    PeerFigures peer;
    peer.denoised[0].psnr = 33.125;
    CHECK_THAT(formatSummary({report}, {peer}), containing("33.12"));
    std::ofstream(file) << "[1, 2]";
    CHECK_THROWS_AS(readReport(file), FileError);
    CHECK_THROWS_AS(readPeer(file, "some capture", "REFERENCE"), FileError);
    std::ofstream(file) << "[]";
    CHECK_FALSE(readPeer(file, "some capture", "REFERENCE"));
    std::filesystem::remove(file);
}

TEST_CASE("extracted colours have rows of their own in reports and tables", "[unit]")
{
    ReplayReport report;
    report.capture = "some capture";
    report.denoiser = "REBLUR_DIFFUSE_SH";
    SequenceFrame frame;
    frame.noisy[0].psnr = 20.0;
    frame.denoised[0].psnr = 31.0;
    frame.extracted[0].psnr = 30.0;
    report.frames = {frame};
    report.noisy = frame.noisy;
    report.denoised = frame.denoised;
    report.extracted = frame.extracted;
    const std::filesystem::path file = tempFile("nrd-test-extracted.json");
    writeReport(file, report);
    const nlohmann::json json = nlohmann::json::parse(std::ifstream(file));
    CHECK(json["frames"][0]["denoised"]["composed"]["psnr"] == 31.0);
    CHECK(json["frames"][0]["extracted"]["composed"]["psnr"] == 30.0);
    CHECK(json["mean"]["extracted"]["composed"]["psnr"] == 30.0);
    const ReplayReport read = readReport(file);
    CHECK(*read.extracted[0].psnr == 30.0);
    CHECK_THAT(formatReport(report, {}), containing("extracted"));

    PeerFigures peer;
    peer.denoised[0].psnr = 29.0;
    const std::string text = formatSummary({read}, {peer});
    CHECK_THAT(text, containing("REBLUR_DIFFUSE_SH resolved"));
    CHECK_THAT(text, containing("REBLUR_DIFFUSE_SH extracted"));
    // The peer's figures are of resolved colours.
    const std::string markdown = formatSummary({read}, {peer}, TableStyle::Markdown);
    CHECK_THAT(markdown, containing("| REBLUR_DIFFUSE_SH resolved | some capture | 20.00 \u2192 31.00 (29.00) | |"));
    CHECK_THAT(markdown, containing("| REBLUR_DIFFUSE_SH extracted | some capture | 20.00 \u2192 30.00 | |"));
    std::filesystem::remove(file);
}
