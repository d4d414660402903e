// Runs one denoiser through NrdIntegration, under validation, over frames of any Setup. Pipelines live as long as the
// object, so that a table of options costs few of them.
#pragma once
#include "inputs.h"
#include <memory>
#include <span>
#include <string>

namespace options
{
struct Result
{
    Frame frame;
    std::map<nrd::ResourceType, Plane> outputs;    // `frame.size`
    std::map<nrd::ResourceType, glm::vec4> poison; // what each output image held before
};

class Runner
{
public:
    Runner(nrd::Denoiser denoiser, nrd::NormalEncoding normals = nrd::NormalEncoding::R10_G10_B10_A2_UNORM,
           nrd::RoughnessEncoding roughness = nrd::RoughnessEncoding::LINEAR);
    ~Runner();

    // What follows are frames of a fresh instance: nothing of the frames before is left.
    void start(const Setup& setup);
    // For the frames that follow; no other history.
    void change(const Setup& setup);

    // Frames may begin at any index. The first one after start() clears the outputs.
    Result denoise(int frameIndex);

    // One frame in which the denoiser runs once for each of the setups, on other images each time: what differs between
    // them are SIGMA's lights. The common settings are the first one's.
    std::vector<Result> denoiseLights(int frameIndex, std::span<const Setup> lights);

    // What the last frame left for the next one: textures of the permanent pool that could hold what is no number.
    struct History
    {
        std::string name;
        Plane texels;
    };
    std::vector<History> histories();

    uint32_t pipelineCount() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

// Shorthand: the last of `frameCount` frames of a fresh instance.
Result runFrames(Runner& runner, const Setup& setup, int frameCount);
} // namespace options
