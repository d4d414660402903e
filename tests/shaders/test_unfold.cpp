// The unfolded space of primary surface replacement, by rays that are traced through mirrors in double precision.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "vectors.h"

using namespace nrdtest;

namespace
{
struct Mirror
{
    Vec3d hit, normal;
};

// Two mirrors and a surface, as a ray from the camera finds them.
struct Chain
{
    Vec3d camera, direction; // of the ray as it leaves the camera
    Mirror first, second;
    Vec3d lastDirection, surface;
    double length; // of the whole way
};

Vec4 packed(const Vec3d& v) { return {float(v[0]), float(v[1]), float(v[2]), 0.0f}; }
Vec3d unpacked(const Vec4& v) { return {v[0], v[1], v[2]}; }
Vec3d reflected(const Vec3d& v, const Vec3d& normal) { return v - normal * (2.0 * glm::dot(v, normal)); }

Chain randomChain(std::mt19937& rng)
{
    std::uniform_real_distribution<double> length(0.2, 5.0);
    Chain c;
    c.camera = randomDirection(rng) * length(rng);
    c.direction = randomDirection(rng);
    const double lengths[] = {length(rng), length(rng), length(rng)};
    c.first = {c.camera + c.direction * lengths[0], tilted(rng, -c.direction, 60.0)};
    const Vec3d between = reflected(c.direction, c.first.normal);
    c.second = {c.first.hit + between * lengths[1], tilted(rng, -between, 40.0)};
    c.lastDirection = reflected(between, c.second.normal);
    c.surface = c.second.hit + c.lastDirection * lengths[2];
    c.length = lengths[0] + lengths[1] + lengths[2];
    return c;
}

// What the ray from the camera to `seen` meets after as long a way with both mirrors in it.
Vec3d follow(const Vec3d& camera, const Vec3d& seen, const Mirror& first, const Mirror& second)
{
    Vec3d origin = camera, direction = glm::normalize(seen - camera);
    double left = glm::length(seen - camera);
    for (const Mirror& mirror : {first, second})
    {
        const double t = glm::dot(mirror.hit - origin, mirror.normal) / glm::dot(direction, mirror.normal);
        origin += direction * t;
        direction = reflected(direction, mirror.normal);
        left -= t;
    }
    return origin + direction * left;
}

Arguments argumentsOf(const Chain& c)
{
    return {packed(c.surface),
            packed(c.first.hit),
            packed(c.first.normal),
            packed(c.second.hit),
            packed(c.second.normal),
            packed(c.lastDirection),
            {},
            packed(c.first.normal)};
}
} // namespace

TEST_CASE("what two mirrors show lies on the camera's ray, as far away as the whole way is long", "[gpu]")
{
    std::mt19937 rng(71);
    std::vector<Arguments> in;
    std::vector<Chain> chains;
    for (int i = 0; i < 1000; i++)
    {
        chains.push_back(randomChain(rng));
        in.push_back(argumentsOf(chains.back()));
    }
    const std::vector<Results> out = runFunction(FN_UNFOLD, in);
    for (size_t i = 0; i < in.size(); i++)
    {
        const Chain& c = chains[i];
        CHECK(glm::distance(unpacked(out[i].first), c.camera + c.direction * c.length) < 3e-5);
        CHECK(glm::distance(unpacked(out[i].second), c.direction) < 2e-6);
    }
}

TEST_CASE("normals in mirrors keep their angles, and one mirror swaps left and right", "[gpu]")
{
    // A mirror in the plane x = 2, as the second one a plane through the origin that leaves z alone.
    Arguments in;
    in.a = {1, 5, -7, 0};
    in.b = {2, 9, 9, 0};
    in.c = {-1, 0, 0, 0};
    in.e = {0, 1, 0, 0};
    in.f = {0.6f, 0, 0.8f, 0};
    const Results out = runFunction(FN_UNFOLD, in);
    // x: 1 is as far before the mirror as 3 behind it. y: the second mirror alone.
    CHECK(glm::distance(unpacked(out.first), Vec3d(3, -5, -7)) < 1e-6);
    CHECK(glm::distance(unpacked(out.second), Vec3d(-0.6, 0, 0.8)) < 1e-6);
}

TEST_CASE("motion in mirrors leads to where a ray of the frame before finds the surface", "[gpu]")
{
    std::mt19937 rng(72);
    std::vector<Arguments> in;
    std::vector<Chain> chains;
    for (int i = 0; i < 1000; i++)
    {
        chains.push_back(randomChain(rng));
        in.push_back(argumentsOf(chains.back()));
        in.back().f = packed(randomDirection(rng) * 0.1);
        in.back().g = packed(randomDirection(rng) * 0.1);
        in.back().h = packed(tilted(rng, chains.back().first.normal, 3.0));
    }
    const std::vector<Results> out = runFunction(FN_UNFOLD_MOTION, in);
    for (size_t i = 0; i < in.size(); i++)
    {
        const Chain& c = chains[i];
        const Vec3d seen = c.camera + c.direction * c.length + unpacked(out[i].first);
        const Mirror before = {c.first.hit + unpacked(in[i].g), glm::normalize(unpacked(in[i].h))};
        CHECK(glm::distance(follow(c.camera, seen, before, c.second), c.surface + unpacked(in[i].f)) < 1e-4);
    }
}

TEST_CASE("where nothing moves, nothing moves in mirrors", "[gpu]")
{
    std::mt19937 rng(73);
    std::vector<Arguments> in;
    for (int i = 0; i < 1000; i++)
    {
        in.push_back(argumentsOf(randomChain(rng)));
        in.back().f = {};
    }
    double worst = 0.0;
    for (const Results& r : runFunction(FN_UNFOLD_MOTION, in)) worst = std::max(worst, glm::length(unpacked(r.first)));
    CHECK(worst < 1e-6); // the two may be rounded differently; positions are up to 20
}

TEST_CASE("behind a bend the ray goes on straight", "[gpu]")
{
    std::mt19937 rng(74);
    std::uniform_real_distribution<double> length(0.2, 5.0), degrees(0.0, 150.0);
    std::vector<Arguments> in;
    std::vector<Vec3d> expected;
    for (int i = 0; i < 1000; i++)
    {
        const Vec3d hit = randomDirection(rng) * length(rng), from = randomDirection(rng);
        const Vec3d to = tilted(rng, from, degrees(rng));
        const double t = length(rng);
        in.push_back({packed(hit + to * t), packed(hit), packed(from), packed(to), {}, packed(to)});
        expected.push_back(hit + from * t);
    }
    const std::vector<Results> out = runFunction(FN_UNFOLD_BEND, in);
    for (size_t i = 0; i < in.size(); i++)
    {
        CHECK(glm::distance(unpacked(out[i].first), expected[i]) < 1e-4);
        CHECK(glm::distance(unpacked(out[i].second), unpacked(in[i].c)) < 2e-5);
    }
}
