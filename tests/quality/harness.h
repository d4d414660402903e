// Runs a REBLUR or RELAX denoiser through NrdIntegration on images filled from the host; every slot of a lobe gets the
// same image. Any validation message of the device fails the running test case.
#pragma once
#include "scene.h"
#include <functional>
#include <memory>
#include <nrd/integration.h>
#include <variant>
#include <vector>

namespace quality
{
using Signal = std::vector<glm::vec4>; // Y, Co, Cg, normalised hit distance; RELAX: R, G, B, hit distance
using Settings = std::variant<nrd::ReblurSettings, nrd::RelaxSettings>;

struct Frame
{
    Guides guides;
    Signal diffuse, specular;
    std::vector<glm::vec3> motion = {};         // world space; empty = static scene
    std::vector<glm::vec4> specularMotion = {}; // IN_SPEC_MV; empty = not bound
};

using Overlay = std::vector<glm::u8vec4>;

class Harness
{
public:
    Harness(int width, int height, const Settings& settings = {},
            nrd::Denoiser denoiser = nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR);
    Harness(int width, int height, nrd::Denoiser denoiser); // with its family's default settings
    ~Harness();

    // `change` may alter the common settings of this frame; the previous frame's camera is kept here.
    void denoise(const Frame& frame, const std::function<void(nrd::CommonSettings&)>& change = {});

    const Signal& diffuse() const; // as the outputs hold it after the last frame
    const Signal& specular() const;
    const Overlay& overlay() const; // of the last frame with enableValidation
    int width() const;
    int height() const;
    void poisonOutputs(float value); // what outputs hold before the next frame
    void poisonOverlay(glm::u8vec4 value);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

// Rounds as storing in a half float does.
float toHalf(float value);
} // namespace quality
