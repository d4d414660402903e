// The table of settings, points given on the command line, and which denoisers compare.
#include "catch.h"

#include "report_points.h"

#include <set>

using namespace sample;
using namespace sample::report;

namespace
{
std::string groupOfNamed(const char* name) { return groupOf(*findDenoiser(name)); }
} // namespace

TEST_CASE("every family has points of different names, each of which it has the settings of", "[unit]")
{
    for (Family family : {Family::Reblur, Family::Relax, Family::Sigma, Family::Reference})
    {
        std::set<std::string> names;
        for (const Point& point : pointsOf(family))
        {
            INFO(point.name);
            CHECK(names.insert(point.name).second);
            CHECK(hasSettings(family, point));
        }
        CHECK_FALSE(names.empty());
    }
    CHECK(pointsOf(Family::None).empty());
}

TEST_CASE("a point is a name and its settings", "[unit]")
{
    const Point point = parsePoint("my point:  maxBlurRadius=20 historyFixFrameNum=2", nrd::Quality::BEST);
    CHECK(point.name == "my point");
    CHECK(point.preset == nrd::Quality::BEST);
    CHECK(point.settings == std::vector<Assignment>{{"maxBlurRadius", "20"}, {"historyFixFrameNum", "2"}});
    CHECK(hasSettings(Family::Reblur, point));
    CHECK_FALSE(hasSettings(Family::Relax, point)); // it has no maxBlurRadius
    CHECK(hasSettings(Family::Relax, parsePoint("plain:", nrd::Quality::BALANCED)));
    for (const char* text : {"no colon", ": a=1", "name: value"})
        CHECK_THROWS_AS(parsePoint(text, nrd::Quality::BALANCED), SettingError);
    CHECK_THROWS_AS(hasSettings(Family::Reblur, parsePoint("p: maxBlurRadius=wide", nrd::Quality::BALANCED)),
                    SettingError);
}

TEST_CASE("denoisers of the same part of the picture compare", "[unit]")
{
    CHECK(groupOfNamed("REBLUR_DIFFUSE_SPECULAR") == "diffuse-specular");
    CHECK(groupOfNamed("RELAX_DIFFUSE_SPECULAR_SH") == "diffuse-specular");
    CHECK(groupOfNamed("REFERENCE") == groupOfNamed("RELAX_DIFFUSE"));
    CHECK(groupOfNamed("SIGMA_SHADOW") != groupOfNamed("SIGMA_SHADOW_TRANSLUCENCY"));
    CHECK(groupOfNamed("REBLUR_DIFFUSE_OCCLUSION") == groupOfNamed("REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION"));
    CHECK(groupOfNamed("REBLUR_DIFFUSE_OCCLUSION") != groupOfNamed("REBLUR_DIFFUSE"));
}
