// The front end and back end that applications include, against C++ and the published vectors.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "lobes.h"
#include <cmath>
#include <cstring>
#include <limits>

using namespace nrdtest;

namespace
{
float floatFromBits(uint32_t bits)
{
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}
} // namespace

TEST_CASE("the 10-bit encoding gives the published texels", "[gpu]")
{
    struct Row
    {
        Vec4 normalRoughness;
        std::array<int, 3> texel;
    };
    const Row rows[] = {{{0, 0, 1, 0.5f}, {512, 512, 767}},
                        {{0, 0, -1, 0.5f}, {512, 512, 256}},
                        {{1, 0, 0, 0}, {1023, 0, 513}},
                        {{0.6f, 0, 0.8f, 0.25f}, {731, 292, 639}},
                        {{-0.48f, 0.6f, -0.64f, 1}, {547, 833, 0}}};
    for (const Row& row : rows)
    {
        const Results r = runFunction(FN_PACK_NORMAL, {row.normalRoughness, {3, 2, 1, 0}});
        for (int i = 0; i < 3; i++) CHECK(std::abs(r.first[i] * 1023.0f - static_cast<float>(row.texel[i])) <= 0.51f);
        CHECK(r.first[3] == 1.0f);  // material 3
        CHECK(r.first == r.second); // the wrapper uses the default encodings
    }
}

TEST_CASE("the published texels decode to the published normals and roughness", "[gpu]")
{
    const auto decode = [](float x, float y, float z) {
        return runFunction(FN_UNPACK_NORMAL, {Vec4{x / 1023, y / 1023, z / 1023, 1}, Vec4{0, 2, 1, 0}});
    };
    CHECK(decode(1023, 0, 513).first[3] == Approx(0.00293).margin(1e-5));
    const Results r = decode(731, 292, 639);
    const double expected[] = {0.60088, 0.0, 0.79934, 0.24927};
    for (size_t i = 0; i < 4; i++) CHECK(r.first[i] == Approx(expected[i]).margin(1e-5));
    CHECK(r.second[0] == 3.0f);
}

TEST_CASE("lobe spread and hit-distance normalisation match the published values", "[gpu]")
{
    const float spreads[][3] = {
        {0, 0.5f, 0}, {0.05f, 0.5f, 0.065493f},  {0.1f, 0.5f, 0.237171f},  {0.25f, 0.5f, 0.499914f},
        {1, 0.5f, 1}, {0.05f, 0.25f, 0.138501f}, {0.1f, 0.25f, 0.421756f}, {0.5f, 0.25f, 0.840896f}};
    for (const auto& row : spreads)
    {
        const Results r = runFunction(FN_LOBE_SPREAD, {Vec4{row[0], row[1], 0, 0}});
        CHECK(r.first[0] == Approx(row[2]).margin(2e-6));
        CHECK(r.first[0] == Approx(lobeSpread(row[0], row[1])).margin(2e-6));
    }
    const float lengths[][3] = {{10, 1, 4}, {10, 0, 80}, {10, 0.3f, 38.37324f}, {-100, 0.1f, 201.41881f}};
    for (const auto& row : lengths)
    {
        const Results forth = runFunction(FN_NORM_HIT_DIST, {Vec4{2, row[0], row[1], 0}, Vec4{3, 0.1f, 20, 0}});
        CHECK(forth.first[0] == Approx(2.0 / row[2]).epsilon(1e-5));
        const Results back = runFunction(FN_HIT_DIST, {Vec4{forth.first[0], row[0], row[1], 0}, Vec4{3, 0.1f, 20, 0}});
        CHECK(back.first[0] == Approx(2.0).epsilon(1e-5));
    }
}

TEST_CASE("a hit distance that is no number is no sample, an infinite one is a miss", "[gpu]")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const Vec4 parameters = {3, 0.1f, 20, 0};
    const auto normHitDist = [&](float hitDist) {
        return runFunction(FN_NORM_HIT_DIST, {Vec4{hitDist, 10, 1, 0}, parameters}).first[0];
    };
    CHECK(normHitDist(nan) == 0.0f);
    CHECK(normHitDist(inf) == 1.0f);
    CHECK(normHitDist(-1.0f) == 0.0f);
    CHECK(normHitDist(65504.0f) == 1.0f);
    // Parameters of zero, as forgotten constants have them, must not divide by zero.
    CHECK(runFunction(FN_NORM_HIT_DIST, {Vec4{0, 0, 1, 0}, Vec4{}}).first[0] == 0.0f);
}

