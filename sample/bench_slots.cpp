#include "bench_slots.h"

#include "engine/error.h"

namespace sample::bench
{
namespace
{
using nrd::ResourceType;

constexpr VkFormat kRgba8 = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat kRgba16 = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kRgba16Snorm = VK_FORMAT_R16G16B16A16_SNORM;
constexpr VkFormat kRgba32 = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kR16 = VK_FORMAT_R16_SFLOAT;
constexpr VkFormat kR32 = VK_FORMAT_R32_SFLOAT;
constexpr VkFormat kA2B10G10R10 = VK_FORMAT_A2B10G10R10_UNORM_PACK32;

constexpr Family kAny = Family::None, kReblur = Family::Reblur, kRelax = Family::Relax, kSigma = Family::Sigma;
constexpr bool kIn = false, kOut = true;

// clang-format off
constexpr BenchSlot kSlots[] = {
    // type, family, format, content, of the specular lobe, direction
    {ResourceType::IN_MV,                      kAny,              kRgba16,      BENCH_MOTION,           false, kIn},
    {ResourceType::IN_NORMAL_ROUGHNESS,        kAny,              kA2B10G10R10, BENCH_NORMAL_ROUGHNESS, false, kIn},
    {ResourceType::IN_VIEWZ,                   kAny,              kR32,         BENCH_VIEWZ,            false, kIn},
    {ResourceType::IN_SIGNAL,                  Family::Reference, kRgba32,      BENCH_SIGNAL,           false, kIn},
    {ResourceType::IN_DIFF_RADIANCE_HITDIST,   kReblur,           kRgba16,      BENCH_RADIANCE,         false, kIn},
    {ResourceType::IN_SPEC_RADIANCE_HITDIST,   kReblur,           kRgba16,      BENCH_RADIANCE,         true,  kIn},
    {ResourceType::IN_DIFF_HITDIST,            kReblur,           kR16,         BENCH_HITDIST,          false, kIn},
    {ResourceType::IN_SPEC_HITDIST,            kReblur,           kR16,         BENCH_HITDIST,          true,  kIn},
    {ResourceType::IN_DIFF_DIRECTION_HITDIST,  kReblur,           kRgba16Snorm, BENCH_DIRECTION,        false, kIn},
    {ResourceType::IN_DIFF_SH0,                kReblur,           kRgba16,      BENCH_RADIANCE,         false, kIn},
    {ResourceType::IN_DIFF_SH1,                kReblur,           kRgba16,      BENCH_SH1,              false, kIn},
    {ResourceType::IN_SPEC_SH0,                kReblur,           kRgba16,      BENCH_RADIANCE,         true,  kIn},
    {ResourceType::IN_SPEC_SH1,                kReblur,           kRgba16,      BENCH_SH1,              true,  kIn},
    {ResourceType::IN_DIFF_RADIANCE_HITDIST,   kRelax,            kRgba16,      BENCH_RELAX,            false, kIn},
    {ResourceType::IN_SPEC_RADIANCE_HITDIST,   kRelax,            kRgba16,      BENCH_RELAX,            true,  kIn},
    {ResourceType::IN_DIFF_SH0,                kRelax,            kRgba16,      BENCH_RELAX,            false, kIn},
    {ResourceType::IN_DIFF_SH1,                kRelax,            kRgba16,      BENCH_SH1,              false, kIn},
    {ResourceType::IN_SPEC_SH0,                kRelax,            kRgba16,      BENCH_RELAX,            true,  kIn},
    {ResourceType::IN_SPEC_SH1,                kRelax,            kRgba16,      BENCH_SH1,              true,  kIn},
    {ResourceType::IN_PENUMBRA,                kSigma,            kR16,         BENCH_PENUMBRA,         false, kIn},
    {ResourceType::IN_TRANSLUCENCY,            kSigma,            kRgba8,       BENCH_TRANSLUCENCY,     false, kIn},
    {ResourceType::OUT_SHADOW_TRANSLUCENCY,    kSigma,            kRgba8,       0,                      false, kOut},
    {ResourceType::OUT_SIGNAL,                 Family::Reference, kRgba32,      0,                      false, kOut},
    {ResourceType::OUT_DIFF_RADIANCE_HITDIST,  kReblur,           kRgba16,      0,                      false, kOut},
    {ResourceType::OUT_SPEC_RADIANCE_HITDIST,  kReblur,           kRgba16,      0,                      true,  kOut},
    {ResourceType::OUT_DIFF_HITDIST,           kReblur,           kR16,         0,                      false, kOut},
    {ResourceType::OUT_SPEC_HITDIST,           kReblur,           kR16,         0,                      true,  kOut},
    {ResourceType::OUT_DIFF_DIRECTION_HITDIST, kReblur,           kRgba16Snorm, 0,                      false, kOut},
    {ResourceType::OUT_DIFF_SH0,               kReblur,           kRgba16,      0,                      false, kOut},
    {ResourceType::OUT_DIFF_SH1,               kReblur,           kRgba16,      0,                      false, kOut},
    {ResourceType::OUT_SPEC_SH0,               kReblur,           kRgba16,      0,                      true,  kOut},
    {ResourceType::OUT_SPEC_SH1,               kReblur,           kRgba16,      0,                      true,  kOut},
    {ResourceType::OUT_DIFF_RADIANCE_HITDIST,  kRelax,            kRgba16,      0,                      false, kOut},
    {ResourceType::OUT_SPEC_RADIANCE_HITDIST,  kRelax,            kRgba16,      0,                      true,  kOut},
    {ResourceType::OUT_DIFF_SH0,               kRelax,            kRgba16,      0,                      false, kOut},
    {ResourceType::OUT_DIFF_SH1,               kRelax,            kRgba16,      0,                      false, kOut},
    {ResourceType::OUT_SPEC_SH0,               kRelax,            kRgba16,      0,                      true,  kOut},
    {ResourceType::OUT_SPEC_SH1,               kRelax,            kRgba16,      0,                      true,  kOut},
};
// clang-format on

} // namespace

const BenchSlot* findBenchSlot(ResourceType type, Family family)
{
    for (const BenchSlot& slot : kSlots)
        if (slot.type == type && (slot.family == kAny || slot.family == family)) return &slot;
    return nullptr;
}

std::vector<BenchSlot> requiredSlots(const nrd::Instance& instance, nrd::Identifier identifier,
                                     const ReplayDenoiser& denoiser)
{
    const nrd::ResourceRequirement* requirements = nullptr;
    uint32_t count = 0;
    if (nrd::GetRequiredResources(instance, identifier, requirements, count) != nrd::Result::SUCCESS)
        throw engine::Error(std::string("the library does not tell what ") + denoiser.name + " needs");
    std::vector<BenchSlot> slots;
    for (uint32_t i = 0; i < count; i++)
    {
        if (!requirements[i].isRequired) continue;
        const BenchSlot* slot = findBenchSlot(requirements[i].type, denoiser.family);
        if (!slot)
            throw engine::Error(std::string("nrd-bench cannot generate ") + nrd::toString(requirements[i].type) +
                                ", which " + denoiser.name + " needs under these settings");
        slots.push_back(*slot);
        slots.back().divisor = requirements[i].sizeDivisor;
        // Of a shadow without colour one channel.
        if (requirements[i].minFormat == nrd::Format::R8_UNORM && slot->format == kRgba8)
            slots.back().format = VK_FORMAT_R8_UNORM;
    }
    return slots;
}
} // namespace sample::bench
