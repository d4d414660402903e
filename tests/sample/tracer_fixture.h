// Traces small scenes on the device, validation on, and reads everything back.
#pragma once
#include "path_tracer.h"
#include "scene_shapes.h"

#include <functional>

namespace test
{
/// One device for all tests of the program; validation messages are counted.
engine::Device& device();

/// A signal as four floats per pixel.
using Pixels = std::vector<glm::vec4>;

struct TraceRequest
{
    sample::TracerDesc desc;
    sample::View view;
    uint32_t samples = 64;   // of the reference, 0: none
    uint32_t plain = 0;      // plain paths
    double time = 0.0;       // seconds
    double previousTime = 0; // of the pose before
};

struct Traced
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> viewZ;
    Pixels normalRoughness, motion, diffuse, specular, diffuseFactor, specularFactor, direct;
    Pixels specularDirection, specularMotion;
    Pixels shadow, sun;               // empty without the shadow signal
    Pixels diffuseMean, specularMean; // expectation by many samples, .w normalised hit distance
    Pixels shadowMean;                // .w: share of the light that is visible
    Pixels plainMean;

    /// direct plus all means times their factors.
    glm::vec3 composed(size_t pixel) const;
    size_t center() const { return (height / 2) * width + width / 2; }
};

Traced trace(const sample::Scene& scene, const sample::Environment* environment, const TraceRequest& request);

/// Mean over pixels for which `isWanted(pixel)`; fails the test when there are none.
glm::vec3 meanOf(size_t pixelCount, const std::function<bool(size_t)>& isWanted,
                 const std::function<glm::vec3(size_t)>& value);

/// A square of side 2 * `half` at height 0 facing up.
sample::Primitive makeFloor(float half, int material);
using sample::makeSphere;
sample::Scene makeScene(std::vector<sample::Primitive> primitives, std::vector<sample::Material> materials);
sample::Material makeMaterial(const glm::vec3& color, float metallic, float roughness);
} // namespace test
