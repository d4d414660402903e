#include "denoiser_choice.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace sample
{
namespace
{
// From here on a dielectric's reflection is as wide as its diffuse lobe, and holds about a twentieth of the light.
constexpr float kRough = 0.9f;
constexpr float kMetal = 0.05f; // below it no one means a metal

// Least and largest value of a texture's channel, in [0; 1]; 1 without a texture.
std::pair<float, float> rangeOf(const Scene& scene, const TextureUse& use, size_t channel)
{
    if (use.texture == kNone) return {1.0f, 1.0f};
    const std::vector<uint8_t>& rgba = scene.textures[size_t(use.texture)].rgba;
    uint8_t low = 255, high = 0;
    for (size_t i = channel; i < rgba.size(); i += 4)
    {
        low = std::min(low, rgba[i]);
        high = std::max(high, rgba[i]);
    }
    return {float(low) / 255.0f, float(high) / 255.0f};
}

std::set<int> usedMaterials(const Scene& scene)
{
    std::set<int> used;
    for (const Node& node : scene.nodes)
        if (node.mesh != kNone)
            for (const Primitive& primitive : scene.meshes[size_t(node.mesh)].primitives)
                used.insert(primitive.material);
    return used;
}

const SampleDenoiser* find(std::span<const SampleDenoiser> offered, nrd::Denoiser denoiser)
{
    const auto found = std::find_if(offered.begin(), offered.end(),
                                    [&](const SampleDenoiser& row) { return row.denoiser == denoiser; });
    return found == offered.end() ? nullptr : &*found;
}

std::string text(float x)
{
    char digits[16];
    std::snprintf(digits, sizeof(digits), "%.2g", double(x));
    return digits;
}

const char* reasonForBoth(const SceneFacts& facts, bool isRough)
{
    if (isRough) return "every surface is rough, but the lobes are asked for apart";
    return facts.largestMetallic > kMetal ? "there are metals" : nullptr;
}

void chooseForLobes(const SceneFacts& facts, std::span<const SampleDenoiser> offered, DenoiserChoice& choice)
{
    const bool isRough = facts.leastRoughness >= kRough && facts.largestMetallic <= kMetal;
    const bool isMerged = facts.lobes ? *facts.lobes == Lobes::Merged : isRough;
    choice.lobes = isMerged ? Lobes::Merged : facts.lobes.value_or(Lobes::Both);
    const auto wanted = isMerged ? nrd::Denoiser::REBLUR_DIFFUSE : nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR;
    choice.set.lobes = find(offered, wanted);
    std::string reason;
    if (!choice.set.lobes)
        reason = "the library does not have it, so the lobes stay noisy";
    else if (isMerged)
        reason = facts.lobes ? "the lobes are asked for as one signal"
                             : "no surface is metal or smoother than " + text(kRough) + " (the least roughness is " +
                                   text(facts.leastRoughness) + "), so one signal holds both lobes";
    else if (const char* known = reasonForBoth(facts, isRough))
        reason = known;
    else
        reason = "the least roughness is " + text(facts.leastRoughness) + ", below " + text(kRough);
    choice.reasons.push_back((choice.set.lobes ? "" : "no ") + std::string(nrd::toString(wanted)) + ": " + reason);
    if (!choice.set.lobes) choice.set.lobes = find(offered, nrd::Denoiser::MAX_NUM);
}

void chooseForShadow(const SceneFacts& facts, std::span<const SampleDenoiser> offered, DenoiserChoice& choice)
{
    if (!facts.hasSun)
    {
        choice.reasons.emplace_back("no SIGMA: there is neither a sun nor a spot light");
        return;
    }
    const auto wanted = facts.hasBlended ? nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY : nrd::Denoiser::SIGMA_SHADOW;
    choice.set.shadow = find(offered, wanted);
    std::string reason = "there is a sun or a spot light";
    if (facts.hasBlended) reason += ", and surfaces that let its light through";
    if (!choice.set.shadow) reason = "the library does not have it, so the sun's light stays in the lobes";
    choice.reasons.push_back((choice.set.shadow ? "" : "no ") + std::string(nrd::toString(wanted)) + ": " + reason);
}
} // namespace

SceneFacts factsOf(const Scene& scene)
{
    SceneFacts facts;
    for (int index : usedMaterials(scene))
    {
        const Material& material = scene.materials[size_t(index)];
        const TextureUse& use = material.metallicRoughnessTexture;
        facts.leastRoughness = std::min(facts.leastRoughness, material.roughness * rangeOf(scene, use, 1).first);
        facts.largestMetallic = std::max(facts.largestMetallic, material.metallic * rangeOf(scene, use, 2).second);
        facts.hasBlended |= material.isBlended || material.isGlass;
    }
    facts.hasSun = hasShadowLight(scene);
    return facts;
}

DenoiserChoice chooseDenoisers(const SceneFacts& facts, std::span<const SampleDenoiser> offered)
{
    DenoiserChoice choice;
    chooseForLobes(facts, offered, choice);
    chooseForShadow(facts, offered, choice);
    return choice;
}
} // namespace sample
