// --denoiser auto: scene facts in, denoisers and reasons out.
#include "catch.h"
#include "denoiser_choice.h"
#include "scene_cornell.h"
#include "scene_panes.h"

#include <algorithm>

using namespace sample;
using nrd::Denoiser;

namespace
{
std::vector<SampleDenoiser> without(std::vector<Denoiser> missing)
{
    std::vector<SampleDenoiser> rows;
    std::ranges::copy_if(sampleDenoiserTable(), std::back_inserter(rows),
                         [&](const SampleDenoiser& row)
                         { return std::find(missing.begin(), missing.end(), row.denoiser) == missing.end(); });
    return rows;
}

DenoiserChoice choose(const SceneFacts& facts) { return chooseDenoisers(facts, sampleDenoiserTable()); }

SceneFacts rough()
{
    SceneFacts facts;
    facts.leastRoughness = 0.95f;
    return facts;
}

SceneFacts factsOfMaterial(const Material& material, std::vector<Texture> textures = {})
{
    Scene scene;
    Material unused; // a mirror that nothing is made of
    unused.roughness = 0.0f;
    unused.isBlended = true;
    scene.materials = {unused, material};
    scene.textures = std::move(textures);
    Primitive primitive;
    primitive.material = 1;
    scene.meshes.push_back({{primitive}, {}});
    scene.nodes.emplace_back();
    scene.nodes[0].mesh = 0;
    return factsOf(scene);
}
} // namespace

TEST_CASE("facts are those of what the scene is made of", "[unit]")
{
    Material material;
    material.roughness = 0.8f;
    material.metallic = 0.5f;
    SceneFacts facts = factsOfMaterial(material);
    CHECK(facts.leastRoughness == 0.8f);
    CHECK(facts.largestMetallic == 0.5f);
    CHECK_FALSE(facts.hasBlended);
    CHECK_FALSE(facts.hasSun);
    material.metallicRoughnessTexture.texture = 0;
    facts = factsOfMaterial(material, {{2, 1, {0, 255, 51, 0, 0, 51, 0, 0}}});
    CHECK(facts.leastRoughness == Approx(0.8f * 0.2f));
    CHECK(facts.largestMetallic == Approx(0.5f * 0.2f));
}

TEST_CASE("the built-in scenes have the facts they were built with", "[unit]")
{
    const SceneFacts cornell = factsOf(makeCornellBox()), panes = factsOf(makePanes());
    CHECK_FALSE((cornell.hasSun || cornell.hasBlended));
    CHECK((panes.hasSun && panes.hasBlended));
    CHECK((cornell.largestMetallic == 1.0f && panes.largestMetallic == 1.0f));
    Scene dark = makePanes();
    dark.lights[0].intensity = glm::vec3(0.0f);
    CHECK_FALSE(factsOf(dark).hasSun);
    Scene bulb = makePanes();
    bulb.lights[0].type = LightType::Point; // shines everywhere: not a light to denoise apart
    CHECK_FALSE(factsOf(bulb).hasSun);
}

TEST_CASE("a scene of rough dielectrics gets one denoiser for one signal", "[unit]")
{
    DenoiserChoice choice = choose(rough());
    CHECK(choice.set.lobes->denoiser == Denoiser::REBLUR_DIFFUSE);
    CHECK(choice.lobes == Lobes::Merged);
    SceneFacts facts = rough();
    facts.leastRoughness = 0.9f;
    CHECK(choose(facts).set.lobes->denoiser == Denoiser::REBLUR_DIFFUSE);
    facts.leastRoughness = 0.89f;
    CHECK(choose(facts).set.lobes->denoiser == Denoiser::REBLUR_DIFFUSE_SPECULAR);
    CHECK(choose(facts).lobes == Lobes::Both);
    facts = rough();
    facts.largestMetallic = 0.1f;
    CHECK(choose(facts).set.lobes->denoiser == Denoiser::REBLUR_DIFFUSE_SPECULAR);
}

TEST_CASE("lobes that are asked for are not chosen again", "[unit]")
{
    SceneFacts facts = rough();
    facts.lobes = Lobes::Probabilistic;
    DenoiserChoice choice = choose(facts);
    CHECK(choice.lobes == Lobes::Probabilistic);
    CHECK(choice.set.lobes->denoiser == Denoiser::REBLUR_DIFFUSE_SPECULAR);
    facts.leastRoughness = 0.1f;
    facts.lobes = Lobes::Merged;
    choice = choose(facts);
    CHECK(choice.lobes == Lobes::Merged);
    CHECK(choice.set.lobes->denoiser == Denoiser::REBLUR_DIFFUSE);
}

TEST_CASE("a sun gets a shadow denoiser, with colour where something colours it", "[unit]")
{
    SceneFacts facts = rough();
    CHECK(choose(facts).set.shadow == nullptr);
    facts.hasBlended = true;
    CHECK(choose(facts).set.shadow == nullptr);
    facts.hasSun = true;
    CHECK(choose(facts).set.shadow->denoiser == Denoiser::SIGMA_SHADOW_TRANSLUCENCY);
    facts.hasBlended = false;
    CHECK(choose(facts).set.shadow->denoiser == Denoiser::SIGMA_SHADOW);
}

TEST_CASE("what the library lacks is left out, and said to be", "[unit]")
{
    SceneFacts facts = rough();
    facts.hasSun = true;
    const auto shadowless = without({Denoiser::SIGMA_SHADOW, Denoiser::SIGMA_SHADOW_TRANSLUCENCY});
    const auto lobeless = without({Denoiser::REBLUR_DIFFUSE});
    const DenoiserChoice noShadow = chooseDenoisers(facts, shadowless), noLobes = chooseDenoisers(facts, lobeless);
    CHECK(noShadow.set.shadow == nullptr);
    CHECK(noShadow.set.name() == "REBLUR_DIFFUSE");
    CHECK_THAT(noShadow.reasons.back(), containing("no SIGMA_SHADOW: the library does not have it"));
    CHECK(noLobes.set.name() == "SIGMA_SHADOW");
}

TEST_CASE("every choice comes with one line for the lobes and one for the shadow", "[unit]")
{
    for (const float roughness : {0.3f, 0.95f})
        for (const float metallic : {0.0f, 1.0f})
            for (const bool hasSun : {false, true})
            {
                SceneFacts facts;
                facts.leastRoughness = roughness;
                facts.largestMetallic = metallic;
                facts.hasSun = hasSun;
                const DenoiserChoice choice = choose(facts);
                REQUIRE(choice.reasons.size() == 2);
                CHECK(choice.reasons[0].find(choice.set.lobes->name) == 0);
                CHECK_THAT(choice.reasons[1], containing("SIGMA"));
                for (const std::string& reason : choice.reasons) CHECK(reason.find('\n') == std::string::npos);
            }
}
