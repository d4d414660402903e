// Runs what makes confidence on images filled from the host. Any validation message fails the running test case.
#pragma once
#include <glm/glm.hpp>
#include <memory>
#include <nrd/integration.h>
#include <test_image.h>

namespace confidence
{
constexpr uint32_t kTileSize = 5;
constexpr int kWidth = 40, kHeight = 24; // tiles

struct Inputs
{
    test::Plane stored, retraced, normalRoughness; // a texel per tile
};

struct Outputs
{
    std::vector<float> diffuse, specular;
};

class Passes
{
public:
    explicit Passes(const nrd::ConfidenceSettings& settings = {});
    ~Passes();
    // The next frame, by the default camera of the tests of the descriptor library.
    Outputs run(const Inputs& inputs);
    // The sentence that refuses confidence images said to be `width` tiles wide.
    std::string refusalOf(uint32_t width);

private:
    void beginFrame();
    void record(rhi::CommandBuffer& commands);
    nrd::NrdUserPool makePool();

    test::Image m_stored{rhi::Format::RGBA16_SFLOAT, kWidth, kHeight};
    test::Image m_retraced{rhi::Format::RGBA16_SFLOAT, kWidth, kHeight};
    test::Image m_normalRoughness{rhi::Format::A2B10G10R10_UNORM_PACK32, kWidth, kHeight};
    test::Image m_diffuse{rhi::Format::R8_UNORM, kWidth, kHeight};
    test::Image m_specular{rhi::Format::R8_UNORM, kWidth, kHeight};
    nrd::NrdIntegration m_integration;
    nrd::CommonSettings m_common;
};
} // namespace confidence
