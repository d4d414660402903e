#include "window/viewer.h"

#include "shaders/view_modes.h"
#include "window/views.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sample
{
namespace
{
constexpr size_t kTimesKept = 240;
constexpr uint32_t kSamplesPerMeasure = 16; // of the reference: measuring reads pictures back

bool isSameCamera(const Camera& a, const Camera& b)
{
    return a.worldToView == b.worldToView && a.viewToClip == b.viewToClip;
}

bool losesSpecular(const Side& side, Lobes lobes)
{
    return lobes == Lobes::Merged && side.set.lobes->format(Lobe::Specular) != LobeFormat::None;
}
} // namespace

Viewer::Viewer(const engine::Device& device, Stage stage, const Options& options, uint32_t slotCount,
               FirstPicture first)
    : m_device(device), m_stage(std::move(stage)), m_options(options), m_slotCount(slotCount),
      m_isNoisyFirst(first == FirstPicture::Noisy), m_ring(device, 2)
{
    settleDenoisers(m_options, m_stage.scene);
    m_untouchedEnvironment = m_stage.environment;
    const Resolution resolution = std::exchange(m_options.resolution, {}); // each side has its own
    state.sides = {Side{m_options.sets[0], {}, resolution}, Side{m_options.sets.back(), {}, resolution}};
    state.isCompared = m_options.sets.size() > 1;
    if (!state.isCompared) state.sides[1] = {parseDenoiserSets("NONE").front(), {}};
    for (const Assignment& assignment : m_options.settings) set(assignment);
    state.bounces = m_options.bounces;
    state.roughening = m_options.roughening;
    state.hasJitter = m_options.hasJitter;
    state.hasPsr = m_options.hasPsr;
    state.hasTemporalAa = m_options.hasTemporalAa;
    state.hasConfidence = m_options.hasConfidence;
    state.lobes = *m_options.lobes;
    state.checkerboard = m_options.checkerboard;
    const std::optional<SunAngles> sun = sunOf(m_stage.scene);
    m_hasSun = sun || m_stage.isDefaultSky;
    state.sun = sun.value_or(anglesOf(kDefaultSun));
    build();
}

void Viewer::build()
{
    m_device.waitIdle();
    m_options.sets.clear(); // the stages are made here, each with its own settings
    m_options.settings.clear();
    m_options.lobes = state.lobes;
    m_options.hasPsr = state.hasPsr;
    m_options.hasTemporalAa = state.hasTemporalAa;
    m_options.checkerboard = state.checkerboard;
    m_options.hasConfidence = state.hasConfidence;
    m_options.hasShadowSignal = state.sides[0].set.shadow || (state.isCompared && state.sides[1].set.shadow);
    m_renderer.reset();
    m_renderer = std::make_unique<Renderer>(m_device, m_stage, m_options);
    m_display.emplace(m_device, m_options.width, m_options.height, m_slotCount);
    m_reference.emplace(m_device, m_options.width, m_options.height);
    DenoiseDesc noisy = denoiseDesc(m_options, m_stage.scene, parseDenoiserSets("NONE").front());
    noisy.hasTemporalAa = false;
    m_renderer->setStage(kNoisy, std::make_unique<DenoiseStage>(m_device, noisy));
    followSide(0, true);
    if (state.isCompared) followSide(1, true);
    m_applied = state;
    m_isCut = true;
}

Options Viewer::optionsOf(const Side& side) const
{
    Options options = m_options;
    options.sets = {side.set};
    options.settings = side.settings;
    options.resolution = side.resolution;
    return options;
}

// Where the sides read different pixels, all are traced.
uint32_t Viewer::stride() const
{
    const uint32_t stride = tracedStride(optionsOf(state.sides[0]));
    return !state.isCompared || tracedStride(optionsOf(state.sides[1])) == stride ? stride : 1;
}

ReplaySettings Viewer::settingsOf(const Side& side, bool isDefault) const
{
    Options options = optionsOf(side);
    if (isDefault) options.settings.clear();
    return denoiserSettings(options);
}

// With what the view needs of the denoiser.
std::vector<Assignment> Viewer::effectiveSettings(size_t index) const
{
    const Side& side = state.sides[index];
    std::vector<Assignment> settings = side.settings;
    const Family family = side.set.lobes->family;
    const ViewRow& view = views()[state.view];
    if (view.mode == VIEW_OVERLAY && hasOverlay(family)) assign(settings, {"enableValidation", "true"});
    if (family == Family::Reblur && side.set.lobes->composesLight() && (view.showsHistory || state.picked))
        assign(settings, {"returnHistoryLengthInsteadOfOcclusion", "true"});
    return settings;
}

void Viewer::followSide(size_t index, bool isNew)
{
    const std::vector<Assignment> settings = m_isNoisyFirst ? std::vector<Assignment>() : effectiveSettings(index);
    const DenoiserSet set = m_isNoisyFirst ? parseDenoiserSets("NONE").front() : state.sides[index].set;
    const Side side = {set, settings, state.sides[index].resolution};
    const size_t place = index == 0 ? kSideA : kSideB;
    if (isNew)
    {
        DenoiseDesc desc = denoiseDesc(optionsOf(side), m_stage.scene, side.set);
        desc.isTimed = desc.hasOverlay = true;
        desc.shaders = &m_shaders;
        m_renderer->setStage(place, std::make_unique<DenoiseStage>(m_device, desc));
        m_frameTimes.clear();
    }
    else if (settings != m_appliedSettings[index])
        m_renderer->stage(place).setSettings(settingsOf(side), settings);
    m_appliedSettings[index] = settings;
    if (index == 0) m_renderer->tracer().setHitDistanceParameters(hitDistanceParametersOf(settingsOf(side)));
}

// What is traced must suit the denoisers.
void Viewer::followSamples(const Side& side)
{
    const auto change = [&](const std::string& why, Lobes lobes)
    {
        m_message = why;
        state.lobes = lobes;
        state.checkerboard = nrd::CheckerboardMode::OFF;
    };
    if (losesSpecular(side, state.lobes))
        change("merged lobes leave no specular one to " + side.set.name() + ": tracing both", Lobes::Both);
    if (side.resolution.stride() > 1 && state.lobes == Lobes::Probabilistic)
        change("sparse tracing leaves out samples already: tracing both lobes", Lobes::Both);
    if (side.resolution.divisor > 1 && state.checkerboard != nrd::CheckerboardMode::OFF)
        change("half resolution leaves out samples already: tracing without a checkerboard", state.lobes);
}

void Viewer::followTracer()
{
    for (Side& side : state.sides)
        if (side.set.shadow && !hasShadowLight(m_stage.scene))
        {
            m_message = "the scene has neither a sun nor a spot light whose shadow could be a signal of its own";
            side.set.shadow = nullptr;
        }
    for (size_t i = 0; i < (state.isCompared ? 2u : 1u); ++i) followSamples(state.sides[i]);
    if (state.lobes != Lobes::Both) state.checkerboard = nrd::CheckerboardMode::OFF; // one path per pixel already
    const bool hasShadow = state.sides[0].set.shadow || (state.isCompared && state.sides[1].set.shadow);
    const bool isOther = state.lobes != m_applied.lobes || state.checkerboard != m_applied.checkerboard ||
                         hasShadow != m_options.hasShadowSignal || state.hasPsr != m_applied.hasPsr ||
                         state.hasTemporalAa != m_applied.hasTemporalAa ||
                         state.hasConfidence != m_applied.hasConfidence;
    if (isOther) build();
    m_options.hasJitter = state.hasJitter;
    m_renderer->tracer().setLimits(state.bounces, state.roughening);
    m_renderer->tracer().setStride(stride());
    if (state.bounces != m_applied.bounces || state.roughening != m_applied.roughening) m_restingCamera.reset();
}

void Viewer::followLights()
{
    if (state.sun == m_applied.sun && state.environmentTurn == m_applied.environmentTurn) return;
    if (!(state.sun == m_applied.sun) && !turnSun(m_stage.scene, state.sun) && m_stage.isDefaultSky)
        m_untouchedEnvironment = makeSky(directionOf(state.sun));
    if (m_untouchedEnvironment) m_stage.environment = rotated(*m_untouchedEnvironment, state.environmentTurn / 360.0f);
    m_renderer->refreshScene();
    m_restingCamera.reset();
}

void Viewer::followSides()
{
    for (size_t i = 0; i < state.sides.size(); ++i)
    {
        const bool isWanted = i == 0 || state.isCompared;
        const bool wasThere = i == 0 || m_applied.isCompared;
        if (!isWanted && wasThere) m_renderer->setStage(kSideB, nullptr);
        if (!isWanted) continue;
        const DenoiserSet& now = state.sides[i].set;
        const DenoiserSet& before = m_applied.sides[i].set;
        const bool isNew =
            !wasThere || now.name() != before.name() || !(state.sides[i].resolution == m_applied.sides[i].resolution);
        const bool isOther = wasThere && now.lobes->family != before.lobes->family; // other meanings, other ranges
        if (isNew)
            std::erase_if(state.sides[i].settings, [&](const Assignment& a)
                          { return isOther ? !isCommonSetting(a.first) : !hasSetting(now.families(), a.first); });
        followSide(i, isNew);
    }
}

void Viewer::startDenoisers()
{
    m_isNoisyFirst = false;
    followSide(0, true);
    if (m_applied.isCompared) followSide(1, true);
    state.isRestarted = true;
}

bool Viewer::advance(double seconds)
{
    m_wasRefused = false;
    const bool isStart = awaitsDenoisers();
    try
    {
        if (isStart) startDenoisers();
        followTracer();
        followLights();
        followSides();
    }
    catch (const std::exception& error)
    {
        if (!m_renderer) throw;
        m_message = error.what();
        m_wasRefused = true;
        state.sides = m_applied.sides; // what was refused changed nothing
        state.isCompared = m_applied.isCompared;
        if (isStart) startDenoisers(); // throws if it was not the change that could not be had
        followSides();
    }
    m_applied = state;
    const bool isDue = !state.isPaused || state.steps > 0 || m_frameCount == 0;
    if (isDue) renderFrame(seconds);
    if (state.hasReference) gatherReference();
    return isDue;
}

void Viewer::renderFrame(double seconds)
{
    if (state.steps > 0) --state.steps;
    m_time += seconds * double(state.animationSpeed);
    FrameInput input;
    input.time = m_time;
    input.deltaTimeMs = float(std::clamp(1000.0 * seconds, 0.1, 1000.0));
    input.isCut = m_isCut || state.isRestarted;
    if (state.cameraMode != CameraMode::Scene)
        input.camera = state.camera.camera(float(m_options.width) / float(m_options.height));
    m_renderer->startFrame(input);
    m_isCut = state.isRestarted = m_applied.isRestarted = false;
    ++m_frameCount;
    if (isAnimated() && state.animationSpeed > 0.0f) m_restingCamera.reset();
    keepTimes();
}

void Viewer::keepTimes()
{
    const nrd::Timings timings = side(0).timings();
    if (timings.frame == 0) return;
    if (m_frameTimes.size() == kTimesKept) m_frameTimes.erase(m_frameTimes.begin());
    m_frameTimes.push_back(timings.totalMilliseconds);
}

void Viewer::gatherReference()
{
    const Camera& camera = m_renderer->frame().view.camera;
    if (!m_restingCamera || !isSameCamera(*m_restingCamera, camera))
    {
        m_reference->restart();
        m_errors = {};
    }
    m_restingCamera = camera;
    const uint32_t before = m_reference->sampleCount();
    m_reference->record(m_ring.begin(), m_renderer->tracer(), m_renderer->frame().view, state.referenceSamples);
    m_ring.submit();
    if (before / kSamplesPerMeasure == m_reference->sampleCount() / kSamplesPerMeasure) return;
    for (size_t i = 0; i < (state.isCompared ? 2u : 1u); ++i)
        m_errors[i] = measurePsnr(m_device, side(i).composed(), m_reference->composed());
}

void Viewer::resize(uint32_t width, uint32_t height)
{
    m_options.width = width;
    m_options.height = height;
    state.picked.reset();
    m_restingCamera.reset();
    build();
    m_frameCount = 0;
}

void Viewer::startCamera(CameraMode mode)
{
    if (state.cameraMode == CameraMode::Scene && mode != CameraMode::Scene)
    {
        const Camera camera = m_frameCount > 0 ? m_renderer->frame().view.camera : m_renderer->currentCamera(1.0f);
        const glm::vec3 eye(glm::inverse(camera.worldToView)[3]);
        state.camera.start(camera, std::max(glm::length(m_renderer->sceneCenter() - eye), 1e-3f));
    }
    state.cameraMode = mode;
}

std::set<std::string> Viewer::shaders()
{
    std::set<std::string> names = side(0).shaders();
    if (m_applied.isCompared) names.merge(side(1).shaders());
    return names;
}

void Viewer::setShaders(ShaderModules modules)
{
    m_device.waitIdle();
    std::swap(m_shaders, modules);
    try
    {
        startDenoisers();
    }
    catch (const engine::Error&)
    {
        std::swap(m_shaders, modules);
        startDenoisers();
        throw;
    }
}

std::vector<std::string> Viewer::arguments() const
{
    constexpr const char* kLobeNames[] = {"both", "probabilistic", "merged"};
    constexpr const char* kColors[] = {"off", "black", "white"};
    const Side& side = state.sides[0];
    const auto number = [](double value) { return std::to_string(value); };
    std::vector<std::string> all = {"--denoiser", side.set.name(), "--size",
                                    std::to_string(m_options.width) + "x" + std::to_string(m_options.height)};
    const auto add = [&](const char* name, const std::string& value) { all.insert(all.end(), {name, value}); };
    if (m_options.scene.empty())
        add("--scene", (m_options.builtIn ? *m_options.builtIn : builtInScenes().front()).name);
    else
        all.push_back(std::filesystem::absolute(m_options.scene).string());
    if (!m_options.environment.empty()) add("--environment", std::filesystem::absolute(m_options.environment).string());
    if (m_options.offset != 0.0f) add("--offset", number(double(m_options.offset)));
    if (m_options.sunRadius) add("--sun-radius", number(double(*m_options.sunRadius)));
    for (const Assignment& assignment : side.settings) add("--set", assignment.first + "=" + assignment.second);
    add("--lobes", kLobeNames[size_t(state.lobes)]);
    add("--checkerboard", kColors[size_t(state.checkerboard)]);
    add("--divisor", std::to_string(side.resolution.divisor));
    if (side.resolution.isSparse) all.emplace_back("--sparse");
    add("--bounces", std::to_string(state.bounces));
    add("--roughening", number(double(state.roughening)));
    add("--seed", std::to_string(m_options.seed));
    if (state.hasJitter) all.emplace_back("--jitter");
    if (state.hasTemporalAa) all.emplace_back("--taa");
    if (state.hasPsr) all.emplace_back("--psr");
    if (state.hasConfidence) all.emplace_back("--confidence");
    return all;
}

void Viewer::set(const Assignment& assignment)
{
    ReplaySettings settings;
    applySettings(settings, state.sides[0].set.families(), {assignment});
    checkRanges(settings, state.sides[0].set.families(), assignment.first);
    assign(state.sides[0].settings, assignment);
}

void Viewer::setDenoisers(const std::string& names)
{
    const std::vector<DenoiserSet> sets = parseDenoiserSets(names);
    if (sets.size() > 2) throw SettingError("--denoiser: the window compares two of them, not " + names);
    state.sides[0].set = sets.front();
    state.isCompared = sets.size() > 1;
    if (state.isCompared) state.sides[1].set = sets.back();
}
} // namespace sample
