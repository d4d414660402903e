// Variants are rows: lobes and signals that no shader exists for yet expand from the same tables.
#include "denoisers/families.h"
#include "expand.h"
#include "fixture.h"
#include <algorithm>

using namespace test;

namespace
{
constexpr SignalRow kDiffuseSignal = {ResourceType::IN_DIFF_RADIANCE_HITDIST, ResourceType::OUT_DIFF_RADIANCE_HITDIST,
                                      Format::RGBA16_SFLOAT, kDiffuse};
constexpr SignalRow kDiffuseSh0 = {ResourceType::IN_DIFF_SH0, ResourceType::OUT_DIFF_SH0, Format::RGBA16_SFLOAT,
                                   kDiffuse};
constexpr SignalRow kDiffuseSh1 = {ResourceType::IN_DIFF_SH1, ResourceType::OUT_DIFF_SH1, Format::RGBA16_SFLOAT,
                                   kDiffuse};
constexpr SignalRow kSpecularOcclusion = {ResourceType::IN_SPEC_HITDIST, ResourceType::OUT_SPEC_HITDIST,
                                          Format::R16_SFLOAT, kSpecular};

constexpr Variant kRows[] = {
    {Denoiser::REBLUR_DIFFUSE, kDiffuse, {kDiffuseSignal}},
    {Denoiser::REBLUR_DIFFUSE_SH, kDiffuse, {kDiffuseSh0, kDiffuseSh1}},
    {Denoiser::REBLUR_SPECULAR_OCCLUSION, kSpecular, {kSpecularOcclusion}},
};

Program expandRow(size_t row)
{
    static const Family family = []
    {
        Family copy = kReblur;
        copy.variants = kRows;
        return copy;
    }();
    return expand({&family, row}, NormalEncoding::R10_G10_B10_A2_UNORM);
}

std::vector<Format> formatsOf(const Program& program, const std::string& name)
{
    std::vector<Format> formats;
    for (const Texture& texture : program.textures)
    {
        if (name == texture.row->name) formats.push_back(texture.format);
    }
    return formats;
}

template <class Slots> size_t count(const Slots& slots, ResourceType type)
{
    const auto isType = [type](const BoundSlot& slot) { return slot.binding.type == type; };
    return static_cast<size_t>(std::count_if(slots.begin(), slots.end(), isType));
}

const Pass& passOf(const Program& program, const std::string& name)
{
    const auto isNamed = [&](const Pass& pass) { return name == pass.row->name; };
    const Pass* found = std::find_if(program.passes.begin(), program.passes.end(), isNamed);
    REQUIRE(found != program.passes.end());
    return *found;
}

using Formats = std::vector<Format>;
} // namespace

TEST_CASE("a variant without a lobe has none of that lobe's textures and inputs", "[unit]")
{
    const Program diffuse = expandRow(0);
    CHECK(formatsOf(diffuse, "Track").empty());
    CHECK(formatsOf(diffuse, "TrackNew").empty());
    CHECK(formatsOf(diffuse, "FastTemp") == Formats{Format::R16_SFLOAT});
    CHECK(formatsOf(diffuse, "PrevLength") == Formats{Format::R8_UINT});
    CHECK(formatsOf(diffuse, "History") == Formats{Format::RGBA16_SFLOAT});
    const Pass& accumulation = passOf(diffuse, "Temporal accumulation");
    CHECK(count(accumulation.reads, ResourceType::IN_DIFF_CONFIDENCE) == 1);
    CHECK(count(accumulation.reads, ResourceType::IN_SPEC_CONFIDENCE) == 0);

    const Program specular = expandRow(2);
    CHECK(formatsOf(specular, "Track") == Formats{Format::R16_SFLOAT});
    CHECK(formatsOf(specular, "History") == Formats{Format::R16_SFLOAT}); // its signal is a scalar
    CHECK(count(passOf(specular, "Temporal accumulation").reads, ResourceType::IN_DIFF_CONFIDENCE) == 0);
    CHECK(count(passOf(specular, "Split screen").writes, ResourceType::OUT_SPEC_HITDIST) == 1);
}

TEST_CASE("a lobe with two signals has two of everything that exists per signal", "[unit]")
{
    const Program sh = expandRow(1);
    CHECK(formatsOf(sh, "History").size() == 2);
    CHECK(formatsOf(sh, "Scratch").size() == 2);
    CHECK(formatsOf(sh, "FastTemp") == Formats{Format::R16_SFLOAT}); // still one lobe
    const Pass& prePass = passOf(sh, "Pre-pass");
    CHECK(count(prePass.reads, ResourceType::IN_DIFF_SH0) == 1);
    CHECK(count(prePass.reads, ResourceType::IN_DIFF_SH1) == 1);
    CHECK(prePass.writes.size() == 2);
    CHECK(prePass.writes[0].binding.texture != prePass.writes[1].binding.texture);
}
