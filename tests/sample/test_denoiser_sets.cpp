// --denoiser: which denoisers run beside each other, which together, and which settings reach them.
#include "catch.h"
#include "denoiser_set.h"

using namespace sample;

namespace
{
std::string errorOf(const std::string& text)
{
    try
    {
        parseDenoiserSets(text);
    }
    catch (const SettingError& error)
    {
        return error.what();
    }
    return "";
}

const SampleDenoiser& rowOf(nrd::Denoiser denoiser)
{
    for (const SampleDenoiser& row : sampleDenoiserTable())
        if (row.denoiser == denoiser) return row;
    throw std::logic_error("no such row");
}
} // namespace

TEST_CASE("a comma separates what is compared", "[unit]")
{
    const std::vector<DenoiserSet> sets = parseDenoiserSets("reblur_diffuse_specular,RELAX_DIFFUSE,NONE");
    REQUIRE(sets.size() == 3);
    CHECK(sets[0].name() == "REBLUR_DIFFUSE_SPECULAR");
    CHECK(sets[1].name() == "RELAX_DIFFUSE");
    CHECK(sets[1].families() == std::vector<Family>{Family::Relax, Family::Confidence});
    CHECK(sets[2].isNone());
    CHECK_FALSE(sets[2].composesLight());
    CHECK(familiesOf(sets) == std::vector<Family>{Family::Reblur, Family::Confidence, Family::Relax, Family::None});
}

TEST_CASE("what makes no sense as a list of denoisers is refused by name", "[unit]")
{
    CHECK_THAT(errorOf("REBLUR_DIFFUSE+REBLUR_SPECULAR"), containing("REBLUR_SPECULAR would denoise the same"));
    CHECK_THAT(errorOf("REBLUR_DIFFUSE,reblur_diffuse"), containing("REBLUR_DIFFUSE is there twice"));
    CHECK_THAT(errorOf("REBLUR_DIFFUSE,"), containing("'' is not"));
    CHECK_THAT(errorOf("REBLUR_DIFFUSE,auto"), containing("'auto' is not"));
    CHECK_THAT(errorOf("MAGIC+NONE"), containing("'MAGIC' is not"));
}

TEST_CASE("a set with a shadow is named after both, and composes light even without lobes", "[unit]")
{
    const SampleDenoiser &relax = rowOf(nrd::Denoiser::RELAX_DIFFUSE), &none = rowOf(nrd::Denoiser::MAX_NUM);
    const SampleDenoiser &sigma = rowOf(nrd::Denoiser::SIGMA_SHADOW),
                         &occlusion = rowOf(nrd::Denoiser::REBLUR_DIFFUSE_OCCLUSION);
    const DenoiserSet both = {&relax, &sigma}, alone = {&none, &sigma}, grey = {&occlusion, &sigma};
    CHECK(both.name() == "RELAX_DIFFUSE+SIGMA_SHADOW");
    CHECK(alone.name() == "SIGMA_SHADOW");
    CHECK((both.composesLight() && alone.composesLight()));
    CHECK_FALSE(grey.composesLight());
    CHECK_FALSE(alone.isNone());
}

TEST_CASE("a setting reaches every family that has it", "[unit]")
{
    const std::vector<Family> families = {Family::Reblur, Family::Relax};
    ReplaySettings s;
    applySettings(s, families,
                  {{"fastHistoryClampingSigmaScale", "1.25"},
                   {"diffuseMaxAccumulatedFrameNum", "4"},
                   {"maxBlurRadius", "9"},
                   {"splitScreen", "0.5"}});
    CHECK(s.common.splitScreen == 0.5f);
    CHECK(s.reblur.maxBlurRadius == 9.0f);
    CHECK((s.reblur.fastHistoryClampingSigmaScale == 1.25f && s.relax.fastHistoryClampingSigmaScale == 1.25f));
    CHECK(s.relax.diffuseMaxAccumulatedFrameNum == 4);
    CHECK_THROWS_AS(applySettings(s, families, {{"noSuchSetting", "1"}}), SettingError);
    CHECK_THROWS_AS(applySettings(s, families, {{"diffuseMaxAccumulatedFrameNum", "many"}}), SettingError);
    CHECK_THROWS_AS(applySettings(s, std::vector{Family::Reblur}, {{"diffuseMaxAccumulatedFrameNum", "4"}}), SettingError);
    CHECK(isCommonSetting("splitScreen"));
    CHECK_FALSE(isCommonSetting("maxBlurRadius"));
}
