#include "renderer.h"

#include "engine/transfer.h"
#include "gltf.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

namespace sample
{
namespace
{
constexpr uint32_t kFramesInFlight = 2;
constexpr uint32_t kTracingMarks = 3; // before, between and after re-traced samples and a frame
constexpr uint32_t kBatch = 8;        // samples of one submission: short enough for the watchdogs of desktop GPUs

TracerDesc tracerDesc(const Options& options)
{
    TracerDesc desc;
    desc.width = options.width;
    desc.height = options.height;
    desc.seed = options.seed;
    desc.maxBounces = options.bounces;
    desc.roughening = options.roughening;
    desc.lobes = options.lobes.value_or(Lobes::Both);
    desc.checkerboard = options.checkerboard;
    desc.stride = tracedStride(options);
    desc.hitDistanceParameters = hitDistanceParametersOf(denoiserSettings(options));
    desc.hasShadowSignal = options.hasShadowSignal;
    desc.mirrorRoughness = options.hasPsr ? kMirrorRoughness : 0.0f;
    return desc;
}

CaptureLight toCapture(const SceneLight& light)
{
    CaptureLight out;
    out.isLocal = light.kind != LightKind::Directional;
    for (int i = 0; i < 3; ++i)
    {
        out.direction[size_t(i)] = -double(light.direction[i]);
        out.position[size_t(i)] = double(light.position[i]);
    }
    out.tanAngularRadius = double(light.source.tanAngularRadius);
    out.radius = double(light.source.radius);
    return out;
}

const Environment* environmentOf(const Stage& stage) { return stage.environment ? &*stage.environment : nullptr; }

Image readPicture(const engine::Device& device, engine::Image& source)
{
    Image picture(static_cast<int>(source.desc().width), static_cast<int>(source.desc().height));
    picture.rgba = engine::readBackAs<float>(device, source);
    return picture;
}

// `count` components of a picture as planes.
Picture toPlanes(const Image& image, size_t first, size_t count)
{
    Picture picture(image.width, image.height, count);
    for (size_t c = 0; c < count; ++c)
        for (size_t i = 0; i < picture.pixelCount(); ++i) picture.planes[c][i] = image.rgba[i * 4 + first + c];
    return picture;
}

Matrix toMatrix(const glm::mat4& m)
{
    Matrix out;
    for (int i = 0; i < 16; ++i) out[size_t(i)] = double(m[i / 4][i % 4]);
    return out;
}

CaptureCheckerboard toCapture(nrd::CheckerboardMode mode)
{
    using nrd::CheckerboardMode;
    static_assert(int(CheckerboardMode::BLACK) == int(CaptureCheckerboard::Black) &&
                  int(CheckerboardMode::WHITE) == int(CaptureCheckerboard::White));
    return static_cast<CaptureCheckerboard>(mode);
}

// first..first+2 of `planes` as a picture.
Image toImage(const Planes& planes, Channel first)
{
    Image image(planes.width, planes.height);
    for (size_t i = 0; i < planes.pixelCount(); ++i)
    {
        for (int c = 0; c < 3; ++c) image.rgba[i * 4 + size_t(c)] = planes[next(first, c)][i];
        image.rgba[i * 4 + 3] = 1.0f;
    }
    return image;
}
} // namespace

DenoiseDesc denoiseDesc(const Options& options, const Scene& scene, const DenoiserSet& set)
{
    DenoiseDesc desc;
    desc.set = set;
    desc.width = options.width;
    desc.height = options.height;
    desc.framesInFlight = kFramesInFlight;
    desc.settings = denoiserSettings(options);
    desc.assignments = options.settings;
    desc.resolution = options.resolution;
    desc.isSceneMoving = !scene.channels.empty();
    desc.hasShadowSignal = options.hasShadowSignal;
    desc.hasTemporalAa = options.hasTemporalAa;
    desc.hasConfidence = options.hasConfidence;
    return desc;
}

engine::DeviceDesc deviceDescOf(const Options& options)
{
    engine::DeviceDesc desc = denoiserDeviceDesc();
    desc.device = options.device;
    desc.validation = options.validation;
    return desc;
}

void checkValidation(const engine::Device& device)
{
    if (const uint32_t count = device.validationMessageCount())
        throw engine::Error("the validation layer reported " + std::to_string(count) + " messages");
}

Stage loadStage(const Options& options)
{
    Stage stage;
    const bool isDefault = options.scene.empty() && !options.builtIn;
    if (isDefault) stage.notes.push_back("No scene was given: showing the built-in Cornell box.");
    const BuiltInScene& builtIn = options.builtIn ? *options.builtIn : builtInScenes().front();
    stage.scene = options.scene.empty() ? builtIn.make() : loadGltf(options.scene);
    stage.scene.origin.x = options.offset;
    for (PunctualLight& light : stage.scene.lights)
        if (options.sunRadius) light.tanAngularRadius = std::tan(glm::radians(*options.sunRadius));
    if (!options.environment.empty()) stage.environment = makeEnvironment(readImage(options.environment));
    if (!stage.environment && !hasLights(stage.scene))
    {
        stage.environment = makeSky();
        stage.isDefaultSky = true;
        stage.notes.push_back("The scene has no light: lighting it with the default sky.");
    }
    return stage;
}

Renderer::Renderer(const engine::Device& device, const Stage& stage, const Options& options)
    : m_device(device), m_stage(stage), m_options(options), m_pose(stage.scene),
      m_tracer(device, stage.scene, environmentOf(stage), tracerDesc(options)), m_ring(device, kFramesInFlight)
{
    for (uint32_t i = 0; i < kFramesInFlight; ++i) m_timestamps.emplace_back(device, kTracingMarks);
    if (options.hasConfidence) m_retrace.emplace(device, options.width, options.height);
    for (const DenoiserSet& set : options.sets)
        m_stages.push_back(std::make_unique<DenoiseStage>(device, denoiseDesc(options, stage.scene, set)));
    const float aspect = float(options.width) / float(options.height);
    if (!findCamera(stage.scene, *m_pose, aspect)) m_framing = frameBounds(m_pose->bounds(), aspect);
    m_tracer.setPose(stage.scene, *m_pose, environmentOf(stage));
    if (m_tracer.shadowLight()) m_firstLight = toCapture(*m_tracer.shadowLight());
}

Camera Renderer::currentCamera(float aspect) const
{
    return m_framing ? *m_framing : *findCamera(m_stage.scene, *m_pose, aspect);
}

void Renderer::setStage(size_t index, std::unique_ptr<DenoiseStage> stage)
{
    m_device.waitIdle();
    if (index >= m_stages.size()) m_stages.resize(index + 1);
    m_stages[index] = std::move(stage);
}

void Renderer::refreshScene()
{
    m_tracer.setEnvironment(environmentOf(m_stage));
    m_pose.emplace(m_stage.scene);
    if (m_time) m_pose->update(*m_time);
    m_pose->forgetPrevious();
    m_tracer.setPose(m_stage.scene, *m_pose, environmentOf(m_stage));
}

void Renderer::renderFrame()
{
    FrameInput input;
    input.time = double(m_nextFrame) / double(m_options.framesPerSecond);
    input.deltaTimeMs = 1000.0f / m_options.framesPerSecond;
    renderFrame(input);
}

void Renderer::renderFrame(const FrameInput& input)
{
    startFrame(input);
    m_ring.waitAll();
}

// Where time stands still nothing moves, which the first such frame has to say.
void Renderer::pose(const FrameInput& input)
{
    if (!m_pose->isAnimated()) return;
    const bool isStill = m_time == input.time;
    if (isStill && m_isStill) return;
    if (!isStill) m_pose->update(input.time);
    if (isStill || m_nextFrame == 0 || input.isCut) m_pose->forgetPrevious();
    m_time = input.time;
    m_isStill = isStill;
    m_tracer.setPose(m_stage.scene, *m_pose, environmentOf(m_stage));
}

void Renderer::trace(VkCommandBuffer cmd, const View& lastView)
{
    engine::Timestamps& timestamps = m_timestamps[m_ring.slot()];
    const std::vector<double> last = timestamps.read(); // of the slot's frame before, which is done
    if (last.size() == 2) m_tracingTimes = {{"re-traced samples", float(last[0])}, {"paths", float(last[1])}};
    if (last.size() == 2 && !m_retrace) m_tracingTimes.erase(m_tracingTimes.begin());
    timestamps.reset(cmd);
    timestamps.mark(cmd);
    if (m_retrace) m_retrace->record(cmd, m_tracer, lastView);
    timestamps.mark(cmd);
    m_tracer.recordFrame(cmd, m_frame.view);
    timestamps.mark(cmd);
}

void Renderer::startFrame(const FrameInput& input)
{
    pose(input);
    const uint32_t index = m_nextFrame++;
    const View lastView = m_frame.view;
    m_frame.view.camera =
        input.camera ? *input.camera : currentCamera(float(m_options.width) / float(m_options.height));
    m_frame.view.jitter = m_options.hasJitter || m_options.hasTemporalAa ? jitterOf(index) : glm::vec2(0.0f);
    m_frame.view.frameIndex = index;
    m_frame.denoisingRange = m_tracer.denoisingRange();
    m_frame.deltaTimeMs = input.deltaTimeMs;
    m_frame.isCut = index == 0 || input.isCut;
    m_frame.shadowLight = m_tracer.shadowLight();
    m_frame.retrace = m_retrace ? &*m_retrace : nullptr;
    VkCommandBuffer cmd = m_ring.begin();
    trace(cmd, index == 0 ? m_frame.view : lastView);
    for (auto& stage : m_stages)
        if (stage) stage->record(cmd, m_tracer.images(), m_frame);
    m_ring.submit();
}

Planes Renderer::readFrame()
{
    FrameImages& images = m_tracer.images();
    Planes planes(static_cast<int>(m_options.width), static_cast<int>(m_options.height));
    planes[Channel::ViewZ] = engine::readBackAs<float>(m_device, images.viewZ);
    const Image surface = readPicture(m_device, images.normalRoughness);
    planes.set(Channel::NormalX, surface, 3);
    planes.set(Channel::Roughness, surface, 1, 3);
    const Image motion = readPicture(m_device, images.motion);
    planes.set(Channel::MotionX, motion, 3);
    planes.set(Channel::MaterialId, motion, 1, 3);
    planes.set(Channel::DiffuseR, readPicture(m_device, images.diffuse), 4);
    planes.set(Channel::DiffuseDX, readPicture(m_device, images.diffuseDirection), 3);
    planes.set(Channel::SpecularR, readPicture(m_device, images.specular), 4);
    planes.set(Channel::SpecularDX, readPicture(m_device, images.specularDirection), 3);
    if (!m_stage.scene.channels.empty())
        planes.set(Channel::SpecularMX, readPicture(m_device, images.specularMotion), 3);
    planes.set(Channel::DiffuseFactorR, readPicture(m_device, images.diffuseFactor), 3);
    planes.set(Channel::SpecularFactorR, readPicture(m_device, images.specularFactor), 3);
    planes.set(Channel::DirectR, readPicture(m_device, images.direct), 3);
    if (m_options.hasShadowSignal)
    {
        const Image shadow = readPicture(m_device, images.shadow);
        planes.set(Channel::ShadowDist, shadow, 1, 3);
        planes.set(Channel::ShadowR, shadow, 3);
        planes.set(Channel::SunR, readPicture(m_device, images.sun), 3);
    }
    return planes;
}

Planes Renderer::traceReference(const Planes& frame, uint32_t samples, const std::function<void(double)>& progress)
{
    for (uint32_t first = 0; first < samples; first += kBatch)
    {
        const ReferenceBatch batch = {first, std::min(kBatch, samples - first)};
        engine::submitAndWait(m_device,
                              [&](VkCommandBuffer cmd) { m_tracer.recordReference(cmd, m_frame.view, batch); });
        progress(double(first + batch.count) / double(samples));
    }
    return readSums(samples, frame);
}

Planes Renderer::readSums(uint32_t samples, const Planes& frame)
{
    Image diffuse = readPicture(m_device, m_tracer.sumDiffuse());
    Image specular = readPicture(m_device, m_tracer.sumSpecular());
    Image shadow = readPicture(m_device, m_tracer.sumShadow());
    for (Image* image : {&diffuse, &specular, &shadow})
        for (float& x : image->rgba) x /= float(samples);
    Planes planes(frame.width, frame.height);
    planes.set(Channel::RefDiffuseR, diffuse, 4); // .w: the normalised hit distance
    planes.set(Channel::RefSpecularR, specular, 4);
    if (m_options.hasShadowSignal)
    {
        planes.set(Channel::RefShadowV, shadow, 1, 3);
        planes.set(Channel::RefShadowR, shadow, 3);
    }
    Image composed(frame.width, frame.height);
    for (size_t i = 0; i < frame.pixelCount(); ++i)
    {
        for (int c = 0; c < 3; ++c)
            composed.rgba[i * 4 + size_t(c)] =
                frame[next(Channel::DirectR, c)][i] +
                frame[next(Channel::DiffuseFactorR, c)][i] * diffuse.rgba[i * 4 + size_t(c)] +
                frame[next(Channel::SpecularFactorR, c)][i] * specular.rgba[i * 4 + size_t(c)];
        for (int c = 0; c < 3 && m_options.hasShadowSignal; ++c)
            composed.rgba[i * 4 + size_t(c)] += frame[next(Channel::SunR, c)][i] * shadow.rgba[i * 4 + size_t(c)];
    }
    planes.set(Channel::RefComposedR, composed, 3);
    return planes;
}

Signals Renderer::readDenoised(size_t set)
{
    constexpr Signal kRadiance[] = {Signal::Diffuse, Signal::Specular};
    constexpr Signal kHitDistance[] = {Signal::NormHitDist, Signal::SpecularNormHitDist};
    Signals signals;
    for (Lobe lobe : kLobes)
    {
        engine::Image* denoised = m_stages[set]->denoised(lobe);
        if (!denoised) continue;
        const Image image = readPicture(m_device, *denoised);
        const auto i = static_cast<size_t>(lobe);
        if (m_stages[set]->set().lobes->hasRadiance(lobe)) signals[kRadiance[i]] = toPlanes(image, 0, 3);
        signals[kHitDistance[i]] = toPlanes(image, 3, 1);
    }
    if (engine::Image* denoised = m_stages[set]->denoisedShadow())
    {
        const Image image = readPicture(m_device, *denoised);
        signals[Signal::Shadow] = toPlanes(image, 3, 1);
        signals[Signal::Translucency] = toPlanes(image, 0, 3);
    }
    return signals;
}

Image Renderer::readShown() { return readPicture(m_device, m_stages[shownSet()]->shown()); }

size_t Renderer::shownSet() const
{
    return m_options.switchEvery > 0 ? frameIndex() / m_options.switchEvery % m_stages.size() : 0;
}

CaptureFrame Renderer::captureFrame() const
{
    CaptureFrame frame;
    frame.deltaTimeMs = double(m_frame.deltaTimeMs);
    frame.jitter = {double(m_frame.view.jitter.x), double(m_frame.view.jitter.y)};
    frame.isCut = m_frame.isCut;
    frame.viewToClip = toMatrix(m_frame.view.camera.viewToClip);
    frame.worldToView = toMatrix(m_frame.view.camera.worldToView);
    if (m_frame.shadowLight && toCapture(*m_frame.shadowLight) != m_firstLight)
        frame.light = toCapture(*m_frame.shadowLight);
    return frame;
}

CaptureInfo Renderer::captureInfo() const
{
    CaptureInfo info;
    info.name = m_stage.scene.name;
    info.width = static_cast<int>(m_options.width);
    info.height = static_cast<int>(m_options.height);
    info.denoisingRange = double(m_tracer.denoisingRange());
    const glm::vec3 h = m_tracer.desc().hitDistanceParameters;
    info.hitDistanceParameters = {double(h.x), double(h.y), double(h.z), -25.0};
    info.checkerboard = toCapture(m_options.checkerboard);
    info.light = m_firstLight;
    return info;
}

Image composeNoisy(const Planes& frame)
{
    Image image = toImage(frame, Channel::DirectR);
    for (size_t i = 0; i < frame.pixelCount(); ++i)
        for (int c = 0; c < 3; ++c)
            image.rgba[i * 4 + size_t(c)] +=
                frame[next(Channel::DiffuseR, c)][i] * frame[next(Channel::DiffuseFactorR, c)][i] +
                frame[next(Channel::SpecularR, c)][i] * frame[next(Channel::SpecularFactorR, c)][i];
    for (size_t i = 0; i < frame.pixelCount() && frame.has(Channel::SunR); ++i)
        for (int c = 0; c < 3; ++c)
            image.rgba[i * 4 + size_t(c)] += frame[next(Channel::SunR, c)][i] * frame[next(Channel::ShadowR, c)][i];
    return image;
}

Image composedOf(const Planes& reference) { return toImage(reference, Channel::RefComposedR); }
} // namespace sample
