// The normal's part put back into a blurred lobe, against lights integrated by brute force.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "lobes.h"
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

// What eight neighbours with normals within the given angle of the reference see, blurred into one record.
Record blurredAround(std::mt19937& rng, Pixel p, Vec3d reference, double degrees, const std::vector<double>& light,
                     const std::vector<Vec3d>& directions)
{
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Record blurred;
    for (int i = 0; i < 8; i++)
    {
        p.normal = tilted(rng, reference, unit(rng) * degrees);
        const Record r = gather(p, directions, light);
        blurred = {blurred.c0 + r.c0 / 8.0, sum(blurred.c1, scaled(r.c1, 1.0 / 8.0))};
    }
    return blurred;
}

struct Task
{
    std::vector<Arguments> resolve, restore; // one per pixel
    std::vector<double> truth;
};

// Pixels whose normal is tilted away from the mean of their neighbours', which differ by about as much.
Task makeTask(bool isDiffuse, double degrees)
{
    std::mt19937 rng(31);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double roughness[] = {0.35, 0.5, 0.7, 1.0};
    const std::vector<Vec3d> directions = spiral(2000);
    Task task;
    while (task.truth.size() < kPixels)
    {
        const std::vector<double> light = randomLight(rng, directions);
        const Vec3d reference = randomDirection(rng);
        Pixel p = {reference, tilted(rng, reference, 60.0 * unit(rng)), isDiffuse ? -1.0 : roughness[rng() % 4]};
        const Record r = blurredAround(rng, p, reference, degrees + 5.0, light, directions);
        if (r.c0 < 1e-3) continue;
        p.normal = tilted(rng, reference, degrees);
        task.truth.push_back(gather(p, directions, light).c0);
        task.resolve.push_back(
            {{float(r.c0), 0, 0, 0}, packed(r.c1), packed(p.normal, std::max(p.roughness, 0.0)), packed(p.view)});
        task.restore.push_back(task.resolve.back());
        (isDiffuse ? task.restore.back().d : task.restore.back().e) = packed(reference);
    }
    return task;
}

Errors measure(bool isDiffuse, double degrees)
{
    const Task task = makeTask(isDiffuse, degrees);
    const auto fixedLobe = runFunction(isDiffuse ? FN_SG_DIFFUSE : FN_SG_SPECULAR, task.resolve);
    const auto restored = runFunction(isDiffuse ? FN_RESTORE_DIFFUSE : FN_RESTORE_SPECULAR, task.restore);
    Errors e{};
    for (size_t i = 0; i < kPixels; i++)
    {
        // 1 bounds what a pixel that the light just misses adds: the mean is about the others.
        const double truth = task.truth[i];
        const auto relative = [&](double y) { return std::min(std::abs(y - truth) / truth, 1.0) / kPixels; };
        e.colour += relative(task.resolve[i].a[0]);
        e.fixedLobe += relative(fixedLobe[i].first[0]);
        e.restored += relative(restored[i].first[0]);
    }
    return e;
}

double sharpnessOf(double mu)
{
    mu = std::min(mu, 0.999);
    return mu * (3.0 - mu * mu) / (1.0 - mu * mu);
}

double irradiance(Vec3d light, Vec3d n)
{
    const double k = length(light), c = k > 0.0 ? dot(light, n) / k : 0.0;
    const double mean = k > 1e-3 ? 1.0 / std::tanh(k) - 1.0 / k : k / 3.0;
    const double second = k > 1e-3 ? 1.0 - 3.0 * mean / k : k * k / 15.0;
    return std::max(0.25 + 0.5 * mean * c + 5.0 / 32.0 * second * (3.0 * c * c - 1.0), 0.05);
}

// Of a record with c0 = 1.
double restoredDiffuse(Vec3d c1, Vec3d n, Vec3d reference)
{
    const double sharpness = sharpnessOf(length(c1)), mu = 2.0 / 3.0;
    const double lobe = std::min(mu * (3.0 - mu * mu) / (1.0 - mu * mu), sharpness);
    const Vec3d light = difference(scaled(normalized(c1), sharpness), scaled(reference, lobe));
    return std::clamp(irradiance(light, n) / irradiance(light, reference), 0.5, 2.0);
}

