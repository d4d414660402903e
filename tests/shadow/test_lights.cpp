// One denoiser without history, several lights in one frame.
#include "catch.h"
#include "pictures.h"
#include <runner.h>

using namespace shadow;
using options::Result;
using options::Runner;

namespace
{
constexpr glm::ivec2 kSize{96, 48};

std::vector<options::Setup> makeLights(nrd::Denoiser denoiser)
{
    const Occluder occluder = join({makeSphere({0.5f, 1.0f, 0.0f}, 0.4f), makeEdge(2.0f, -1.0f)});
    std::vector<options::Setup> lights;
    for (const Light& light : {makeSun(70.0f, 20.0f, 0.05f), makeSun(25.0f, 200.0f, 0.01f),
                               makeLamp({1.0f, 3.0f, 0.5f}, 0.3f), makeLamp({-2.0f, 5.0f, 1.0f}, 0.05f)})
    {
        lights.push_back(makeSetup(denoiser, kSize, light, occluder));
        lights.back().hasHistory = false;
    }
    return lights;
}
} // namespace

TEST_CASE("four lights that share a denoiser without history come out as each does alone", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        const std::vector<options::Setup> lights = makeLights(denoiser);
        runner.start(lights[0]);
        std::vector<std::vector<Result>> together;
        for (int frame = 0; frame < 3; frame++) together.push_back(runner.denoiseLights(frame, lights));
        for (size_t i = 0; i < lights.size(); i++)
        {
            runner.start(lights[i]);
            for (int frame = 0; frame < 3; frame++)
            {
                INFO(nrd::toString(denoiser) << ", light " << i << ", frame " << frame);
                const Result alone = runner.denoise(frame);
                CHECK(options::countBroken(alone) == 0);
                CHECK(options::countDifferent(alone, together[size_t(frame)][i]) == 0);
            }
        }
    }
}
