// Hit distances over random input.
#include "catch.h"
#include "functions.h"
#include "hit_distance.h"
#include "lobes.h"
#include "sweep.h"

using namespace nrdtest;

namespace
{
HitDistanceRange rangeOf(const Arguments& in) { return {in.b[0], in.b[1], in.b[2]}; }

// a = hit distance, viewZ, roughness; b = A, B, C.
Arguments drawHit(Random& random)
{
    Arguments in;
    in.a = {random.anything(1e-6, 1e6), static_cast<float>(random.logarithmic(1e-3, 1e6)), random.roughness()};
    if (random.coin()) in.a[1] = -in.a[1];
    in.b = toVec4(random.logarithmic(1e-3, 1e3), random.logarithmic(1e-3, 1.0), random.logarithmic(1.0, 100.0));
    if (random.oneIn(256)) in.b = {}; // constants that were forgotten
    return in;
}

// mix(C, 1, spread) cancels down to 1.
double magnitudeOf(const Arguments& in, double value) { return value * std::max(1.0, double{in.b[2]}); }

const Sweep kSweeps[] = {
    {"spread of a lobe", "ulp of 1", 12.0,
     "3 + 2 x 0.5 ulp of exp2 of the bulk; a power: 3 + 2 x 5 ulp of exp2, of 1/8", FN_LOBE_SPREAD,
     [](Random& random) {
         return Arguments{{random.roughness(), 0.5f}};
     },
     [](const Arguments& in, const Results& out) { return ulps(out.first[0], lobeSpread(in.a[0], 0.5), 1.0); }},
    {"normalised hit distances, of anything", "ulp of C times the value", 12.0,
     "2.5 ulp of a division, 4 sums and products, the spread's", FN_NORM_HIT_DIST, drawHit,
     [](const Arguments& in, const Results& out)
     {
         const double expected = normalizedHitDistance(in.a[0], in.a[1], rangeOf(in), in.a[2]);
         return ulps(out.first[0], expected, magnitudeOf(in, expected));
     }},
    {"hit distances from normalised ones", "ulp of C times the value", 12.0, "5 sums and products, the spread's",
     FN_HIT_DIST,
     [](Random& random)
     {
         Arguments in = drawHit(random);
         in.a[0] = static_cast<float>(random.unit());
         return in;
     },
     [](const Arguments& in, const Results& out)
     {
         const double expected = in.a[0] * hitDistanceRange(in.a[1], rangeOf(in), in.a[2]);
         return ulps(out.first[0], expected, magnitudeOf(in, expected));
     }},
    {"nearest of four hit distances, and what is trimmed, of anything", "ulp", 0.0, "chosen", FN_AVERAGING,
     [](Random& random)
     {
         Arguments in;
         for (float& x : in.a) x = random.oneIn(4) ? 0.0f : random.anything(1e-6, 1e6);
         return in;
     },
     [](const Arguments& in, const Results& out)
     {
         const double nearest = nearestHitDistance(in.a), trimmed = trimmedHitDistance(in.a[0], 0.5);
         return std::max(ulps(out.first[0], nearest), ulps(out.first[1], trimmed));
     }},
};
} // namespace

TEST_CASE("hit distances over random input, ugly and not, agree with double precision", "[gpu][sweep]")
{
    for (const Sweep& sweep : kSweeps) check(sweep);
}
