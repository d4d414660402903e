// Resolves of the lobe record against the published vectors and against double precision.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "lobes.h"

using namespace nrdtest;

namespace
{
constexpr double kEps = 1e-6;

Vec4 packed(Vec3d v, double w = 0.0) { return {float(v[0]), float(v[1]), float(v[2]), float(w)}; }

// Luma of a resolved grey lobe with c0 = 1 towards L; first result of the function.
float resolve(int function, Vec3d c1, Vec3d normal, double roughness, Vec3d view)
{
    return runFunction(function, {Vec4{1, 0, 0, 0}, packed(c1), packed(normal, roughness), packed(view)}).first[0];
}

// A view, a normal that faces it and a lobe's axis: anywhere, below the horizon too.
struct Configuration
{
    Vec3d axis, normal, view;
    double c0, roughness;
    Arguments arguments;
};

std::vector<Configuration> randomConfigurations(uint32_t seed, size_t count)
{
    std::mt19937 rng(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Configuration> all(count);
    for (Configuration& c : all)
    {
        c.view = randomDirection(rng);
        c.normal = tilted(rng, c.view, 89.0 * unit(rng));
        c.axis = randomDirection(rng);
        c.c0 = std::exp(8.0 * unit(rng) - 4.0);
        c.roughness = unit(rng);
        const Vec4 sh0 = {float(c.c0), float(0.1 * c.c0), float(-0.1 * c.c0), 0.5f};
        c.arguments = {sh0, packed(scaled(c.axis, c.c0 * (0.05 + 0.95 * unit(rng)))), packed(c.normal, c.roughness),
                       packed(c.view)};
    }
    return all;
}

std::vector<Results> run(int function, const std::vector<Configuration>& all)
{
    std::vector<Arguments> in;
    for (const Configuration& c : all) in.push_back(c.arguments);
    return runFunction(function, in);
}

Vec3d c1Of(const Configuration& c) { return {c.arguments.b[0], c.arguments.b[1], c.arguments.b[2]}; }

// YCoCg of the record, at another luma, to linear.
Vec3d rechromaed(const Configuration& c, double luma)
{
    const double y = std::max(luma, 0.0), s = (y + kEps) / (c.c0 + kEps);
    const double co = 0.1 * c.c0 * s, cg = -0.1 * c.c0 * s, t = y - cg;
    return {std::max(t + co, 0.0), std::max(y + cg, 0.0), std::max(t - co, 0.0)};
}

void checkColor(const Configuration& c, const Results& r, double luma)
{
    const Vec3d expected = rechromaed(c, luma);
    for (int i = 0; i < 3; i++) CHECK(r.first[i] == Approx(expected[i]).epsilon(2e-4).margin(1e-5 * c.c0));
}
} // namespace

TEST_CASE("resolves give the published values", "[gpu]")
{
    const Vec3d z = {0, 0, 1};
    const double sin60 = std::sqrt(0.75), s45 = std::sqrt(0.5);
    CHECK(resolve(FN_SG_DIFFUSE, z, z, 0.5, z) == Approx(0.99966).margin(1e-5));
    CHECK(resolve(FN_SG_DIFFUSE, z, z, 1.0, z) == Approx(0.99966).margin(1e-5));
    CHECK(resolve(FN_SG_DIFFUSE, {sin60, 0, 0.5}, z, 0.5, z) == Approx(0.68028).margin(1e-5));
    CHECK(resolve(FN_SG_SPECULAR, z, z, 0.3, z) == Approx(1.00531).margin(1e-5));
    CHECK(resolve(FN_SG_SPECULAR, z, z, 0.8, z) == Approx(1.00530).margin(1e-5));
    CHECK(resolve(FN_SG_SPECULAR, {-s45, 0, s45}, z, 0.3, {s45, 0, s45}) == Approx(0.97239).margin(1e-5));
    CHECK(resolve(FN_SH_DIFFUSE, {0, 0, 2.0 / 3.0}, z, 0.0, z) == Approx(0.95493).margin(1e-5));
}

TEST_CASE("the dominant direction turns from mirror to normal by the published factor", "[gpu]")
{
    const double rows[][3] = {{0, 1, 1}, {0.5, 0.5, 0.89286}, {1, 0.5, 0}, {1, 0.1, 0.13620}};
    for (const auto& row : rows)
    {
        const Vec3d n = {0, 0, 1}, v = {std::sqrt(1.0 - row[1] * row[1]), 0, row[1]};
        const Vec3d expected = normalized({-row[2] * v[0], 0, lerp(1.0, v[2], row[2])});
        const Results r = runFunction(FN_DOMINANT, {Vec4{}, Vec4{}, packed(n, row[0]), packed(v)});
        for (int i = 0; i < 3; i++) CHECK(r.first[i] == Approx(expected[i]).margin(1e-5));
    }
}

TEST_CASE("diffuse resolves agree with double precision", "[gpu]")
{
    const std::vector<Configuration> all = randomConfigurations(21, 2000);
    const std::vector<Results> sg = run(FN_SG_DIFFUSE, all), sh = run(FN_SH_DIFFUSE, all);
    for (size_t i = 0; i < all.size(); i++)
    {
        const Configuration& c = all[i];
        checkColor(c, sg[i], sgDiffuse(c.c0, c.axis, c.normal, c.view, c.roughness));
        checkColor(c, sh[i], c.c0 / kPi + 3.0 / kPi * dot(c1Of(c), c.normal));
    }
}

TEST_CASE("specular resolves agree with double precision", "[gpu]")
{
    const std::vector<Configuration> all = randomConfigurations(22, 2000);
    const std::vector<Results> sg = run(FN_SG_SPECULAR, all), sh = run(FN_SH_SPECULAR, all);
    for (size_t i = 0; i < all.size(); i++)
    {
        const Configuration& c = all[i];
        checkColor(c, sg[i], sgSpecular(c.c0, c.axis, c.normal, c.view, c.roughness));
        const Vec3d dominant = dominantDirection(c.normal, c.view, c.roughness);
        checkColor(c, sh[i], c.c0 / kPi + 3.0 / kPi * dot(c1Of(c), dominant));
    }
}

TEST_CASE("the integral of two lobes' product holds from nothing to needles", "[gpu]")
{
    std::mt19937 rng(23);
    std::uniform_real_distribution<double> exponent(-4.0, 5.5), angle(0.0, 0.01);
    std::vector<Arguments> in;
    for (int i = 0; i < 2000; i++)
    {
        const Vec3d axis = randomDirection(rng);
        // Sharp lobes must overlap to leave anything to compare.
        const Vec3d other = i % 2 == 0 ? tilted(rng, axis, angle(rng)) : randomDirection(rng);
        in.push_back({packed(axis, std::pow(10.0, exponent(rng))), packed(other, std::pow(10.0, exponent(rng))),
                      Vec4{3, 0, 0, 0}});
    }
    const Vec4 z = {0, 0, 1, 2}, minusZ = {0, 0, -1, 2};
    in.push_back({z, minusZ, Vec4{3, 0, 0, 0}}); // the sum of the axes vanishes
    in.push_back({Vec4{}, Vec4{}, Vec4{3, 0, 0, 0}});
    const std::vector<Results> out = runFunction(FN_SG_INTEGRAL, in);
    for (size_t i = 0; i < in.size(); i++)
    {
        const Vec3d a = {in[i].a[0], in[i].a[1], in[i].a[2]}, b = {in[i].b[0], in[i].b[1], in[i].b[2]};
        const bool isUnit = dot(a, a) > 0.0; // axes as the device has them are unit to 1e-7 only
        const double expected =
            isUnit ? sgIntegral(normalized(a), in[i].a[3], normalized(b), in[i].b[3], 3.0) : 12.0 * kPi;
        CHECK(out[i].first[0] == Approx(expected).epsilon(5e-3).margin(1e-6));
    }
}

TEST_CASE("a lobe without direction keeps its colour, and turns by a matrix", "[gpu]")
{
    const Arguments none = {{2, 0.5f, -0.25f, 0}, {}, {0, 0, 1, 0.5f}, {0, 0, 1, 0}};
    const Vec4 color = runFunction(FN_EXTRACT, none).first;
    CHECK(runFunction(FN_EXTRACT, none).second == Vec4{});
    CHECK(runFunction(FN_SG_DIFFUSE, none).first == color);
    CHECK(runFunction(FN_SG_SPECULAR, none).first == color);
    const Results turned = runFunction(FN_ROTATE, {Vec4{}, Vec4{2, 3, 5, 0}, Vec4{0.6f, 0.8f, 0, 0}});
    CHECK(turned.first[0] == Approx(2 * 0.6 - 3 * 0.8));
    CHECK(turned.first[1] == Approx(2 * 0.8 + 3 * 0.6));
    CHECK(turned.first[2] == 5.0f);
}

TEST_CASE("no resolve gives NaN, infinities or negative light at the ends of its range", "[gpu]")
{
    const Vec3d axes[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {1e-20, 0, 0}, {0, 0, 0}};
    std::vector<Arguments> in;
    for (const Vec3d& axis : axes)
        for (const Vec3d& view : axes)
            for (const double r : {0.0, 0.05, 1.0})
                for (const float c0 : {0.0f, 1e-7f, -1.0f, 65504.0f})
                    in.push_back({{c0, 0, 0, 0},
                                  packed(scaled(axis, c0)),
                                  packed({0, 0, 1}, r),
                                  packed(view),
                                  {0, 0.6f, 0.8f, 0}});
    for (const int function : {FN_EXTRACT, FN_SH_DIFFUSE, FN_SH_SPECULAR, FN_SG_DIFFUSE, FN_SG_SPECULAR,
                               FN_RESTORE_DIFFUSE, FN_RESTORE_SPECULAR, FN_CAVITY})
        for (const Results& r : runFunction(function, in))
            for (int c = 0; c < 3; c++)
            {
                CHECK(std::isfinite(r.first[c]));
                CHECK(r.first[c] >= 0.0f);
            }
}
