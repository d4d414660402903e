// What the replay tool puts into SH and directional slots, and what it makes of them, against the formulas in C++.
#include "catch.h"
#include "packing_bench.h"

#include "replay_camera.h"
#include "shaders/replay_modes.h"

#include <cmath>

using namespace sample;
using namespace sample::test;

namespace
{
// Surface to camera, in world space, of the jittered pixel: what unprojecting two depths gives.
Vec3 viewVector(const CaptureInfo& info, size_t pixel, double viewZ)
{
    const CaptureFrame& frame = info.frames[0];
    const Matrix &p = frame.viewToClip, &v = frame.worldToView;
    const double u = (static_cast<double>(pixel % kWidth) + 0.5 + frame.jitter[0]) / kWidth;
    const double w = (static_cast<double>(pixel / kWidth) + 0.5 + frame.jitter[1]) / kHeight;
    const double clipW = p[11] * viewZ;
    const Vec3 view = {((2.0 * u - 1.0) * clipW - p[8] * viewZ) / p[0], ((1.0 - 2.0 * w) * clipW - p[9] * viewZ) / p[5],
                       viewZ};
    Vec3 world = {};
    for (size_t i = 0; i < 3; i++)
        for (size_t row = 0; row < 3; row++) world[i] -= v[i * 4 + row] * view[row];
    return normalized(world);
}

double normHitDist(const CaptureInfo& info, const Planes& frame, size_t i, bool isDiffuse)
{
    const double distance = frame[isDiffuse ? Channel::DiffuseHitDist : Channel::SpecularHitDist][i];
    if (distance >= kHitDistMiss) return 1.0;
    const double roughness = isDiffuse ? 1.0 : frame[Channel::Roughness][i];
    return std::min(1.0, distance / hitDistanceNormalization(info, frame[Channel::ViewZ][i], roughness));
}

double power5(double x) { return x * x * x * x * x; }

double clamp01(double x) { return std::min(1.0, std::max(0.0, x)); }

struct Surface
{
    Vec3 N, V;
    double roughness;
};

Vec3 halfVector(const Vec3& a, const Vec3& b) { return normalized({a[0] + b[0], a[1] + b[1], a[2] + b[2]}); }

double productIntegral(const Vec3& u1, double s1, const Vec3& u2, double s2)
{
    const Vec3 sum = {s1 * u1[0] + s2 * u2[0], s1 * u1[1] + s2 * u2[1], s1 * u1[2] + s2 * u2[2]};
    const double d = std::sqrt(dot(sum, sum));
    return 2.0 * M_PI * std::exp(d - s1 - s2) * (1.0 - std::exp(-2.0 * d)) / d;
}

// Luma of the resolved lobe whose colour has luma 1 and whose light comes from L.
double resolvedDiffuse(const Surface& s, const Vec3& L)
{
    const double NoV = clamp01(std::abs(dot(s.N, s.V))), NoL = clamp01(dot(s.N, L));
    const double VoH = clamp01(dot(s.V, halfVector(s.V, L)));
    const double e = 2.0 * VoH * VoH * s.roughness - 0.5;
    const double burley = (1.0 + e * power5(1.0 - NoL)) * (1.0 + e * power5(1.0 - NoV)) / M_PI;
    const double fit = 1.5 + (0.6 - 1.5) * s.roughness;
    const double y = 2.0 * productIntegral(L, 2.0, s.N, 2.0) * burley * (1.0 + (fit - 1.0) * power5(1.0 - NoV));
    return std::max(y, 1.0 / M_PI);
}

double resolvedSpecular(const Surface& s, const Vec3& L)
{
    const double r = std::max(s.roughness, 0.05), m2 = std::pow(r, 4.0), sharpness = 2.0 / m2;
    const double NoL = clamp01(dot(s.N, L)), NoV = 0.02 + 0.98 * clamp01(std::abs(dot(s.N, s.V)));
    const double VoH = clamp01(dot(s.V, halfVector(s.V, L)));
    const double G =
        0.5 / (NoV * std::sqrt(NoL * NoL * (1.0 - m2) + m2) + NoL * std::sqrt(NoV * NoV * (1.0 - m2) + m2));
    const double fit = (0.1 + 0.3 * m2) + (0.8 - (0.1 + 0.3 * m2)) * NoV;
    const double y = sharpness * productIntegral(L, sharpness, L, 0.5 / std::max(m2 * VoH, 1e-8)) * G * NoL * fit;
    return std::max(y, 1.0 / M_PI);
}
} // namespace

TEST_CASE("the view frustum of a frame projects back to where its rays came from", "[unit]")
{
    for (double sign : {1.0, -1.0})
    {
        const Matrix m = makeInfo(sign).frames[0].viewToClip;
        const std::array<double, 4> f = frustumOf(m);
        for (const auto& [u, v] : {std::pair(0.0, 0.0), std::pair(1.0, 1.0), std::pair(0.3, 0.8)})
        {
            const double z = 7.0 * sign, x = (f[0] + u * f[2]) * z, y = (f[1] + v * f[3]) * z;
            const double clipX = m[0] * x + m[8] * z, clipY = m[5] * y + m[9] * z, clipW = m[11] * z;
            CHECK(0.5 + 0.5 * clipX / clipW == Approx(u).margin(1e-12));
            CHECK(0.5 - 0.5 * clipY / clipW == Approx(v).margin(1e-12));
        }
    }
    Matrix ortho = {};
    ortho[0] = ortho[5] = 0.1;
    ortho[10] = ortho[15] = 1.0;
    CHECK(frustumOf(ortho) == std::array<double, 4>{0.0, 0.0, 0.0, 0.0});
}

