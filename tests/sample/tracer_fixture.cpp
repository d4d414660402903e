#include "tracer_fixture.h"

#include "catch.h"
#include "engine/commands.h"
#include "engine/transfer.h"

#include <cmath>

using namespace sample;

namespace test
{
namespace
{
constexpr uint32_t kBatch = 16; // llvmpipe gives all loops of an invocation 65536 turns together, then leaves them

Pixels readPixels(engine::Image& image) { return engine::readBackAs<glm::vec4>(device(), image); }

Pixels meanOfSums(engine::Image& sums, uint32_t samples)
{
    Pixels pixels = readPixels(sums);
    for (glm::vec4& p : pixels) p /= float(samples);
    return pixels;
}

template <class F> void inBatches(uint32_t samples, F record)
{
    for (uint32_t first = 0; first < samples; first += kBatch)
        engine::submitAndWait(device(),
                              [&](VkCommandBuffer cmd) {
                                  record(cmd, ReferenceBatch{first, std::min(kBatch, samples - first)});
                              });
}
} // namespace

engine::Device& device()
{
    static engine::Device instance(
        []
        {
            engine::DeviceDesc desc;
            desc.validation = true;
            return desc;
        }());
    return instance;
}

glm::vec3 Traced::composed(size_t pixel) const
{
    const glm::vec4 light = sun.empty() ? glm::vec4(0.0f) : sun[pixel] * shadowMean[pixel];
    return glm::vec3(direct[pixel] + light + diffuseMean[pixel] * diffuseFactor[pixel] +
                     specularMean[pixel] * specularFactor[pixel]);
}

Traced trace(const Scene& scene, const Environment* environment, const TraceRequest& request)
{
    ScenePose pose(scene);
    pose.update(request.previousTime);
    pose.update(request.time);
    PathTracer tracer(device(), scene, environment, request.desc);
    tracer.setPose(scene, pose, environment);
    engine::submitAndWait(device(), [&](VkCommandBuffer cmd) { tracer.recordFrame(cmd, request.view); });
    FrameImages& images = tracer.images();
    Traced out;
    out.width = request.desc.width;
    out.height = request.desc.height;
    out.viewZ = engine::readBackAs<float>(device(), images.viewZ);
    out.normalRoughness = readPixels(images.normalRoughness);
    out.motion = readPixels(images.motion);
    out.diffuse = readPixels(images.diffuse);
    out.specular = readPixels(images.specular);
    out.diffuseFactor = readPixels(images.diffuseFactor);
    out.specularFactor = readPixels(images.specularFactor);
    out.direct = readPixels(images.direct);
    out.specularDirection = readPixels(images.specularDirection);
    out.specularMotion = readPixels(images.specularMotion);
    if (request.desc.hasShadowSignal) out.shadow = readPixels(images.shadow);
    if (request.desc.hasShadowSignal) out.sun = readPixels(images.sun);
    inBatches(request.samples, [&](VkCommandBuffer cmd, const ReferenceBatch& batch)
              { tracer.recordReference(cmd, request.view, batch); });
    if (request.samples > 0)
    {
        out.diffuseMean = meanOfSums(tracer.sumDiffuse(), request.samples);
        out.specularMean = meanOfSums(tracer.sumSpecular(), request.samples);
        if (request.desc.hasShadowSignal) out.shadowMean = meanOfSums(tracer.sumShadow(), request.samples);
    }
    inBatches(request.plain,
              [&](VkCommandBuffer cmd, const ReferenceBatch& batch) { tracer.recordPlain(cmd, request.view, batch); });
    if (request.plain > 0) out.plainMean = meanOfSums(tracer.sumDiffuse(), request.plain);
    CHECK(device().validationMessageCount() == 0);
    return out;
}

glm::vec3 meanOf(size_t pixelCount, const std::function<bool(size_t)>& isWanted,
                 const std::function<glm::vec3(size_t)>& value)
{
    glm::dvec3 sum(0.0);
    size_t count = 0;
    for (size_t i = 0; i < pixelCount; ++i)
    {
        if (!isWanted(i)) continue;
        sum += glm::dvec3(value(i));
        ++count;
    }
    REQUIRE(count > 0);
    return glm::vec3(sum / double(count));
}

Primitive makeFloor(float half, int material)
{
    Primitive p;
    p.material = material;
    p.positions = {{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}};
    p.normals.assign(4, glm::vec3(0, 1, 0));
    p.indices = {0, 1, 2, 0, 2, 3};
    return p;
}

Scene makeScene(std::vector<Primitive> primitives, std::vector<Material> materials)
{
    Scene scene;
    scene.materials = std::move(materials);
    scene.meshes.push_back({std::move(primitives), {}});
    scene.nodes.emplace_back();
    scene.nodes[0].mesh = 0;
    return scene;
}

Material makeMaterial(const glm::vec3& color, float metallic, float roughness)
{
    Material m;
    m.baseColor = glm::vec4(color, 1.0f);
    m.metallic = metallic;
    m.roughness = roughness;
    return m;
}
} // namespace test
