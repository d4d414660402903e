// Alias tables, environments and the energy table against what they stand for.
#include "alias_table.h"
#include "catch.h"
#include "environment.h"
#include "scene_pack.h"

#include <numeric>

using namespace sample;

TEST_CASE("an alias table gives back the probabilities it was made of", "[unit]")
{
    const std::vector<double> weights = {0.0, 1.0, 5.0, 0.25, 100.0, 3.0};
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const std::vector<AliasEntry> table = buildAliasTable(weights);
    std::vector<double> drawn(weights.size(), 0.0);
    for (size_t i = 0; i < table.size(); ++i)
    {
        drawn[i] += double(table[i].threshold);
        drawn[table[i].alias] += 1.0 - double(table[i].threshold);
        CHECK(double(table[i].probability) == Approx(weights[i] / sum));
    }
    for (size_t i = 0; i < table.size(); ++i)
        CHECK(drawn[i] / double(table.size()) == Approx(weights[i] / sum).margin(1e-6));
    CHECK(buildAliasTable({}).empty());
    CHECK(buildAliasTable(std::vector<double>{0.0, 0.0})[1].probability == 0.5f);
}

TEST_CASE("the solid angles of an environment make the sphere", "[unit]")
{
    double sum = 0.0;
    for (int y = 0; y < 9; ++y) sum += 20 * texelSolidAngle(20, 9, y);
    CHECK(sum == Approx(4.0 * 3.14159265358979));
    const Environment uniform = makeUniformEnvironment(glm::vec3(2.0f));
    CHECK(uniform.mean.g == Approx(2.0f));
    const Environment sky = makeSky();
    // The ground is dark and the sun bright, so that most of the light comes from where the sun is.
    double brightest = 0.0;
    for (const AliasEntry& entry : sky.alias) brightest = std::max(brightest, double(entry.probability));
    CHECK(brightest > 20.0 / double(sky.alias.size()));
}

TEST_CASE("what is not a number in an environment becomes black", "[unit]")
{
    Image picture(2, 1);
    picture.rgba = {NAN, INFINITY, -1.0f, 1.0f, 0.5f, 0.25f, 1e30f, 1.0f};
    const Environment environment = makeEnvironment(picture);
    CHECK(environment.radiance[0] == glm::vec3(0.0f));
    CHECK(environment.radiance[1] == glm::vec3(0.5f, 0.25f, 1e6f));
    CHECK_THROWS_AS(makeEnvironment(Image()), FileError);
}

TEST_CASE("the energy table knows mirrors, and that rough metals lose light", "[unit]")
{
    const std::vector<glm::vec4> table = packEnergyTable();
    const auto at = [&](size_t cosine, size_t roughness) { return table[roughness * 32 + cosine]; };
    // A mirror reflects Schlick's Fresnel term.
    const float x = 1.0f - 20.0f / 31.0f;
    CHECK(at(20, 0).x == Approx(std::pow(x, 5.0f)).margin(2e-3));
    CHECK(at(20, 0).x + at(20, 0).y == Approx(1.0).margin(2e-3));
    // Roughness 1, seen from above: values of a numerical integration.
    CHECK(at(31, 31).x + at(31, 31).y == Approx(0.3069).margin(3e-3));
}