TEST_CASE("SH slots hold YCoCg with hit distance, and the direction times luma", "[gpu]")
{
    PackingBench bench(1.0);
    for (const ShLobe& lobe : kShLobes)
    {
        const std::vector<float> sh0 = bench.copy(lobe.sh0), sh1 = bench.copy(lobe.sh1);
        for (size_t i = 0; i < bench.frame.pixelCount(); i++)
        {
            const Vec3 rgb = pixelOf(bench.frame, lobe.radiance, i);
            const Vec3 direction = pixelOf(bench.frame, lobe.direction, i);
            const double expected[] = {luma(rgb), 0.5 * (rgb[0] - rgb[2]), 0.5 * rgb[1] - 0.25 * (rgb[0] + rgb[2]),
                                       normHitDist(bench.info, bench.frame, i, lobe.isDiffuse)};
            for (size_t c = 0; c < 4; c++)
                CHECK(sh0[i * 4 + c] == Approx(expected[c]).epsilon(kHalfError).margin(1e-5));
            for (size_t c = 0; c < 3; c++)
                CHECK(sh1[i * 4 + c] == Approx(direction[c] * luma(rgb)).epsilon(kHalfError).margin(1e-5));
            CHECK(sh1[i * 4 + 3] == 0.0f);
        }
    }
}

TEST_CASE("an extracted SH signal is what was packed", "[gpu]")
{
    PackingBench bench(1.0);
    for (const ShLobe& lobe : kShLobes)
    {
        engine::Image sh0 = bench.pack(lobe.sh0), sh1 = bench.pack(lobe.sh1);
        const std::vector<float> values = bench.unpack(sh0, sh1, REPLAY_UNPACK_EXTRACT, lobe.isDiffuse);
        for (size_t i = 0; i < bench.frame.pixelCount(); i++)
        {
            const Vec3 rgb = pixelOf(bench.frame, lobe.radiance, i);
            for (size_t c = 0; c < 3; c++) CHECK(values[i * 4 + c] == Approx(rgb[c]).margin(8.0 * kHalfError));
            CHECK(values[i * 4 + 3] == Approx(normHitDist(bench.info, bench.frame, i, lobe.isDiffuse)).margin(1e-3));
        }
    }
}

TEST_CASE("a resolved SH signal uses the pixel's normal, roughness and view vector", "[gpu]")
{
    for (double sign : {1.0, -1.0})
    {
        PackingBench bench(sign);
        for (const ShLobe& lobe : kShLobes)
        {
            engine::Image sh0 = bench.pack(lobe.sh0), sh1 = bench.pack(lobe.sh1);
            const auto sg = bench.unpack(sh0, sh1, REPLAY_UNPACK_RESOLVE_SG, lobe.isDiffuse);
            const auto sh = bench.unpack(sh0, sh1, REPLAY_UNPACK_RESOLVE_SH, true);
            size_t count = 0;
            for (size_t i = 0; i < bench.frame.pixelCount(); i++)
            {
                const Surface s = {pixelOf(bench.frame, Channel::NormalX, i),
                                   viewVector(bench.info, i, bench.frame[Channel::ViewZ][i]),
                                   bench.frame[Channel::Roughness][i]};
                const Vec3 L = pixelOf(bench.frame, lobe.direction, i), rgb = pixelOf(bench.frame, lobe.radiance, i);
                const double scale = lobe.isDiffuse ? resolvedDiffuse(s, L) : resolvedSpecular(s, L);
                CHECK(luma({sg[i * 4], sg[i * 4 + 1], sg[i * 4 + 2]}) == Approx(scale * luma(rgb)).epsilon(0.01));
                count += scale > 0.32; // not the lower bound, which knows no surface
                const double harmonic = std::max(0.0, (1.0 + 3.0 * dot(L, s.N)) / M_PI);
                CHECK(luma({sh[i * 4], sh[i * 4 + 1], sh[i * 4 + 2]}) ==
                      Approx(harmonic * luma(rgb)).epsilon(0.01).margin(0.02));
            }
            CHECK(count > bench.frame.pixelCount() / 8);
        }
    }
}

TEST_CASE("the directional slot holds the direction times hit distance, and gives the distance back", "[gpu]")
{
    PackingBench bench(1.0);
    engine::Image slot = bench.pack(nrd::ResourceType::IN_DIFF_DIRECTION_HITDIST);
    const std::vector<float> packed = bench.unpack(slot, slot, REPLAY_UNPACK_COPY, true);
    const std::vector<float> values = bench.unpack(slot, slot, REPLAY_UNPACK_REBLUR_DIRECTION_HITDIST, true);
    for (size_t i = 0; i < bench.frame.pixelCount(); i++)
    {
        const double h = normHitDist(bench.info, bench.frame, i, true);
        const Vec3 direction = pixelOf(bench.frame, Channel::DiffuseDX, i);
        for (size_t c = 0; c < 3; c++)
            CHECK(packed[i * 4 + c] == Approx(direction[c] * h).epsilon(kHalfError).margin(1e-5));
        CHECK(values[i * 4 + 3] == Approx(h).epsilon(kHalfError).margin(1e-5));
    }
}

TEST_CASE("constant slots hold the value given", "[gpu]")
{
    PackingBench bench(1.0);
    for (nrd::ResourceType type : {nrd::ResourceType::IN_DIFF_CONFIDENCE, nrd::ResourceType::IN_SPEC_CONFIDENCE,
                                   nrd::ResourceType::IN_DISOCCLUSION_THRESHOLD_MIX})
    {
        const std::vector<float> values = bench.copy(type);
        for (size_t i = 0; i < bench.frame.pixelCount(); i++) CHECK(values[i * 4] == 0.75f);
    }
}
