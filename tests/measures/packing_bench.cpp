#include "packing_bench.h"
#include "catch.h"

#include "replay_camera.h"
#include "shaders/replay_modes.h"

#include "engine/commands.h"
#include "engine/transfer.h"

#include <nrd/integration.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace sample::test
{
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3 normalized(const Vec3& v)
{
    const double length = std::sqrt(dot(v, v));
    return {v[0] / length, v[1] / length, v[2] / length};
}

double luma(const Vec3& rgb) { return 0.25 * rgb[0] + 0.5 * rgb[1] + 0.25 * rgb[2]; }

Vec3 pixelOf(const Planes& planes, Channel first, size_t i)
{
    return {planes[first][i], planes[next(first, 1)][i], planes[next(first, 2)][i]};
}

CaptureInfo makeInfo(double signOfZ)
{
    CaptureInfo info;
    info.width = kWidth;
    info.height = kHeight;
    info.metersPerUnit = 0.5;
    CaptureFrame frame;
    frame.jitter = {0.25, -0.375};
    frame.viewToClip = {1.2, 0, 0, 0, 0, 1.9, 0, 0, 0.1 * signOfZ, -0.05 * signOfZ, signOfZ, signOfZ, 0, 0, -0.01, 0};
    const double c = std::cos(0.6), s = std::sin(0.6);
    frame.worldToView = {c, 0.0, -s, 0.0, 0.0, 1.0, 0.0, 0.0, s, 0.0, c, 0.0, 2.0, -1.0, 5.0, 1.0};
    info.frames.push_back(frame);
    return info;
}

namespace
{
void setPixel(Planes& planes, Channel first, size_t i, const Vec3& value)
{
    for (int c = 0; c < 3; c++)
    {
        std::vector<float>& plane = planes[next(first, c)];
        plane.resize(planes.pixelCount());
        plane[i] = static_cast<float>(value[static_cast<size_t>(c)]);
    }
}

// Misses, surfaces that face away, and hits through glass.
void addShadow(Planes& frame)
{
    std::mt19937 rng(8);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    frame[Channel::ShadowDist].resize(frame.pixelCount());
    for (size_t i = 0; i < frame.pixelCount(); i++)
    {
        const double distance = i % 3 == 0 ? kHitDistMiss : (i % 7 == 0 ? 0.0 : 0.1 + 3.0 * uniform(rng));
        frame[Channel::ShadowDist][i] = static_cast<float>(distance);
        setPixel(frame, Channel::ShadowR, i, {uniform(rng), uniform(rng), uniform(rng)});
    }
}

Planes makeFrame(double signOfZ)
{
    std::mt19937 rng(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(0.05, 1.0);
    Planes frame(kWidth, kHeight);
    const auto values = [&](Channel channel) -> std::vector<float>&
    {
        frame[channel].resize(frame.pixelCount());
        return frame[channel];
    };
    for (size_t i = 0; i < frame.pixelCount(); i++)
    {
        values(Channel::ViewZ)[i] = static_cast<float>(signOfZ * (1.0 + 20.0 * uniform(rng)));
        values(Channel::Roughness)[i] = static_cast<float>(0.2 + 0.8 * uniform(rng));
        setPixel(frame, Channel::NormalX, i, normalized({normal(rng), normal(rng), normal(rng)}));
        for (Channel lobe : {Channel::DiffuseR, Channel::SpecularR})
        {
            const bool isDiffuse = lobe == Channel::DiffuseR;
            setPixel(frame, lobe, i, {4.0 * uniform(rng), uniform(rng), 2.0 * uniform(rng)});
            const double distance = i % 5 == 0 ? (i % 2 ? 0.0 : kHitDistMiss) : 6.0 * uniform(rng);
            values(isDiffuse ? Channel::DiffuseHitDist : Channel::SpecularHitDist)[i] = static_cast<float>(distance);
            setPixel(frame, isDiffuse ? Channel::DiffuseDX : Channel::SpecularDX, i,
                     normalized({normal(rng), normal(rng), normal(rng)}));
        }
    }
    addShadow(frame);
    return frame;
}

CaptureInfo withLight(CaptureInfo info, const std::optional<CaptureLight>& light)
{
    info.light = light;
    return info;
}

engine::DeviceDesc deviceDesc()
{
    engine::DeviceDesc desc;
    if (const char* name = std::getenv("NRD_TEST_DEVICE")) desc.device = name;
    desc.validation = std::getenv("NRD_TEST_NO_VALIDATION") == nullptr;
    desc.features = nrd::GetRequiredDeviceFeatures().features;
    return desc;
}
} // namespace

PackingBench::PackingBench(double signOfZ, const std::optional<CaptureLight>& light)
    : info(withLight(makeInfo(signOfZ), light)), frame(makeFrame(signOfZ)), m_device(deviceDesc()), m_packing(m_device)
{
    for (size_t l = 0; l < kLayerCount; l++)
    {
        m_layers.push_back(makeImage("layer", VK_FORMAT_R32G32B32A32_SFLOAT));
        const std::vector<float> values = layerValues(frame, static_cast<Layer>(l));
        engine::upload(m_device, m_layers.back(), std::as_bytes(std::span<const float>(values)));
    }
}

engine::Image PackingBench::makeImage(const char* name, VkFormat format)
{
    return {m_device, {name, kWidth, kHeight, format}};
}

engine::Image& PackingBench::layer(Layer which) { return m_layers[static_cast<size_t>(which)]; }

engine::Image PackingBench::pack(nrd::ResourceType type, Family family)
{
    const SlotRow& row = *findSlot(type, family);
    engine::Image slot = makeImage("slot", row.format);
    engine::Image& source = m_layers[static_cast<size_t>(row.layer.value_or(Layer::Guides))];
    engine::Image& direction = row.direction ? m_layers[static_cast<size_t>(*row.direction)] : source;
    const VkDescriptorSet set = m_packing.createSet(
        ReplayPacking::PackImages{source, direction, layer(Layer::Guides), layer(Layer::Depth), slot});
    const nrd::HitDistanceParameters p = hitDistanceParametersOf(info);
    PackConstants constants{
        {p.A / static_cast<float>(info.metersPerUnit), p.B, p.C, 0}, row.mode, row.isDiffuse, {kWidth, kHeight}, 0.75f};
    setLight(constants, info, 0);
    engine::submitAndWait(m_device,
                          [&](VkCommandBuffer cmd)
                          {
                              engine::transition(cmd, slot, engine::kStorage);
                              m_packing.pack(cmd, set, constants);
                              engine::transition(cmd, slot, engine::kSampled);
                          });
    return slot;
}

std::vector<float> PackingBench::unpack(engine::Image& slot, engine::Image& sh1, uint32_t mode, bool isDiffuse)
{
    engine::Image values = makeImage("values", VK_FORMAT_R32G32B32A32_SFLOAT);
    const VkDescriptorSet set =
        m_packing.createSet(ReplayPacking::UnpackImages{slot, sh1, layer(Layer::Guides), layer(Layer::Depth), values});
    UnpackConstants constants = unpackConstantsOf(info, 0);
    constants.mode = mode;
    constants.isDiffuse = isDiffuse;
    engine::submitAndWait(m_device,
                          [&](VkCommandBuffer cmd)
                          {
                              engine::transition(cmd, values, engine::kStorage);
                              m_packing.unpack(cmd, set, constants);
                          });
    std::vector<float> result = engine::readBackAs<float>(m_device, values);
    CHECK(m_device.validationMessageCount() == 0);
    return result;
}

std::vector<float> PackingBench::copy(nrd::ResourceType type, Family family)
{
    engine::Image slot = pack(type, family);
    return unpack(slot, slot, REPLAY_UNPACK_COPY, false);
}
} // namespace sample::test
