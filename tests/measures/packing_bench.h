// A frame of random values, and a bench that packs its slots and reads them back without a denoiser in between.
#pragma once
#include "replay_packing.h"
#include "replay_slots.h"

#include <array>
#include <optional>

namespace sample::test
{
inline constexpr int kWidth = 24;
inline constexpr int kHeight = 16;
inline constexpr double kHalfError = 1.0 / 1024.0; // of a rounded component, relative

using Vec3 = std::array<double, 3>;

double dot(const Vec3& a, const Vec3& b);
Vec3 normalized(const Vec3& v);
double luma(const Vec3& rgb);
Vec3 pixelOf(const Planes& planes, Channel first, size_t i);

// A camera that looks along a turned axis from away of the origin, with an off-centre frustum and jitter.
CaptureInfo makeInfo(double signOfZ);

class PackingBench
{
public:
    explicit PackingBench(double signOfZ, const std::optional<CaptureLight>& light = {});

    engine::Image pack(nrd::ResourceType type, Family family = Family::Reblur);

    // Four floats per pixel.
    std::vector<float> unpack(engine::Image& slot, engine::Image& sh1, uint32_t mode, bool isDiffuse);

    // What the slot was packed with.
    std::vector<float> copy(nrd::ResourceType type, Family family = Family::Reblur);

    const CaptureInfo info;
    const Planes frame;

private:
    engine::Image makeImage(const char* name, VkFormat format);
    engine::Image& layer(Layer which);

    engine::Device m_device;
    ReplayPacking m_packing;
    std::vector<engine::Image> m_layers;
};

// The slots and channels of a lobe with its direction.
struct ShLobe
{
    bool isDiffuse;
    nrd::ResourceType sh0, sh1;
    Channel radiance, direction;
};
inline constexpr ShLobe kShLobes[] = {
    {true, nrd::ResourceType::IN_DIFF_SH0, nrd::ResourceType::IN_DIFF_SH1, Channel::DiffuseR, Channel::DiffuseDX},
    {false, nrd::ResourceType::IN_SPEC_SH0, nrd::ResourceType::IN_SPEC_SH1, Channel::SpecularR, Channel::SpecularDX},
};
} // namespace sample::test
