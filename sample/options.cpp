#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nrd/descs.h>

namespace sample
{
namespace
{
constexpr const char* kFooter =
    "Against fireflies, in frames and references alike: a path whose demodulated radiance exceeds 250 is dimmed to\n"
    "that, and --roughening blurs caustics. Blended materials let light through, and are seen from an alpha of one "
    "half "
    "on.\n"
    "A denoiser of one lobe is shown with the other lobe noisy. A denoiser of occlusion gives a grey picture of the\n"
    "denoised hit distance, of both lobes their mean. --demo needs a denoiser of radiance.\n"
    "Exit code 0 means that everything asked for was done.";

template <class T> struct Named
{
    const char* name;
    T value;
};
constexpr Named<Lobes> kLobeNames[] = {
    {"both", Lobes::Both}, {"probabilistic", Lobes::Probabilistic}, {"merged", Lobes::Merged}};
constexpr Named<nrd::CheckerboardMode> kCheckerboardNames[] = {{"off", nrd::CheckerboardMode::OFF},
                                                               {"black", nrd::CheckerboardMode::BLACK},
                                                               {"white", nrd::CheckerboardMode::WHITE}};

// "one of A B C", for a list of rows with names.
template <class List> std::string oneOf(const List& list)
{
    std::string text = "one of";
    for (const auto& row : list) text += std::string(" ") + row.name;
    return text;
}

// An option that takes the name of a row of `rows` and stores its value.
template <class T, size_t N, class Target>
CLI::Option* addNamed(CLI::App& app, const char* option, const Named<T> (&rows)[N], Target& value,
                      const char* description)
{
    const auto parse = [&rows, &value, option](const std::string& name)
    {
        const auto* row = std::find_if(rows, rows + N, [&](const Named<T>& r) { return name == r.name; });
        if (row == rows + N) throw CLI::ValidationError(option, "'" + name + "' is not " + oneOf(rows));
        value = row->value;
    };
    return app.add_option_function<std::string>(option, parse, description);
}

void parseBuiltIn(const std::string& name, Options& options)
{
    options.builtIn = findBuiltInScene(name);
    if (!options.builtIn) throw CLI::ValidationError("--scene", "'" + name + "' is not " + oneOf(builtInScenes()));
}

// "960x540"
void parseSize(const std::string& text, Options& options)
{
    unsigned width = 0, height = 0;
    int length = 0;
    if (std::sscanf(text.c_str(), "%ux%u%n", &width, &height, &length) != 2 || size_t(length) != text.size() ||
        width < 16 || width > 8192 || height < 16 || height > 8192)
        throw CLI::ValidationError("--size", "'" + text + "' is not WxH with both in [16; 8192]");
    options.hasSize = true;
    options.width = width;
    options.height = height;
}

void checkPicture(const std::filesystem::path& file, const char* option)
{
    const std::string extension = file.extension().string();
    if (!file.empty() && extension != ".png" && extension != ".exr")
        throw CLI::ValidationError(option, "'" + file.string() + "' does not end in .png or .exr");
}

void addRendering(CLI::App& app, Options& o)
{
    app.add_option("SCENE", o.scene, "glTF 2.0 file, .gltf or .glb");
    app.add_flag("--headless", o.isHeadless, "Render without a window");
    app.add_option("--script", o.script, "File with commands for the window, one a line")->option_text("FILE");
    app.add_option_function<std::string>(
           "--scene", [&o](const std::string& s) { parseBuiltIn(s, o); },
           "Instead of SCENE, " + oneOf(builtInScenes()) + "; default cornell")
        ->option_text("NAME");
    app.add_option("--offset", o.offset, "Move the scene so many units along X: what is lost far from the origin")
        ->check(CLI::Range(-1e6, 1e6));
    app.add_option("--environment", o.environment, "Equirectangular picture, .hdr or .exr");
    app.add_option_function<std::string>(
           "--size", [&o](const std::string& s) { parseSize(s, o); }, "Resolution in pixels, default 480x270")
        ->option_text("WxH");
    app.add_option("--frames", o.frames, "Frames to render, default 33")->check(CLI::Range(1, 100000));
    app.add_option("--fps", o.framesPerSecond, "Frames per second of animation time, default 60")
        ->check(CLI::Range(1.0, 1000.0));
    app.add_option("--sun-radius", o.sunRadius, "Angular radius of suns in degrees; default the scene's, 0.27 in glTF")
        ->check(CLI::Range(0.0, 45.0));
    app.add_option("--bounces", o.bounces, "Rays of a path after the primary one, default 4")->check(CLI::Range(1, 64));
    app.add_option(
           "--roughening", o.roughening,
           "Least roughness of surfaces lit by rough ones, as a share of theirs, default 0.5; 0 = true caustics")
        ->check(CLI::Range(0.0, 1.0));
    app.add_flag("--jitter", o.hasJitter, "Move the sub-pixel position from frame to frame");
    app.add_flag(
        "--taa", o.hasTemporalAa,
        "Temporal anti-aliasing of --screenshot and the window, with --jitter; signals and measures are without");
    app.add_flag("--psr", o.hasPsr,
                 "Primary surface replacement: denoise what smooth metals mirror in place of the mirror");
    app.add_option("--seed", o.seed, "Of the noise, default 0");
}

// What is traced of the two lobes, and what becomes of them.
void addLobes(CLI::App& app, Options& o)
{
    const auto parse = [&o](const std::string& text)
    { o.sets = text == "auto" ? std::vector<DenoiserSet>() : parseDenoiserSets(text); };
    app.add_option_function<std::string>(
           "--denoiser", parse,
           oneOf(sampleDenoisers()) + "; A,B compares several on the same input, A+SIGMA_... has the shadow denoised "
                                      "apart; auto, the default, takes what the scene needs and says why")
        ->option_text("NAMES");
    app.add_option("--switch-every", o.switchEvery,
                   "With several: show (in --screenshot) the next one every so many frames; all run in every frame")
        ->check(CLI::Range(1, 100000));
    app.add_flag("--shadow-signal", o.hasShadowSignal,
                 "Trace the shadow of the sun, or else of a spot light, as a signal of its own, also where none of the "
                 "denoisers takes it: for captures");
    app.add_option_function<std::vector<std::string>>(
           "--set",
           [&o](const std::vector<std::string>& texts)
           {
               for (const std::string& text : texts) o.settings.push_back(parseAssignment(text));
           },
           "A field of the common or the denoiser's settings, such as maxBlurRadius=20; may be repeated")
        ->allow_extra_args(false) // or SCENE after it would be taken for a setting
        ->option_text("KEY=VALUE");
    declareResolution(app, o.resolution);
    app.add_flag("--confidence", o.hasConfidence,
                 "Trace one in 25 of last frame's paths again, so that REBLUR and RELAX know where light has changed");
    addNamed(
        app, "--lobes", kLobeNames, o.lobes,
        "both traces a path for each lobe of a pixel; probabilistic traces one, for the lobe that chance picks, and "
        "has "
        "the denoiser reconstruct hit distances; merged traces one for both, as one diffuse signal; default both, or "
        "what --denoiser auto chooses")
        ->option_text("WHICH");
    addNamed(app, "--checkerboard", kCheckerboardNames, o.checkerboard,
             "black or white: each lobe in every second pixel, the diffuse one in those of that colour in even frames; "
             "default off")
        ->option_text("COLOR");
}

void addOutputs(CLI::App& app, Options& o)
{
    app.add_option("--screenshot", o.screenshot, "Denoised picture of the last frame, .png or .exr");
    app.add_option("--noisy-screenshot", o.noisyScreenshot, "Noisy picture of the last frame");
    app.add_option("--reference-screenshot", o.referenceScreenshot,
                   "Reference of the last frame, with --reference-spp samples (default 128)");
    app.add_option("--capture", o.capture, "Folder to record all signals to")->option_text("DIR");
    app.add_option("--reference-spp", o.referenceSpp, "Samples per pixel of references, 0 = none")
        ->check(CLI::Range(0, 1000000));
    app.add_option_function<std::string>(
           "--reference-frames",
           [&o](const std::string& text)
           {
               try
               {
                   o.referenceFrames = parseReferenceFrames(text);
               }
               catch (const std::invalid_argument& error)
               {
                   throw CLI::ValidationError("--reference-frames", error.what());
               }
           },
           "List (7,8,15,16), or every-K for the pairs (K-1,K), (2K-1,2K); default every-8, with --demo every-16")
        ->option_text("LIST");
    app.add_option("--tests", o.tests, "Run the tests in this folder headless, see the sample's page")
        ->option_text("DIR");
    app.add_option("--test-results", o.testResults, "Folder for their captures and reports, default that of --tests")
        ->option_text("DIR");
    app.add_option("--demo", o.demo, "Folder for noisy, denoised and reference pictures; prints the table of errors")
        ->option_text("DIR");
}

void addDevice(CLI::App& app, Options& o)
{
    app.add_option("--device", o.device, "Index or part of the name of the Vulkan device");
    app.add_flag("--list-devices", o.listDevices, "Print the Vulkan devices and exit");
    app.add_flag("--validation", o.validation, "Khronos validation with synchronisation; any message is a failure");
}

void checkLobes(const Options& o)
{
    const bool isCheckerboard = o.checkerboard != nrd::CheckerboardMode::OFF;
    if (isCheckerboard && o.lobes.value_or(Lobes::Both) != Lobes::Both)
        throw SettingError("--checkerboard: --lobes probabilistic or merged already traces one path per pixel");
    for (const DenoiserSet& set : o.sets)
        if (o.lobes == Lobes::Merged && set.lobes->format(Lobe::Specular) != LobeFormat::None)
            throw SettingError("--lobes merged leaves no specular lobe to " + set.name());
}

void checkResolution(const Options& o)
{
    if (o.resolution.divisor == 1) return;
    if (o.checkerboard != nrd::CheckerboardMode::OFF)
        throw SettingError("--divisor: --checkerboard leaves out pixels already");
    if (o.resolution.isSparse && o.lobes == Lobes::Probabilistic)
        throw SettingError("--sparse: --lobes probabilistic leaves out samples already");
    for (Family family : familiesOf(o.sets))
        if (resolutionOf(family, o.resolution).divisor > 1) return;
    throw SettingError("--divisor: REBLUR and RELAX run at a smaller size, and with --sparse SIGMA");
}

void checkSettings(const Options& o)
{
    if (o.settings.empty()) return;
    if (std::all_of(o.sets.begin(), o.sets.end(), [](const DenoiserSet& set) { return set.isNone(); }))
        throw SettingError("--set: there is no denoiser to set up");
    const ReplaySettings settings = denoiserSettings(o);
    if (settings.reblur.checkerboardMode != o.checkerboard || settings.relax.checkerboardMode != o.checkerboard)
        throw SettingError("--set: checkerboardMode follows from --checkerboard");
}

// What depends on the denoisers, once they are known.
void checkDenoisers(const Options& o)
{
    for (const DenoiserSet& set : o.sets)
        if (!o.demo.empty() && !set.composesLight())
            throw SettingError("--demo: --denoiser " + set.name() + " denoises no radiance");
    if (o.switchEvery > 0 && o.sets.size() < 2)
        throw SettingError("--switch-every: --denoiser names fewer than two, separated by commas");
    checkLobes(o);
    checkResolution(o);
    checkSettings(o);
}

// What depends on more than one option.
void complete(Options& o)
{
    checkPicture(o.screenshot, "--screenshot");
    checkPicture(o.noisyScreenshot, "--noisy-screenshot");
    checkPicture(o.referenceScreenshot, "--reference-screenshot");
    if (!o.scene.empty() && o.builtIn) throw CLI::ValidationError("--scene", "SCENE is given, too");
    if (!o.script.empty() && (o.isHeadless || !o.demo.empty()))
        throw CLI::ValidationError("--script", "commands are for the window, not for --headless");
    if (!o.testResults.empty() && o.tests.empty()) throw CLI::ValidationError("--test-results", "there are no --tests");
    const bool needsReference = !o.demo.empty() || !o.referenceScreenshot.empty();
    if (needsReference && o.referenceSpp == 0) o.referenceSpp = 128; // two minutes on two cores without a GPU
    const bool hasFrames = o.referenceFrames.every != 0 || !o.referenceFrames.list.empty();
    if (o.referenceSpp > 0 && !hasFrames && (!o.capture.empty() || !o.demo.empty()))
        o.referenceFrames.every = o.demo.empty() ? 8 : 16;
    o.hasWholeSignals = o.referenceSpp > 0 || !o.capture.empty() || !o.noisyScreenshot.empty();
    if (!o.referenceScreenshot.empty()) o.referenceFrames.list.push_back(o.frames - 1);
    if (!o.sets.empty()) checkDenoisers(o);
}
} // namespace

ReplaySettings denoiserSettings(const Options& options)
{
    ReplaySettings settings;
    settings.reblur.checkerboardMode = settings.relax.checkerboardMode = options.checkerboard;
    const nrd::HitDistanceReconstructionMode mode = options.lobes == Lobes::Probabilistic
                                                        ? nrd::HitDistanceReconstructionMode::AREA_3X3
                                                        : nrd::HitDistanceReconstructionMode::OFF;
    settings.reblur.hitDistanceReconstructionMode = settings.relax.hitDistanceReconstructionMode = mode;
    applySettings(settings, familiesOf(options.sets), options.settings);
    return settings;
}

uint32_t tracedStride(const Options& options)
{
    const auto isSparse = [&](const SampleDenoiser* denoiser)
    { return denoiser && resolutionOf(denoiser->family, options.resolution).stride() > 1; };
    const auto isDenoised = [&](const DenoiserSet& set)
    {
        const bool hasBoth = set.lobes->hasRadiance(Lobe::Diffuse) && set.lobes->hasRadiance(Lobe::Specular);
        const bool hasLobes = hasBoth || (set.lobes->hasRadiance(Lobe::Diffuse) && options.lobes == Lobes::Merged);
        return hasLobes && isSparse(set.lobes) && (!options.hasShadowSignal || isSparse(set.shadow));
    };
    const bool isAll = options.hasWholeSignals || !std::all_of(options.sets.begin(), options.sets.end(), isDenoised);
    return isAll ? 1 : options.resolution.divisor;
}

std::vector<std::string> settleDenoisers(Options& options, const Scene& scene)
{
    std::vector<std::string> notes;
    if (options.sets.empty())
    {
        SceneFacts facts = factsOf(scene);
        facts.lobes = options.lobes;
        if (!facts.lobes && options.checkerboard != nrd::CheckerboardMode::OFF) facts.lobes = Lobes::Both;
        const DenoiserChoice choice = chooseDenoisers(facts, sampleDenoisers());
        options.sets = {choice.set};
        options.lobes = choice.lobes;
        for (const std::string& reason : choice.reasons) notes.push_back("auto: " + reason);
    }
    options.lobes = options.lobes.value_or(Lobes::Both);
    for (const DenoiserSet& set : options.sets) options.hasShadowSignal |= set.shadow != nullptr;
    if (options.hasShadowSignal && !hasShadowLight(scene))
        throw SettingError("the scene has neither a sun nor a spot light whose shadow could be a signal of its own");
    checkDenoisers(options);
    return notes;
}

bool ReferenceFrames::contains(uint32_t frame) const
{
    if (std::find(list.begin(), list.end(), frame) != list.end()) return true;
    return every > 0 && ((frame > 0 && frame % every == 0) || (frame + 1) % every == 0);
}

ReferenceFrames parseReferenceFrames(const std::string& text)
{
    const auto toNumber = [&](const std::string& part)
    {
        if (part.empty() || part.size() > 6 || part.find_first_not_of("0123456789") != std::string::npos)
            throw std::invalid_argument("'" + text + "' is neither a list of frames nor every-K");
        return static_cast<uint32_t>(std::stoul(part));
    };
    ReferenceFrames frames;
    if (text.rfind("every-", 0) == 0)
    {
        frames.every = toNumber(text.substr(6));
        if (frames.every < 2) throw std::invalid_argument("the K of every-K must be at least 2");
        return frames;
    }
    for (size_t at = 0; at <= text.size();)
    {
        const size_t comma = std::min(text.find(',', at), text.size());
        frames.list.push_back(toNumber(text.substr(at, comma - at)));
        at = comma + 1;
    }
    return frames;
}

std::optional<Options> parseOptions(int argumentCount, char** arguments, int& exitCode)
{
    Options options;
    CLI::App app("Path traces a glTF scene, denoises it and writes pictures, captures and error figures", "nrd-sample");
    app.set_version_flag("--version", "nrd-sample " + std::to_string(nrd::kVersionMajor) + "." +
                                          std::to_string(nrd::kVersionMinor) + "." +
                                          std::to_string(nrd::kVersionBuild));
    app.footer(kFooter);
    addRendering(app, options);
    addLobes(app, options);
    addOutputs(app, options);
    addDevice(app, options);
    try
    {
        app.parse(argumentCount, arguments);
        complete(options);
        return options;
    }
    catch (const CLI::ParseError& error)
    {
        const bool isError = error.get_exit_code() != 0;
        if (isError)
            std::fprintf(stderr, "error: %s\n", error.what());
        else
            app.exit(error); // prints the help or the version
        exitCode = isError ? 1 : 0;
        return std::nullopt;
    }
    catch (const SettingError& error)
    {
        std::fprintf(stderr, "error: %s\n", error.what());
        exitCode = 1;
        return std::nullopt;
    }
}
} // namespace sample
