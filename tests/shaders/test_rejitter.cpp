// Re-jittering of resolved lobes against double precision.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "lobes.h"
#include <limits>

using namespace nrdtest;

namespace
{
Vec4 packed(Vec3d v, double w) { return {float(v[0]), float(v[1]), float(v[2]), float(w)}; }
Vec3d unpacked(const Vec4& v) { return {v[0], v[1], v[2]}; }

double diffuseResponse(Vec3d n, Vec3d v, Vec3d l, double r)
{
    const double nol = saturated(dot(n, l)), nov = saturated(std::abs(dot(n, v)));
    return burley(nol, nov, saturated(dot(v, normalized(sum(v, l)))), r) * nol;
}

double specularResponse(Vec3d n, Vec3d v, Vec3d l, double roughness)
{
    const double m2 = std::pow(std::max(roughness, 0.05), 4), nol = saturated(dot(n, l));
    const Vec3d h = normalized(sum(v, l));
    const double noh = dot(n, h), sine = length(cross(n, h)), t = m2 * noh * noh + sine * sine;
    return m2 / (kPi * t * t) * visibility(nol, lerp(0.02, 1.0, saturated(std::abs(dot(n, v)))), m2) * nol;
}

std::array<double, 2> expectedScales(const Arguments& in)
{
    const double r = in.a[3], spread = lobeSpread(r, 0.5);
    const Vec3d v = unpacked(in.c), ld = normalized(unpacked(in.a));
    const Vec3d ls = normalized(sum(scaled(v, 1.0 - spread), scaled(normalized(unpacked(in.b)), spread)));
    double d = 0.0, s = 0.0;
    for (const Vec4& neighbor : {in.e, in.f, in.g, in.h})
    {
        d += 0.25 * diffuseResponse(unpacked(neighbor), v, ld, r);
        s += 0.25 * specularResponse(unpacked(neighbor), v, ls, r);
    }
    const Vec3d n = unpacked(in.d);
    return {std::clamp((diffuseResponse(n, v, ld, r) + 1e-6) / (d + 1e-6), 0.5, 2.0),
            std::clamp((specularResponse(n, v, ls, r) + 1e-6) / (s + 1e-6), 0.5, 2.0)};
}

Arguments randomSurface(std::mt19937& rng, double tilt)
{
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const Vec3d v = randomDirection(rng), n = tilted(rng, v, 70.0 * unit(rng));
    const double z = -10.0 * unit(rng) - 1.0;
    Arguments in;
    in.a = packed(tilted(rng, n, 80.0 * unit(rng)), 0.1 + 0.9 * unit(rng));
    in.b = packed(tilted(rng, n, 80.0 * unit(rng)), 0.0);
    in.c = packed(v, 0.0);
    in.d = packed(n, z);
    for (Vec4* neighbor : {&in.e, &in.f, &in.g, &in.h})
        *neighbor = packed(tilted(rng, n, tilt * unit(rng)), z * (1.0 + 0.009 * (2.0 * unit(rng) - 1.0)));
    return in;
}
} // namespace

TEST_CASE("re-jittering agrees with double precision", "[gpu]")
{
    std::mt19937 rng(41);
    std::vector<Arguments> in;
    for (int i = 0; i < 2000; i++) in.push_back(randomSurface(rng, i % 2 == 0 ? 3.0 : 40.0));
    const std::vector<Results> out = runFunction(FN_REJITTER, in);
    size_t bounded = 0;
    for (size_t i = 0; i < in.size(); i++)
    {
        const auto expected = expectedScales(in[i]);
        for (size_t c = 0; c < 2; c++)
        {
            CHECK(out[i].first[c] == Approx(expected[c]).epsilon(1e-3));
            bounded += expected[c] == 0.5 || expected[c] == 2.0 ? 1 : 0;
        }
    }
    CHECK(bounded > 50); // both sides of the bounds were met
    CHECK(bounded < 2 * in.size() - 500);
}

TEST_CASE("re-jittering leaves flat surfaces and edges alone", "[gpu]")
{
    std::mt19937 rng(42);
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 20; i++)
    {
        Arguments flat = randomSurface(rng, 0.0);
        const Vec4 one = {1, 1, 0, 0};
        for (int c = 0; c < 2; c++) CHECK(runFunction(FN_REJITTER, flat).first[c] == Approx(1.0).margin(2e-3));
        for (const float z : {flat.d[3] * 1.3f, -flat.d[3], nan, inf, -inf})
        {
            Arguments edge = randomSurface(rng, 30.0);
            edge.g[3] = z == -flat.d[3] ? -edge.d[3] : z == flat.d[3] * 1.3f ? edge.d[3] * 1.3f : z;
            CHECK(runFunction(FN_REJITTER, edge).first == one);
        }
        Arguments bent = randomSurface(rng, 30.0);
        for (int c = 0; c < 3; c++) bent.h[c] = -bent.d[c];
        CHECK(runFunction(FN_REJITTER, bent).first == one);
    }
}

TEST_CASE("an edge of depth begins at a hundredth, more at grazing views", "[gpu]")
{
    for (const double nov : {1.0, 0.5, 0.1})
        for (const double share : {-1.02, -0.98, 0.98, 1.02})
        {
            const Vec3d n = {0, 0, 1}, tilt = {0.6, 0, 0.8}, v = {std::sqrt(1.0 - nov * nov), 0, nov};
            const double z = -50.0 * (1.0 + share * 0.01 / (0.95 * nov + 0.05));
            Arguments in = {packed(tilt, 0.5), packed(tilt, 0.0), packed(v, 0.0), packed(n, -50.0)};
            in.e = in.f = in.g = packed(tilt, -50.0);
            in.h = packed(tilt, z);
            CHECK((runFunction(FN_REJITTER, in).first == Vec4{1, 1, 0, 0}) == (std::abs(share) > 1.0));
        }
}

TEST_CASE("re-jittering survives lobes without direction and grazing views", "[gpu]")
{
    std::mt19937 rng(43);
    std::vector<Arguments> in;
    for (int i = 0; i < 200; i++)
    {
        Arguments a = randomSurface(rng, 20.0);
        if (i % 4 == 0) a.a = {0, 0, 0, 0};
        if (i % 4 == 1) a.b = {0, 0, 0, 0};
        if (i % 4 == 2) a.c = a.d; // from straight above
        if (i % 4 == 3) a.b = {-a.c[0], -a.c[1], -a.c[2], 0};
        if (i % 3 == 0) a.a[3] = 0.0f;
        in.push_back(a);
    }
    for (const Results& r : runFunction(FN_REJITTER, in))
        for (int c = 0; c < 2; c++)
        {
            CHECK(r.first[c] >= 0.5f);
            CHECK(r.first[c] <= 2.0f);
        }
}
