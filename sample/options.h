// The command line of nrd-sample.
#pragma once
#include "built_in_scenes.h"
#include "denoise.h"

#include <filesystem>
#include <optional>

namespace sample
{
/// Which frames get a reference: all in `list`, or with every > 0 the pairs (k - 1, k) for each multiple k of it.
struct ReferenceFrames
{
    uint32_t every = 0;
    std::vector<uint32_t> list;
    bool contains(uint32_t frame) const;
};

/// From "7,8,15,16" or "every-8"; throws std::invalid_argument with one sentence.
ReferenceFrames parseReferenceFrames(const std::string& text);

struct Options
{
    std::filesystem::path scene;           // empty: a built-in one
    const BuiltInScene* builtIn = nullptr; // null: none was asked for
    std::filesystem::path environment;     // empty: none, or the default sky where nothing else shines
    const SampleDenoiser* denoiser = findSampleDenoiser("REBLUR_DIFFUSE_SPECULAR"); // never null
    std::vector<Assignment> settings;                                               // --set
    Lobes lobes = Lobes::Both;
    nrd::CheckerboardMode checkerboard = nrd::CheckerboardMode::OFF;
    uint32_t width = 480; // pixels, [16; 8192]
    uint32_t height = 270;
    uint32_t frames = 33; // [1; 100000]
    float framesPerSecond = 60.0f;
    uint32_t seed = 0;
    uint32_t bounces = 4;
    float roughening = 0.5f; // [0; 1], see TracerDesc
    bool hasJitter = false;
    std::filesystem::path screenshot; // of the last frame, .png or .exr
    std::filesystem::path noisyScreenshot;
    std::filesystem::path referenceScreenshot;
    std::filesystem::path capture; // folder
    std::filesystem::path demo;    // folder
    uint32_t referenceSpp = 0;     // 0: no references
    ReferenceFrames referenceFrames;
    std::string device;
    bool validation = false;
    bool isHeadless = false;
    bool listDevices = false;
};

/// What the options ask of the denoiser: the settings they imply, then --set. Throws SettingError.
ReplaySettings denoiserSettings(const Options& options);

/// nullopt: everything is said and done (--help, --version, or an error on stderr), exit with `exitCode`.
std::optional<Options> parseOptions(int argumentCount, char** arguments, int& exitCode);
} // namespace sample
