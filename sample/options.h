// The command line of nrd-sample.
#pragma once
#include "built_in_scenes.h"
#include "denoiser_choice.h"
#include "resolution.h"

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
    float offset = 0.0f;                   // world units along X, [-1e6; 1e6], of the whole scene
    std::filesystem::path environment;     // empty: none, or the default sky where nothing else shines
    std::vector<DenoiserSet> sets;         // all run in every frame; empty: settleDenoisers() chooses
    uint32_t switchEvery = 0;              // frames after which the next set is shown; 0: the first one is
    std::vector<Assignment> settings;      // --set
    Resolution resolution;                 // of the sets' denoisers
    bool hasWholeSignals = false;          // every pixel has paths, though the denoisers may read fewer
    std::optional<Lobes> lobes;            // nullopt: settleDenoisers() chooses
    bool hasShadowSignal = false;          // also where a set denoises it
    std::optional<float> sunRadius;        // degrees, [0; 45]; nullopt: the scene's
    nrd::CheckerboardMode checkerboard = nrd::CheckerboardMode::OFF;
    bool hasSize = false; // width and height were asked for
    uint32_t width = 480; // pixels, [16; 8192]
    uint32_t height = 270;
    uint32_t frames = 33; // [1; 100000]
    float framesPerSecond = 60.0f;
    uint32_t seed = 0;
    uint32_t bounces = 4;
    float roughening = 0.5f; // [0; 1], see TracerDesc
    bool hasJitter = false;
    bool hasTemporalAa = false;       // of pictures to look at, with jitter
    bool hasPsr = false;              // primary surface replacement
    bool hasConfidence = false;       // a few of last frame's paths are traced again
    std::filesystem::path screenshot; // of the last frame, .png or .exr
    std::filesystem::path noisyScreenshot;
    std::filesystem::path referenceScreenshot;
    std::filesystem::path capture; // folder
    std::filesystem::path demo;    // folder
    uint32_t referenceSpp = 0;     // 0: no references
    ReferenceFrames referenceFrames;
    std::filesystem::path script;      // of the window
    std::filesystem::path tests;       // folder; empty: none are run
    std::filesystem::path testResults; // folder; empty: that of the tests
    std::string device;
    bool validation = false;
    bool isHeadless = false;
    bool listDevices = false;
};

/// Fills in what the scene decides: the denoisers if they are to be chosen, and with them the signals. Returns a line
/// for each choice. Throws SettingError when the scene or another option doesn't go with them.
std::vector<std::string> settleDenoisers(Options& options, const Scene& scene);

/// What the options ask of the denoisers: the settings they imply, then --set. Throws SettingError.
ReplaySettings denoiserSettings(const Options& options);

/// Pixels from one that is traced to the next: above 1 where all signals go to denoisers that take no more.
uint32_t tracedStride(const Options& options);

/// nullopt: everything is said and done (--help, --version, or an error on stderr), exit with `exitCode`.
std::optional<Options> parseOptions(int argumentCount, char** arguments, int& exitCode);
} // namespace sample