double restoredSpecular(Vec3d c1, const Pixel& p, Vec3d reference)
{
    const double sharpness = sharpnessOf(length(c1)), m2 = std::pow(std::max(p.roughness, 0.05), 4);
    const double nov = std::max(std::abs(dot(reference, p.view)), 0.1);
    const double lobe = std::min(0.25 / (m2 * nov) + 1.0, sharpness);
    const Vec3d turn =
        difference(dominantDirection(p.normal, p.view, p.roughness), dominantDirection(reference, p.view, p.roughness));
    const double d = length(sum(scaled(normalized(c1), sharpness), scaled(turn, lobe)));
    const auto logSinhc = [](double x) { return x + std::log(x > 1e-9 ? -std::expm1(-2.0 * x) / x : 2.0); };
    return std::exp(std::clamp(logSinhc(d) - logSinhc(sharpness), std::log(0.5), std::log(2.0)));
}
} // namespace

TEST_CASE("restoring agrees with double precision", "[gpu]")
{
    std::mt19937 rng(33);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Arguments> diffuse, specular;
    std::vector<std::array<double, 2>> expected;
    for (int i = 0; i < 2000; i++)
    {
        const Vec3d view = randomDirection(rng), reference = tilted(rng, view, 80.0 * unit(rng));
        const Pixel p = {tilted(rng, reference, 40.0 * unit(rng)), view, 0.05 + 0.95 * unit(rng)};
        // A third about as wide as the lobe itself, where next to nothing is left for the light.
        const double mu = i % 3 == 0 ? 2.0 / 3.0 + 0.02 * unit(rng) : unit(rng);
        const Vec3d c1 = scaled(i % 3 == 0 ? tilted(rng, reference, unit(rng)) : randomDirection(rng), mu);
        diffuse.push_back({Vec4{1, 0, 0, 0}, packed(c1), packed(p.normal), packed(reference)});
        specular.push_back(
            {Vec4{1, 0, 0, 0}, packed(c1), packed(p.normal, p.roughness), packed(view), packed(reference)});
        expected.push_back({restoredDiffuse(c1, p.normal, reference), restoredSpecular(c1, p, reference)});
    }
    const auto d = runFunction(FN_RESTORE_DIFFUSE, diffuse), s = runFunction(FN_RESTORE_SPECULAR, specular);
    for (size_t i = 0; i < expected.size(); i++)
    {
        CHECK(d[i].first[0] == Approx(expected[i][0]).epsilon(2e-4));
        CHECK(s[i].first[0] == Approx(expected[i][1]).epsilon(2e-3)); // sharpness 2000 from floats of mean cosine
    }
}

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

TEST_CASE("the reference normal is the mean over the normals that are blurred together", "[gpu]")
{
    const auto leaning = [](double angle, double viewZ) {
        return packed({std::sin(angle), 0.0, std::cos(angle)}, viewZ);
    };
    const Vec4 z = leaning(0.0, 10.0);
    const auto lean = [&](Vec4 left, Vec4 right, float roughness)
    {
        const Arguments in = {{}, {}, {0, 0, 1, roughness}, z, left, right, z, z};
        return double(runFunction(FN_REFERENCE_NORMAL, in).first[0]);
    };
    CHECK(lean(leaning(0.1, 10.0), leaning(-0.1, 10.0), 1.0f) == Approx(0.0).margin(1e-6));
    const double mean = std::atan2(std::sin(0.1), std::cos(0.1) + 4.0);
    CHECK(lean(leaning(0.1, 10.0), z, 1.0f) == Approx(std::sin(mean)).margin(1e-6));
    // The tolerance is 0.2 per roughness, down to mirrors.
    for (const double roughness : {1.0, 0.3, 0.03})
        for (const double share : {0.98, 1.02})
            CHECK((lean(leaning(0.2 * roughness * share, 10.0), z, float(roughness)) > 1e-4) == (share < 1.0));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Vec4& edge : {leaning(0.1, 11.0), leaning(0.1, nan), leaning(kPi, 10.0)})
        CHECK(lean(edge, z, 1.0f) == Approx(0.0).margin(1e-6));
}
