// Packing for RELAX, and what its denoisers return, against C++.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "packing.h"
#include <limits>

using namespace nrdtest;

namespace
{
const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

Vec4 packed(Vec3d v, float w) { return {float(v[0]), float(v[1]), float(v[2]), w}; }

double luma(const Vec4& rgb) { return toYCoCg({rgb[0], rgb[1], rgb[2]}).x; }

Vec4 yCoCg(const Vec4& rgb) { return packed(toYCoCg({rgb[0], rgb[1], rgb[2]}), rgb[3]); }

std::vector<Arguments> randomLobes(uint32_t seed)
{
    std::mt19937 rng(seed);
    std::uniform_real_distribution<float> value(0.0f, 250.0f), distance(0.0f, 65504.0f);
    std::vector<Arguments> lobes;
    for (int i = 0; i < 1000; i++)
    {
        const float sanitize = i % 2 == 0 ? 1.0f : 0.0f;
        const Vec4 signal = {value(rng), value(rng), value(rng), distance(rng)};
        lobes.push_back({signal, packed(randomDirection(rng), sanitize)});
    }
    return lobes;
}
} // namespace

TEST_CASE("RELAX takes and returns linear radiance as it is", "[gpu]")
{
    std::vector<Arguments> in = randomLobes(31);
    for (Arguments& lobe : in) lobe.b = {lobe.b[3], 0, 0, 0};
    const std::vector<Results> out = runFunction(FN_PACK_RELAX, in);
    for (size_t i = 0; i < in.size(); i++)
    {
        CHECK(out[i].first == in[i].a);
        CHECK(out[i].second == in[i].a);
    }
}

TEST_CASE("RELAX's SH vector is the direction times the luma that the lobe record has", "[gpu]")
{
    const std::vector<Arguments> in = randomLobes(32);
    const std::vector<Results> sh = runFunction(FN_PACK_RELAX_SH, in);
    std::vector<Arguments> back; // a denoiser that changes nothing, but for the space in which SH0 comes back
    for (size_t i = 0; i < in.size(); i++) back.push_back({yCoCg(sh[i].first), sh[i].second});
    const std::vector<Results> record = runFunction(FN_UNPACK_RELAX_SH, back), color = runFunction(FN_EXTRACT, back);
    for (size_t i = 0; i < in.size(); i++)
    {
        const Vec4& rgb = in[i].a;
        CHECK(sh[i].first == rgb);
        CHECK(sh[i].second[3] == 0.0f);
        CHECK(record[i].first == back[i].a);
        CHECK(record[i].second[3] == Approx(0.999 * (3 - 0.998001) / (1 - 0.998001)).epsilon(1e-3)); // one direction
        for (size_t c = 0; c < 3; c++)
        {
            CHECK(sh[i].second[c] == Approx(luma(rgb) * in[i].b[c]).epsilon(1e-5).margin(1e-4));
            CHECK(record[i].second[c] == sh[i].second[c]);
            CHECK(color[i].first[c] == Approx(rgb[c]).margin(1e-3));
            CHECK(color[i].second[c] == Approx(in[i].b[c]).margin(1e-5));
        }
    }
}

TEST_CASE("the mean cosine of RELAX's SH does not depend on the colour", "[gpu]")
{
    // Two directions at 60 degrees to their mean. Another luma would give pure blue and pure green other sharpnesses.
    const double sin60 = std::sqrt(0.75);
    for (const Vec4& rgb : {Vec4{4, 0, 0, 1}, Vec4{0, 4, 0, 1}, Vec4{0, 0, 4, 1}, Vec4{1, 2, 3, 1}})
    {
        const Results a = runFunction(FN_PACK_RELAX_SH, {rgb, packed({sin60, 0, 0.5}, 1)});
        const Results b = runFunction(FN_PACK_RELAX_SH, {rgb, packed({-sin60, 0, 0.5}, 1)});
        Vec4 mean;
        for (size_t c = 0; c < 4; c++) mean[c] = 0.5f * (a.second[c] + b.second[c]);
        const Results record = runFunction(FN_UNPACK_RELAX_SH, {yCoCg(rgb), mean});
        CHECK(record.second[3] == Approx(0.5 * (3 - 0.25) / (1 - 0.25)).epsilon(1e-5));
    }
}

TEST_CASE("RELAX's hit distance fits half floats; any large value is a miss, NaN no sample", "[gpu]")
{
    const auto packedDistance = [](float hitDist, float sanitize) {
        return runFunction(FN_PACK_RELAX, {Vec4{1, 2, 3, hitDist}, Vec4{sanitize, 0, 0, 0}}).first;
    };
    for (const float sanitize : {0.0f, 1.0f})
    {
        CHECK(packedDistance(0.0f, sanitize) == Vec4{1, 2, 3, 0});
        CHECK(packedDistance(65504.0f, sanitize) == Vec4{1, 2, 3, 65504});
        CHECK(packedDistance(1e30f, sanitize) == Vec4{1, 2, 3, 65504});
        CHECK(packedDistance(kInf, sanitize) == Vec4{1, 2, 3, 65504});
        CHECK(packedDistance(-1.0f, sanitize) == Vec4{1, 2, 3, 0});
        CHECK(packedDistance(kNan, sanitize)[3] == 0.0f);
    }
    CHECK(packedDistance(kNan, 0.0f) == Vec4{1, 2, 3, 0});
    CHECK(packedDistance(kNan, 1.0f) == Vec4{});
}

TEST_CASE("RELAX's packing turns what is not finite into no sample and no direction", "[gpu]")
{
    for (const float bad : {kNan, -kNan, kInf, -kInf})
        for (size_t c = 0; c < 6; c++)
        {
            Arguments in = {{1, 2, 3, 7}, {0, 0, 1, 1}};
            (c < 3 ? in.a[c] : in.b[c - 3]) = bad;
            const Results r = runFunction(FN_PACK_RELAX_SH, in);
            CHECK(r.second == Vec4{});
            CHECK(r.first == (c < 3 ? Vec4{} : Vec4{1, 2, 3, 7})); // a bad direction leaves the colour
            if (c < 3) CHECK(runFunction(FN_PACK_RELAX, {in.a, Vec4{1, 0, 0, 0}}).first == Vec4{});
        }
    const Results large = runFunction(FN_PACK_RELAX_SH, {Vec4{1e9f, 1e9f, 1e9f, 7}, Vec4{1e9f, -3, 0.5f, 1}});
    CHECK(large.first == Vec4{65504, 65504, 65504, 7});
    CHECK(large.second == Vec4{65504, -65504, 32752, 0});
    const Results negative = runFunction(FN_PACK_RELAX_SH, {Vec4{-1, -1, -1, -1}, Vec4{0, 0, 1, 1}});
    CHECK(negative.first == Vec4{});
    CHECK(negative.second == Vec4{});
}
