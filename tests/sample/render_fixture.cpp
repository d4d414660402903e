#include "render_fixture.h"

#include "catch.h"
#include "sample_device.h"

using namespace sample;

namespace test
{
Options renderOptions(const char* denoiser, bool hasPsr)
{
    Options options;
    options.width = 192;
    options.height = 108;
    options.sets = parseDenoiserSets(denoiser);
    options.lobes = Lobes::Both;
    options.hasPsr = hasPsr;
    return options;
}

Run::Run(Scene scene, std::optional<Environment> sky, const Options& options)
    : m_options(options), m_stage{std::move(scene), std::move(sky), false, {}},
      m_renderer(sampleDevice(), m_stage, m_options)
{
}

Run::~Run() { CHECK(sampleDevice().validationMessageCount() == 0); }

void Run::renderFrames(uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i) m_renderer.renderFrame();
}

void Run::renderAt(double time)
{
    FrameInput input;
    input.time = time;
    m_renderer.startFrame(input);
}

Picture Run::shown() { return toPicture(m_renderer.readShown()); }

Picture Run::reference(uint32_t samples)
{
    const Planes frame = m_renderer.readFrame();
    return toPicture(composedOf(m_renderer.traceReference(frame, samples, [](double) {})));
}

Mask Run::maskOf(int material)
{
    const Planes frame = m_renderer.readFrame();
    Mask mask(frame.pixelCount());
    for (size_t i = 0; i < mask.size(); ++i) mask[i] = int(frame[Channel::MaterialId][i]) == material;
    return mask;
}

double flipOf(const Picture& result, const Picture& reference, const Mask& mask)
{
    return flip(rangeCompressed(result), rangeCompressed(reference), mask);
}
} // namespace test
