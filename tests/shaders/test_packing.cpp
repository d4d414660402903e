// Packing for the ..._SH and directional denoisers, and its way back.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "lobes.h"
#include <limits>

using namespace nrdtest;

namespace
{
const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

Vec4 packed(Vec3d v, float w) { return {float(v[0]), float(v[1]), float(v[2]), w}; }
} // namespace

TEST_CASE("packing as a lobe and extracting its colour and direction is a round trip", "[gpu]")
{
    std::mt19937 rng(11);
    std::uniform_real_distribution<float> value(0.0f, 250.0f), unit(0.0f, 1.0f);
    std::vector<Arguments> in, back, extract;
    for (int i = 0; i < 1000; i++)
    {
        const float sanitize = i % 2 == 0 ? 1.0f : 0.0f;
        in.push_back({{value(rng), value(rng), value(rng), unit(rng)}, packed(randomDirection(rng), sanitize)});
    }
    const std::vector<Results> sh = runFunction(FN_PACK_SH, in);
    for (const Results& r : sh) back.push_back({r.first, r.second});
    const std::vector<Results> record = runFunction(FN_UNPACK_SH, back), extracted = runFunction(FN_EXTRACT, back);
    for (size_t i = 0; i < in.size(); i++)
    {
        const Vec4& rgb = in[i].a;
        const double luma = 0.25 * rgb[0] + 0.5 * rgb[1] + 0.25 * rgb[2];
        CHECK(sh[i].first[0] == Approx(luma).epsilon(1e-5));
        CHECK(sh[i].second[3] == 0.0f);
        CHECK(record[i].first[3] == rgb[3]);
        CHECK(record[i].second[3] == Approx(0.999 * (3 - 0.998001) / (1 - 0.998001)).epsilon(1e-3)); // one direction
        for (int c = 0; c < 3; c++)
        {
            CHECK(sh[i].second[c] == Approx(luma * in[i].b[c]).epsilon(1e-5).margin(1e-4));
            CHECK(extracted[i].first[c] == Approx(rgb[c]).margin(1e-3));
            CHECK(extracted[i].second[c] == Approx(in[i].b[c]).margin(1e-5));
        }
    }
}

TEST_CASE("what is not finite becomes no sample and no direction", "[gpu]")
{
    for (const float bad : {kNan, -kNan, kInf, -kInf})
    {
        for (int c = 0; c < 7; c++)
        {
            Arguments in = {{1, 2, 3, 0.5f}, {0, 0, 1, 1}};
            (c < 4 ? in.a[c] : in.b[c - 4]) = bad;
            const Results r = runFunction(FN_PACK_SH, in);
            CHECK(r.second == Vec4{});
            CHECK(r.first == (c < 4 ? Vec4{} : Vec4{2, -1, 0, 0.5f})); // a bad direction leaves the colour
            if (c >= 4) continue;
            Arguments directional = {{0, 0, 1, 0.5f}, {1, 0, 0, 0}};
            directional.a[c] = bad;
            const Results d = runFunction(FN_PACK_DIRECTIONAL, directional);
            CHECK(d.first == (c == 3 ? Vec4{} : Vec4{0, 0, 0, 0.5f}));
        }
    }
}

TEST_CASE("sanitised lobes fit half floats", "[gpu]")
{
    const Results r = runFunction(FN_PACK_SH, {Vec4{1e9f, 1e9f, 1e9f, 7}, Vec4{1e9f, -3, 0.5f, 1}});
    CHECK(r.first == Vec4{65504, 0, 0, 1});
    CHECK(r.second == Vec4{65504, -65504, 32752, 0});
    const Results negative = runFunction(FN_PACK_SH, {Vec4{-1, -1, -1, -1}, Vec4{0, 0, 1, 1}});
    CHECK(negative.first == Vec4{});
    CHECK(negative.second == Vec4{});
}

TEST_CASE("directional occlusion is a round trip", "[gpu]")
{
    std::mt19937 rng(12);
    std::uniform_real_distribution<float> unit(0.01f, 1.0f);
    for (int i = 0; i < 20; i++)
    {
        const Vec4 in = packed(randomDirection(rng), unit(rng));
        const Results p = runFunction(FN_PACK_DIRECTIONAL, {in, Vec4{float(i % 2), 0, 0, 0}});
        CHECK(p.first[3] == in[3]);
        const Results record = runFunction(FN_UNPACK_DIRECTIONAL, {p.first});
        CHECK(record.first == Vec4{in[3], 0, 0, in[3]});
        for (int c = 0; c < 3; c++) CHECK(record.second[c] == Approx(in[c] * in[3]).margin(1e-6));
    }
    CHECK(runFunction(FN_PACK_DIRECTIONAL, {Vec4{0, 0, 1, 7}, Vec4{1, 0, 0, 0}}).first == Vec4{0, 0, 1, 1});
}

TEST_CASE("the measured sharpness is that of the mean cosine", "[gpu]")
{
    const float rows[][2] = {
        {0, 0}, {0.25f, 0.783333f}, {0.5f, 1.833333f}, {2.0f / 3.0f, 3.066667f}, {0.9f, 10.373684f}};
    for (const auto& row : rows)
    {
        const Results r = runFunction(FN_UNPACK_SH, {Vec4{4, 0, 0, 0}, Vec4{0, 4 * row[0], 0, 0}});
        CHECK(r.second[3] == Approx(row[1]).epsilon(1e-5).margin(1e-6));
    }
    // Longer than the luma, by rounding or by another denoiser's rules, or without luma: bounded, never negative.
    for (const Vec4& sh0 : {Vec4{4, 0, 0, 0}, Vec4{0, 0, 0, 0}, Vec4{-1, 0, 0, 0}})
    {
        const float sharpness = runFunction(FN_UNPACK_SH, {sh0, Vec4{0, 8, 0, 0}}).second[3];
        CHECK(sharpness > 900.0f);
        CHECK(sharpness < 1100.0f);
        CHECK(runFunction(FN_UNPACK_SH, {sh0, Vec4{}}).second[3] == 0.0f);
    }
}
