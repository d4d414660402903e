#include "runners.h"
#include "catch.h"
#include "figures.h"
#include "validated_device.h"
#include <cmath>
#include <map>
#include <memory>
#include <string_view>

namespace stability
{
bool isAny(nrd::Denoiser) { return true; }
bool isDenoiser(nrd::Denoiser denoiser) { return denoiser != nrd::Denoiser::REFERENCE; }

bool hasSpecular(nrd::Denoiser denoiser)
{
    return std::string_view(nrd::toString(denoiser)).find("SPECULAR") != std::string_view::npos;
}

std::vector<nrd::Denoiser> denoisersThat(const Filter& filter)
{
    std::vector<nrd::Denoiser> denoisers;
    for (const nrd::Denoiser denoiser : options::testedDenoisers())
        if (filter(denoiser)) denoisers.push_back(denoiser);
    return denoisers;
}

std::vector<nrd::Denoiser> someThat(const Filter& filter)
{
    return denoisersThat([&](nrd::Denoiser denoiser) { return filter(denoiser) && (isLong() || isWidest(denoiser)); });
}

options::Runner& runnerOf(nrd::Denoiser denoiser)
{
    (void)test::validatedDevice(); // made first, so that it outlives the runners
    static std::map<nrd::Denoiser, std::unique_ptr<options::Runner>> runners;
    std::unique_ptr<options::Runner>& runner = runners[denoiser];
    if (!runner) runner = std::make_unique<options::Runner>(denoiser);
    return *runner;
}

options::Setup makeSetup(nrd::Denoiser denoiser)
{
    options::Setup setup = options::makeSetup(denoiser, kSize);
    setup.hasLargeFormats = true;
    setup.speed = 0.0f;
    return setup;
}

namespace
{
// A shadow's edge takes half of the picture's width; so wide is the penumbra at any distance and field of view.
options::Setup withPenumbra(options::Setup setup)
{
    const bool isShadow = options::familyOf(setup.denoiser) == options::Family::Sigma;
    if (!isShadow || setup.hitDistAt) return setup;
    const float aspect = float(setup.rect.x) / float(setup.rect.y);
    const float quarter = 0.5f * aspect * std::tan(0.5f * setup.fovY); // of the width at a distance of 1
    setup.hitDistAt = [quarter, given = setup](glm::vec3 position, glm::ivec2, int frame)
    { return quarter * (options::makeView(given, frame).camera.worldToView * glm::vec4(position, 1.0f)).z; };
    return setup;
}
} // namespace

void run(const options::Setup& setup, int frameCount, const Look& look)
{
    options::Runner& runner = runnerOf(setup.denoiser);
    runner.start(withPenumbra(setup));
    size_t broken = 0;
    for (int frame = 0; frame < frameCount; frame++)
    {
        const options::Result result = runner.denoise(frame);
        broken += options::countBroken(result);
        look(frame, result);
    }
    INFO(nrd::toString(setup.denoiser));
    CHECK(broken == 0);
}

options::Result runToLast(const options::Setup& setup, int frameCount)
{
    options::Result last;
    run(setup, frameCount, [&](int, const options::Result& result) { last = result; });
    return last;
}
} // namespace stability