TEST_CASE("packing radiance turns what is not finite into no sample", "[gpu]")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, -nan, inf, -inf, floatFromBits(0x7F800001u)})
    {
        for (int c = 0; c < 4; c++)
        {
            Vec4 in = {1, 2, 3, 0.5f};
            in[c] = bad;
            const Results r = runFunction(FN_PACK_RADIANCE, {in, Vec4{1, 0, 0, 0}});
            CHECK(r.first == Vec4{0, 0, 0, 0});
        }
    }
    const Results large = runFunction(FN_PACK_RADIANCE, {Vec4{1e9f, 1e9f, 1e9f, 7}, Vec4{1, 0, 0, 0}});
    CHECK(large.first[0] == 65504.0f);
    CHECK(large.first[3] == 1.0f);
    const Results packed = runFunction(FN_PACK_RADIANCE, {Vec4{0.25f, 4, 9, 0.75f}, Vec4{0, 0, 0, 0}});
    const Results unpacked = runFunction(FN_UNPACK_RADIANCE, {packed.first});
    const Vec4 expected = {0.25f, 4, 9, 0.75f};
    for (int c = 0; c < 4; c++) CHECK(unpacked.first[c] == Approx(expected[c]).epsilon(1e-5));
}

TEST_CASE("the environment term and the material factors match the published values", "[gpu]")
{
    const float rows[][4] = {{0.04f, 1, 0.5f, 0.03427f},
                             {0.04f, 0.2f, 0.5f, 0.13074f},
                             {0.9f, 0.7f, 0.1f, 0.92616f},
                             {1, 0.5f, 1, 0.39652f}};
    for (const auto& row : rows)
    {
        const Results r =
            runFunction(FN_ENVIRONMENT_TERM, {Vec4{row[0], row[0], row[0], row[1]}, Vec4{row[2], 0, 0, 0}});
        CHECK(r.first[0] == Approx(row[3]).margin(1e-5));
    }
    const Results a = runFunction(FN_MATERIAL_FACTORS, {Vec4{0.5f, 0.5f, 0.5f, 0.5f}, Vec4{0.04f, 0.04f, 0.04f, 1}});
    CHECK(a.first[0] == Approx(0.49321).margin(1e-5));
    CHECK(a.second[0] == Approx(0.03847).margin(1e-5));
    const Results b = runFunction(FN_MATERIAL_FACTORS, {Vec4{0, 0, 0, 0.1f}, Vec4{0.9f, 0.9f, 0.9f, 0.7f}});
    CHECK(b.first[0] == Approx(0.02).margin(1e-5));
    CHECK(b.second[0] == Approx(0.19245).margin(1e-5));
}

TEST_CASE("specular hit distances average to the nearest non-zero one", "[gpu]")
{
    CHECK(runFunction(FN_AVERAGING, {Vec4{0, 3, 2, 5}}).first[0] == 2.0f);
    CHECK(runFunction(FN_AVERAGING, {Vec4{0, 0, 0, 0}}).first[0] == 0.0f);
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    CHECK(runFunction(FN_AVERAGING, {Vec4{nan, inf, 7, nan}}).first[0] == 7.0f);
    CHECK(runFunction(FN_AVERAGING, {Vec4{nan, -1, 0, 0}}).first[0] == 0.0f);
    // A miss, however large, is not "no sample".
    for (const float miss : {inf, std::numeric_limits<float>::max()})
        CHECK(runFunction(FN_AVERAGING, {Vec4{0, miss, 0, 0}}).first[0] == 1e30f);
    CHECK(runFunction(FN_AVERAGING, {Vec4{nan, 0, 0, 0}}).first[1] == 0.0f);
    CHECK(runFunction(FN_AVERAGING, {Vec4{0.4f, 0, 0, 0}}).first[1] == 0.0f);
    CHECK(runFunction(FN_AVERAGING, {Vec4{0.6f, 0, 0, 0}}).first[1] == 0.6f);
}
