// The normal's part put back into a blurred lobe, against lights integrated by brute force.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "reference_lobes.h"
#include <limits>

using namespace nrdtest;

namespace
{
Vec4 packed(Vec3d v, double w = 0.0) { return {float(v[0]), float(v[1]), float(v[2]), float(w)}; }

std::vector<Vec3d> spiral(size_t count)
{
    std::vector<Vec3d> directions;
    for (size_t i = 0; i < count; i++)
    {
        const double z = 1.0 - (2.0 * double(i) + 1.0) / double(count), phi = 2.39996323 * double(i);
        directions.push_back({std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z});
    }
    return directions;
}

// Ambient light with one to three round lights of 8 to 45 degrees radius.
std::vector<double> randomLight(std::mt19937& rng, const std::vector<Vec3d>& directions)
{
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double ambients[] = {0.0, 0.05, 0.3}, cosines[] = {0.99, 0.9, 0.7};
    std::vector<double> radiance(directions.size(), ambients[rng() % 3]);
    for (size_t n = 1 + rng() % 3; n > 0; n--)
    {
        const Vec3d axis = randomDirection(rng);
        const double c = cosines[rng() % 3], power = 3.0 * unit(rng) * unit(rng);
        for (size_t i = 0; i < directions.size(); i++)
            if (dot(directions[i], axis) > c) radiance[i] += power / (1.0 - c);
    }
    return radiance;
}

struct Pixel
{
    Vec3d normal, view;
    double roughness; // negative: diffuse
};

double lobeWeight(const Pixel& p, Vec3d l)
{
    const double nol = dot(p.normal, l);
    if (nol <= 0.0) return 0.0;
    if (p.roughness < 0.0) return nol;
    const double m2 = std::pow(p.roughness, 4), noh = dot(p.normal, normalized(sum(l, p.view)));
    const double t = noh * noh * (m2 - 1.0) + 1.0;
    return m2 / (t * t) * visibility(nol, std::max(dot(p.normal, p.view), 1e-3), m2) * nol;
}

struct Record
{
    double c0 = 0.0;
    Vec3d c1{};
};

// What a denoiser sees at the pixel: light times lobe, divided by what white light gives.
Record gather(const Pixel& p, const std::vector<Vec3d>& directions, const std::vector<double>& light)
{
    Record r;
    double white = 0.0;
    for (size_t i = 0; i < directions.size(); i++)
    {
        const double w = lobeWeight(p, directions[i]);
        white += w;
        r.c0 += w * light[i];
        r.c1 = sum(r.c1, scaled(directions[i], w * light[i]));
    }
    return {r.c0 / white, scaled(r.c1, 1.0 / white)};
}

constexpr size_t kPixels = 400;

struct Errors
{
    double colour, fixedLobe, restored; // mean relative errors
};

// A pixel whose normal is tilted away from its neighbours', which differ by half as much again.
Errors measure(bool isDiffuse, double degrees)
{
    std::mt19937 rng(31);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double roughness[] = {0.35, 0.5, 0.7, 1.0};
    const std::vector<Vec3d> directions = spiral(2000);
    std::vector<Arguments> in, restore;
    std::vector<double> truth;
    while (truth.size() < kPixels)
    {
        const std::vector<double> light = randomLight(rng, directions);
        const Vec3d reference = randomDirection(rng);
        Pixel p = {reference, tilted(rng, reference, 60.0 * unit(rng)), isDiffuse ? -1.0 : roughness[rng() % 4]};
        Record blurred;
        for (int i = 0; i < 8; i++)
        {
            p.normal = tilted(rng, reference, unit(rng) * (degrees + 5.0));
            const Record r = gather(p, directions, light);
            blurred = {blurred.c0 + r.c0 / 8.0, sum(blurred.c1, scaled(r.c1, 1.0 / 8.0))};
        }
        p.normal = tilted(rng, reference, degrees);
        if (blurred.c0 < 1e-3) continue;
        truth.push_back(gather(p, directions, light).c0);
        const double r = std::max(p.roughness, 0.0);
        in.push_back({{float(blurred.c0), 0, 0, 0}, packed(blurred.c1), packed(p.normal, r), packed(p.view)});
        restore.push_back(in.back());
        (isDiffuse ? restore.back().d : restore.back().e) = packed(reference);
    }
    const auto fixedLobe = runFunction(isDiffuse ? FN_SG_DIFFUSE : FN_SG_SPECULAR, in);
    const auto restored = runFunction(isDiffuse ? FN_RESTORE_DIFFUSE : FN_RESTORE_SPECULAR, restore);
    Errors e{};
    for (size_t i = 0; i < truth.size(); i++)
    {
        // 1 bounds what a pixel that the light just misses adds: the mean is about the others.
        const auto relative = [&](double y) { return std::min(std::abs(y - truth[i]) / truth[i], 1.0) / kPixels; };
        e.colour += relative(in[i].a[0]);
        e.fixedLobe += relative(fixedLobe[i].first[0]);
        e.restored += relative(restored[i].first[0]);
    }
    return e;
}
} // namespace

