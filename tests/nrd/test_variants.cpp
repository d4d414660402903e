// Variants are rows: all of them expand from the same tables.
#include "denoisers/families.h"
#include "expand.h"
#include "fixture.h"
#include "nrd_shaders.h"
#include <algorithm>
#include <cctype>

using namespace test;

namespace
{
Program expandOf(Denoiser denoiser) { return expand(findVariant(denoiser), NormalEncoding::R10_G10_B10_A2_UNORM); }

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
    const auto isType = [type](const BoundSlot& slot) { return slot.choices[0].binding.type == type; };
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

std::string lower(std::string text)
{
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}
} // namespace

TEST_CASE("a variant without a lobe has none of that lobe's textures and inputs", "[unit]")
{
    const Program diffuse = expandOf(Denoiser::REBLUR_DIFFUSE);
    CHECK(formatsOf(diffuse, "Track").empty());
    CHECK(formatsOf(diffuse, "TrackNew").empty());
    CHECK(formatsOf(diffuse, "FastTemp") == Formats{Format::R16_SFLOAT});
    CHECK(formatsOf(diffuse, "PrevLength") == Formats{Format::R8_UINT});
    CHECK(formatsOf(diffuse, "History") == Formats{Format::RGBA16_SFLOAT});
    const Pass& accumulation = passOf(diffuse, "Temporal accumulation");
    CHECK(count(accumulation.reads, ResourceType::IN_DIFF_CONFIDENCE) == 1);
    CHECK(count(accumulation.reads, ResourceType::IN_SPEC_CONFIDENCE) == 0);
}

TEST_CASE("occlusion is a scalar per lobe, with nothing of what only radiance needs", "[unit]")
{
    const Program specular = expandOf(Denoiser::REBLUR_SPECULAR_OCCLUSION);
    CHECK(formatsOf(specular, "Track").empty()); // its history is a hit distance itself
    CHECK(formatsOf(specular, "TrackNew").empty());
    CHECK(formatsOf(specular, "Stab").empty());
    CHECK(formatsOf(specular, "Pair") == Formats{Format::R16_UNORM});
    CHECK(formatsOf(specular, "Fast") == Formats{Format::R8_UNORM});
    CHECK(count(passOf(specular, "Temporal accumulation").reads, ResourceType::IN_DIFF_CONFIDENCE) == 0);
    CHECK(count(passOf(specular, "Split screen").writes, ResourceType::OUT_SPEC_HITDIST) == 1);
    for (const Pass& pass : specular.passes) CHECK(std::string(pass.row->name) != "Temporal stabilization");
    CHECK(formatsOf(expandOf(Denoiser::REBLUR_DIFFUSE_SPECULAR_OCCLUSION), "Fast") == Formats{Format::RG8_UNORM});
}

TEST_CASE("a lobe with two signals has two of everything that exists per signal", "[unit]")
{
    const Program sh = expandOf(Denoiser::REBLUR_DIFFUSE_SH);
    CHECK(formatsOf(sh, "History") == Formats{Format::RGBA16_SFLOAT, Format::A2B10G10R10_UNORM_PACK32});
    CHECK(formatsOf(sh, "FastTemp") == Formats{Format::R16_SFLOAT}); // still one lobe
    const Pass& prePass = passOf(sh, "Pre-pass");
    CHECK(count(prePass.reads, ResourceType::IN_DIFF_SH0) == 1);
    CHECK(count(prePass.reads, ResourceType::IN_DIFF_SH1) == 1);
    CHECK(prePass.writes.size() == 2);
    CHECK(count(prePass.writes, ResourceType::OUT_DIFF_SH0) == 1);
    CHECK(prePass.writes[1].choices[0].binding.isTexture());
}

TEST_CASE("what is on its way lies in the output where that has room for it, else in a texture of its own", "[unit]")
{
    CHECK(formatsOf(expandOf(Denoiser::REBLUR_DIFFUSE_SPECULAR), "Work").empty());
    CHECK(formatsOf(expandOf(Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION), "Work").empty());
    CHECK(formatsOf(expandOf(Denoiser::RELAX_SPECULAR), "Pong").empty());
    // An axis is kept in another form than it is returned in.
    CHECK(formatsOf(expandOf(Denoiser::REBLUR_DIFFUSE_SH), "Work") == Formats{Format::A2B10G10R10_UNORM_PACK32});
}

// The shader list and the variant table have to be in the same order: the names tell.
TEST_CASE("every variant runs the permutations made for it", "[unit]")
{
    for (const Family* family : {&kReblur, &kRelax})
    {
        for (const Variant& variant : family->variants)
        {
            const std::string name = toString(variant.key); // "RELAX_DIFFUSE_SH"
            const size_t end = name.find('_');
            for (const Pass& pass : expandOf(variant.key).passes)
            {
                if (pass.row->shaders.size() == 1) continue;
                const std::string shader = shaderBlob(pass.shader).name;
                std::string words = name.substr(0, end) + pass.row->name + name.substr(end); // "RELAX" "Pre-pass" ...
                // The steps of the wavelet are one shader.
                std::erase_if(words, [](char c) { return c == ' ' || c == '-' || c == '_' || std::isdigit(c); });
                INFO(shader << " for " << name);
                CHECK(lower(shader) == lower(words));
            }
        }
    }
}
