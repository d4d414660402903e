// What the front end has for the tracer itself: trimmed sampling of the specular lobe, guides of hair.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "lobes.h"

using namespace nrdtest;

namespace
{
Vec4 packed(Vec3d v, double w) { return {float(v[0]), float(v[1]), float(v[2]), float(w)}; }
Vec3d unpacked(const Vec4& v) { return {v[0], v[1], v[2]}; }

Vec3d trimmedSample(double u0, double u1, Vec3d view, double roughness, double factor)
{
    const double alpha = roughness * roughness;
    const Vec3d v = normalized({alpha * view[0], alpha * view[1], view[2]});
    const Vec3d t = normalized({-v[1], v[0], 0.0}), b = cross(v, t);
    const double radius = std::sqrt(u0 * factor), x = radius * std::cos(2.0 * kPi * u1), s = 0.5 * (1.0 + v[2]);
    const double y = (1.0 - s) * std::sqrt(1.0 - x * x) + s * radius * std::sin(2.0 * kPi * u1);
    const Vec3d n = sum(sum(scaled(t, x), scaled(b, y)), scaled(v, std::sqrt(std::max(1.0 - x * x - y * y, 0.0))));
    return normalized({alpha * n[0], alpha * n[1], std::max(n[2], 1e-6)});
}

std::vector<Arguments> randomSamples(uint32_t seed, Vec3d view, double roughness, double factor)
{
    std::mt19937 rng(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<Arguments> in(8192);
    for (Arguments& a : in) a = {{unit(rng), unit(rng), float(roughness), float(factor)}, packed(view, 0.0)};
    return in;
}
} // namespace

TEST_CASE("trimming grows with roughness between its bounds", "[gpu]")
{
    const double rows[][2] = {{0, 0}, {0.04, 0}, {0.075, 0.425}, {0.11, 0.85}, {1, 0.85}};
    for (const auto& row : rows)
    {
        const Results r = runFunction(FN_TRIMMING, {Vec4{float(row[0]), 0.4f, 0, 0}, Vec4{0.85f, 0.04f, 0.11f, 0}});
        CHECK(r.first[0] == Approx(row[1]).margin(1e-5));
        CHECK(r.first[1] == Approx(lerp(0.4, 1.0, row[1])).margin(1e-5));
    }
    CHECK(runFunction(FN_TRIMMING, {Vec4{0.5f, 1, 0, 0}, Vec4{0.9f, 0.1f, 0.1f, 0}}).first[0] == 0.9f); // no width
}

TEST_CASE("trimmed samples agree with double precision", "[gpu]")
{
    std::mt19937 rng(61);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Arguments> in;
    std::vector<Vec3d> expected;
    for (int i = 0; i < 2000; i++)
    {
        const Vec3d view = tilted(rng, {0, 0, 1}, 2.0 + 86.0 * unit(rng));
        const double u0 = unit(rng), u1 = unit(rng), roughness = 0.1 + 0.9 * unit(rng), factor = unit(rng);
        in.push_back({{float(u0), float(u1), float(roughness), float(factor)}, packed(view, 0.0)});
        expected.push_back(trimmedSample(u0, u1, view, roughness, factor));
    }
    const std::vector<Results> out = runFunction(FN_TRIMMED_SAMPLE, in);
    for (size_t i = 0; i < in.size(); i++)
    {
        CHECK(length(difference(unpacked(out[i].first), expected[i])) < 2e-3); // square roots of what cancels
        CHECK(length(unpacked(out[i].first)) == Approx(1.0).margin(1e-5));
    }
}

TEST_CASE("the whole lobe is the distribution of visible normals, a trimmed one is narrower", "[gpu]")
{
    const Vec3d view = normalized({0.7, 0.2, 0.5});
    const double roughness = 0.6, m2 = std::pow(roughness, 4);
    // Mean of N.H over visible normals, D G1 VoH / NoV, by integration.
    double expected = 0.0, total = 0.0;
    for (int i = 0; i < 1000; i++)
        for (int j = 0; j < 64; j++)
        {
            const double z = (i + 0.5) / 1000.0, phi = 2.0 * kPi * (j + 0.5) / 64.0, s = std::sqrt(1.0 - z * z);
            const double t = z * z * (m2 - 1.0) + 1.0;
            const double w = m2 / (t * t) * std::max(dot(view, {s * std::cos(phi), s * std::sin(phi), z}), 0.0);
            expected += w * z;
            total += w;
        }
    double means[3] = {}, deviations[3] = {};
    const double factors[3] = {1.0, 0.5, 0.0};
    for (int f = 0; f < 3; f++)
    {
        Vec3d mean{};
        const std::vector<Results> out = runFunction(FN_TRIMMED_SAMPLE, randomSamples(62, view, roughness, factors[f]));
        for (const Results& r : out) mean = sum(mean, scaled(unpacked(r.first), 1.0 / double(out.size())));
        means[f] = mean[2];
        deviations[f] = 1.0 - length(mean);
    }
    CHECK(means[0] == Approx(expected / total).margin(0.01));
    CHECK(deviations[1] < 0.7 * deviations[0]);
    CHECK(deviations[2] < 1e-5); // one direction
}

TEST_CASE("sampling survives mirrors and views from above and from the horizon", "[gpu]")
{
    for (const Vec3d& view : {Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, Vec3d{1, 0, 1e-7}, Vec3d{0, 0, 0}})
        for (const double roughness : {0.0, 0.03, 1.0})
            for (const Results& r : runFunction(FN_TRIMMED_SAMPLE, randomSamples(63, view, roughness, 1.0)))
            {
                CHECK(length(unpacked(r.first)) == Approx(1.0).margin(1e-4));
                CHECK(r.first[2] >= 0.0f);
            }
}

TEST_CASE("the thickness factor is 0 for strands of pixels and 1 far below one", "[gpu]")
{
    const double rows[][2] = {{0, 0}, {80e-6, 40.0 / 81.0}, {160e-6, 80.0 / 81.0}, {1, 1}};
    for (const auto& row : rows)
    {
        const Arguments in = {{1, 0, 0, float(row[0])}, {0, 0, 1, 80e-6f}};
        CHECK(runFunction(FN_STRANDS, in).first[3] == Approx(row[1]).margin(1e-5));
    }
    CHECK(runFunction(FN_STRANDS, {Vec4{1, 0, 0, 0}, Vec4{0, 0, 1, 0}}).first[3] == 0.0f); // no size at all
    CHECK(runFunction(FN_STRANDS, {Vec4{1, 0, 0, 1}, Vec4{0, 0, 1, -1}}).first[3] == 1.0f);
}

TEST_CASE("a strand's normal is unit, across the strand and faces the camera", "[gpu]")
{
    std::mt19937 rng(64);
    for (int i = 0; i < 200; i++)
    {
        const Vec3d t = randomDirection(rng),
                    v = i % 10 == 0 ? scaled(t, i % 20 == 0 ? 1.0 : -1.0) : randomDirection(rng);
        const Results r = runFunction(FN_STRANDS, {packed(t, 0.0), packed(v, 1.0)});
        const Vec3d n = unpacked(r.first);
        CHECK(length(n) == Approx(1.0).margin(1e-5));
        CHECK(std::abs(dot(n, t)) < 1e-5);
        if (i % 10 != 0) CHECK(dot(n, v) >= 0.0); // one that points at the camera has no such side
        if (i % 10 != 0) CHECK(std::abs(dot(unpacked(r.second), v)) < 1e-5);
    }
    for (const Vec4& t : {Vec4{0, 0, 0, 0}, Vec4{0, 0, 1, 0}, Vec4{1, 0, 0, 0}})
        for (int c = 0; c < 3; c++) CHECK(std::isfinite(runFunction(FN_STRANDS, {t, Vec4{0, 0, 0, 0}}).first[c]));
}
