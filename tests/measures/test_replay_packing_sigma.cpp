// What the replay tool puts into SIGMA's slots for a sun and for a lamp, and what it makes of the output.
#include "catch.h"
#include "packing_bench.h"

#include "replay_camera.h"
#include "shaders/replay_modes.h"

#include <cmath>

using namespace sample;
using namespace sample::test;
using nrd::ResourceType;

namespace
{
constexpr double kLit = 65504.0;

CaptureLight makeSun()
{
    CaptureLight light;
    light.direction = normalized({0.3, 0.8, -0.2});
    light.tanAngularRadius = 0.0625;
    return light;
}

CaptureLight makeLamp()
{
    CaptureLight light;
    light.isLocal = true;
    light.position = {2.0, 9.0, 4.0};
    light.radius = 0.5;
    return light;
}

// World space, of the pixel's middle.
Vec3 positionOf(const PackingBench& bench, size_t pixel)
{
    const CaptureFrame& frame = bench.info.frames[0];
    const std::array<double, 4> f = frustumOf(frame.viewToClip);
    const double z = double(bench.frame[Channel::ViewZ][pixel]);
    const double u = (double(pixel % kWidth) + 0.5) / kWidth, v = (double(pixel / kWidth) + 0.5) / kHeight;
    const Vec3 view = {(f[0] + u * f[2]) * z, (f[1] + v * f[3]) * z, z};
    Vec3 world = cameraPositionOf(frame.worldToView);
    for (size_t i = 0; i < 3; i++)
        for (size_t row = 0; row < 3; row++) world[i] += frame.worldToView[i * 4 + row] * view[row];
    return world;
}

double penumbraOf(const PackingBench& bench, size_t pixel)
{
    const double distance = double(bench.frame[Channel::ShadowDist][pixel]);
    if (distance >= kLit || distance == 0.0) return distance == 0.0 ? 0.0 : kLit;
    const CaptureLight& light = *bench.info.light;
    if (!light.isLocal) return distance * light.tanAngularRadius;
    const Vec3 X = positionOf(bench, pixel);
    const double toLight = std::hypot(X[0] - light.position[0], X[1] - light.position[1], X[2] - light.position[2]);
    return light.radius * distance / (toLight - distance);
}
} // namespace

TEST_CASE("IN_PENUMBRA holds half of the penumbra's width in world units, of a sun and of a lamp", "[gpu]")
{
    for (const double sign : {1.0, -1.0})
    {
        for (const CaptureLight& light : {makeSun(), makeLamp()})
        {
            PackingBench bench(sign, light);
            const std::vector<float> values = bench.copy(ResourceType::IN_PENUMBRA, Family::Sigma);
            size_t hitCount = 0;
            for (size_t i = 0; i < bench.frame.pixelCount(); i++)
            {
                const double expected = penumbraOf(bench, i);
                hitCount += expected > 0.0 && expected < kLit;
                INFO("pixel " << i << ", lamp " << light.isLocal);
                CHECK(double(values[i * 4]) == Approx(expected).epsilon(kHalfError));
            }
            CHECK(hitCount > 100);
        }
    }
}

TEST_CASE("IN_TRANSLUCENCY holds whether something was hit, and what came through", "[gpu]")
{
    PackingBench bench(1.0, makeSun());
    const std::vector<float> values = bench.copy(ResourceType::IN_TRANSLUCENCY, Family::Sigma);
    for (size_t i = 0; i < bench.frame.pixelCount(); i++)
    {
        const bool isLit = double(bench.frame[Channel::ShadowDist][i]) >= kLit;
        const Vec3 color = pixelOf(bench.frame, Channel::ShadowR, i);
        CHECK(values[i * 4] == (isLit ? 1.0f : 0.0f));
        for (size_t c = 0; c < 3; c++)
            CHECK(double(values[i * 4 + 1 + c]) == Approx(isLit ? 1.0 : color[c]).margin(0.51 / 255.0));
    }
}

TEST_CASE("a shadow is read as colour and visibility, squared", "[gpu]")
{
    PackingBench bench(1.0, makeSun());
    engine::Image slot = bench.pack(ResourceType::IN_TRANSLUCENCY, Family::Sigma);
    const std::vector<float> stored = bench.unpack(slot, slot, REPLAY_UNPACK_COPY, false);
    const std::vector<float> values = bench.unpack(slot, slot, REPLAY_UNPACK_SIGMA, false);
    for (size_t i = 0; i < bench.frame.pixelCount(); i++)
        for (size_t c = 0; c < 4; c++)
            CHECK(values[i * 4 + c] == Approx(std::pow(stored[i * 4 + (c + 1) % 4], 2.0f)).margin(1e-6));
}

TEST_CASE("SIGMA is told where the light is", "[unit]")
{
    const nrd::SigmaSettings none = sigmaSettingsOf(nullptr);
    CHECK((!none.isLightLocal && none.lightDirection[1] == 0.0f));
    const CaptureLight sun = makeSun(), lamp = makeLamp();
    const nrd::SigmaSettings ofSun = sigmaSettingsOf(&sun), ofLamp = sigmaSettingsOf(&lamp);
    CHECK((!ofSun.isLightLocal && ofLamp.isLightLocal));
    for (size_t i = 0; i < 3; i++)
    {
        CHECK(double(ofSun.lightDirection[i]) == Approx(sun.direction[i]));
        CHECK(double(ofLamp.lightPosition[i]) == lamp.position[i]);
    }
}