TEST_CASE("restoring a smooth surface's lobe changes nothing, whatever the light", "[gpu]")
{
    std::mt19937 rng(32);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Arguments> diffuse, specular;
    for (int i = 0; i < 1000; i++)
    {
        const Vec3d n = randomDirection(rng), v = tilted(rng, n, 89.0 * unit(rng));
        const Vec4 sh0 = {float(10.0 * unit(rng)), 0.1f, -0.1f, 0};
        const Vec4 c1 = packed(scaled(randomDirection(rng), sh0[0] * unit(rng)));
        diffuse.push_back({sh0, c1, packed(n), packed(n)});
        specular.push_back({sh0, c1, packed(n, unit(rng)), packed(v), packed(n)});
    }
    const auto colour = runFunction(FN_EXTRACT, diffuse);
    const auto d = runFunction(FN_RESTORE_DIFFUSE, diffuse), s = runFunction(FN_RESTORE_SPECULAR, specular);
    for (size_t i = 0; i < colour.size(); i++)
        for (int c = 0; c < 3; c++)
        {
            CHECK(d[i].first[c] == Approx(colour[i].first[c]).epsilon(1e-4).margin(1e-5));
            CHECK(s[i].first[c] == Approx(colour[i].first[c]).epsilon(1e-4).margin(1e-5));
        }
}

TEST_CASE("restoring the diffuse normal takes a third off the error and beats the fixed lobe", "[gpu]")
{
    for (const double degrees : {0.0, 5.0, 10.0, 20.0})
    {
        const Errors e = measure(true, degrees);
        UNSCOPED_INFO("tilt " << degrees << ": colour " << e.colour << ", fixed lobe " << e.fixedLobe << ", restored "
                              << e.restored);
        CHECK(e.restored <= e.colour * (degrees == 0.0 ? 1.0001 : 0.67));
        CHECK(e.restored < e.fixedLobe);
    }
}

TEST_CASE("restoring the specular normal lowers the error and beats the fixed lobe", "[gpu]")
{
    for (const double degrees : {0.0, 5.0, 10.0, 20.0})
    {
        const Errors e = measure(false, degrees);
        UNSCOPED_INFO("tilt " << degrees << ": colour " << e.colour << ", fixed lobe " << e.fixedLobe << ", restored "
                              << e.restored);
        CHECK(e.restored <= e.colour * (degrees == 0.0 ? 1.0001 : 0.85));
        CHECK(e.restored < e.fixedLobe);
    }
}

TEST_CASE("the reference normal is the mean over the same surface", "[gpu]")
{
    const Vec4 z = {0, 0, 1, 10}, x = {0.6f, 0, 0.8f, 10}, minusX = {-0.6f, 0, 0.8f, 10};
    const auto mean = [&](Vec4 left, Vec4 right) {
        return runFunction(FN_REFERENCE_NORMAL, {Vec4{}, Vec4{}, Vec4{0, 0, 1, 0}, z, left, right, z, z}).first;
    };
    CHECK(mean(x, minusX)[0] == Approx(0.0).margin(1e-6));
    const Vec3d expected = normalized({0.6, 0.0, 4.8});
    CHECK(mean(x, z)[0] == Approx(expected[0]).margin(1e-6));
    CHECK(mean(x, z)[2] == Approx(expected[2]).margin(1e-6));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Vec4& edge : {Vec4{0.6f, 0, 0.8f, 11}, Vec4{0.6f, 0, 0.8f, nan}, Vec4{0.6f, 0, -0.8f, 10}})
        CHECK(mean(edge, z)[0] == Approx(0.0).margin(1e-6));
}
