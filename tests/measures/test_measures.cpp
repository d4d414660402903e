#include "pictures.h"

#include <cmath>
#include <limits>

using namespace sample;
using namespace test;

TEST_CASE("identical pictures have no error in any measure", "[unit]")
{
    const Picture a = noise(40, 30, 3, 1, 5.0f);
    const Picture t = toneMapped(a);
    CHECK(psnr(t, t, {}) == kMaxPsnr);
    CHECK(rmse(t, t, {}) == 0.0);
    CHECK(ssim(t, t, {}) == Approx(1.0).epsilon(1e-6));
    CHECK(sample::flip(rangeCompressed(a), rangeCompressed(a), {}) == 0.0);
    CHECK(relMse(a, a, {}) == 0.0);
    CHECK(bias(a, a, {}) == 0.0);
    const Picture b = noise(40, 30, 3, 2);
    CHECK(flicker({a, b, a, b}, {}) == 0.0);
}

TEST_CASE("PSNR and RMSE of a constant difference are that difference", "[unit]")
{
    const Picture a = constant(9, 5, {0.5f, 0.5f, 0.5f});
    const Picture b = constant(9, 5, {0.6f, 0.4f, 0.5f});
    const double expected = std::sqrt(2.0 / 3.0) * 0.1;
    CHECK(rmse(a, b, {}) == Approx(expected).epsilon(1e-6));
    CHECK(psnr(a, b, {}) == Approx(-20.0 * std::log10(expected)).epsilon(1e-6));
    CHECK(psnr(constant(4, 4, {0.0f}), constant(4, 4, {1.0f}), {}) == Approx(0.0).margin(1e-9));
    CHECK(psnr(constant(4, 4, {0.5f}), constant(4, 4, {0.5f + 1e-7f}), {}) == kMaxPsnr); // capped
}

TEST_CASE("SSIM of two constants is the luminance term alone", "[unit]")
{
    const Picture a = constant(20, 20, {0.3f, 0.3f, 0.3f});
    const Picture b = constant(20, 20, {0.6f, 0.6f, 0.6f});
    const double c1 = 0.0001;
    const double expected = (2 * 0.3 * 0.6 + c1) / (0.3 * 0.3 + 0.6 * 0.6 + c1);
    CHECK(ssim(a, b, {}) == Approx(expected).epsilon(1e-4));
    CHECK(ssim(a, b, {}) == Approx(ssim(b, a, {})));
}

TEST_CASE("SSIM sees inverted structure as negative and uncorrelated structure as near 0", "[unit]")
{
    Picture a = noise(64, 64, 1, 3);
    Picture inverted = a;
    for (float& v : inverted.planes[0]) v = 1.0f - v;
    const Picture other = noise(64, 64, 1, 4);
    const auto gray = [](const Picture& p)
    {
        Picture rgb(p.width, p.height, 3);
        for (auto& plane : rgb.planes) plane = p.planes[0];
        return rgb;
    };
    CHECK(ssim(gray(a), gray(inverted), {}) < -0.8);
    CHECK(std::abs(ssim(gray(a), gray(other), {})) < 0.1);
}

TEST_CASE("relMSE is relative, has its floor, and leaves out the largest thousandth", "[unit]")
{
    // Reference 2, result 3: 1 / (4 + 0.01). Black reference: d^2 / 0.01.
    CHECK(relMse(constant(5, 5, {3.0f, 3.0f, 3.0f}), constant(5, 5, {2.0f, 2.0f, 2.0f}), {}) ==
          Approx(1.0 / 4.01).epsilon(1e-6));
    CHECK(relMse(constant(5, 5, {0.1f, 0, 0}), constant(5, 5, {0, 0, 0}), {}) == Approx(1.0 / 3.0).epsilon(1e-5));

    const Picture reference = constant(50, 40, {1.0f, 1.0f, 1.0f}); // 2000 pixels: 2 are left out
    Picture result = reference;
    for (size_t i = 0; i < 2; i++) result.planes[0][i * 777] = 1e6f;
    CHECK(relMse(result, reference, {}) == 0.0);
    result.planes[0][5] = 2.0f;
    CHECK(relMse(result, reference, {}) == Approx(1.0 / 1.01 / 3.0 / 1998.0).epsilon(1e-6));
    // Below 1000 pixels nothing is left out.
    Picture small = constant(10, 10, {1.0f, 1.0f, 1.0f});
    small.planes[1][7] = 2.0f;
    CHECK(relMse(small, constant(10, 10, {1.0f, 1.0f, 1.0f}), {}) == Approx(1.0 / 1.01 / 300.0).epsilon(1e-6));
}

TEST_CASE("bias is the relative difference of the means", "[unit]")
{
    CHECK(bias(constant(4, 4, {2, 2, 2}), constant(4, 4, {1, 1, 1}), {}) == Approx(1.0));
    CHECK(bias(constant(4, 4, {0.99f, 0.99f, 0.99f}), constant(4, 4, {1, 1, 1}), {}) == Approx(-0.01).epsilon(1e-4));
    CHECK(bias(constant(4, 4, {1, 1, 1}), constant(4, 4, {0, 0, 0}), {}) == 0.0);
}

TEST_CASE("flicker is change that the reference does not have", "[unit]")
{
    const Picture low = constant(6, 6, {0.2f});
    const Picture high = constant(6, 6, {0.5f});
    CHECK(flicker({high, low, high, low}, {}) == Approx(0.0).margin(1e-9)); // the scene asked for it
    CHECK(flicker({high, low, low, low}, {}) == Approx(0.3).epsilon(1e-5));
    CHECK(flicker({low, low, high, low}, {}) == Approx(0.3).epsilon(1e-5)); // and lag counts too
    CHECK(flicker({low, low, low, low}, {}) == 0.0);
}

TEST_CASE("pixels outside the mask do not count, whatever they hold", "[unit]")
{
    const int width = 48;
    const int height = 32;
    Mask mask(static_cast<size_t>(width) * height, 1);
    for (size_t i = 0; i < mask.size(); i++) mask[i] = i % width < 40;
    const Picture reference = noise(width, height, 3, 5);
    const Picture result = noise(width, height, 3, 6);
    Picture poisoned = result;
    for (auto& plane : poisoned.planes)
        for (size_t i = 0; i < plane.size(); i++)
            if (!mask[i]) plane[i] = i % 2 ? std::numeric_limits<float>::quiet_NaN() : 1e30f;
    CHECK(psnr(result, reference, mask) == psnr(poisoned, reference, mask));
    CHECK(ssim(result, reference, mask) == ssim(poisoned, reference, mask));
    CHECK(sample::flip(result, reference, mask) == sample::flip(poisoned, reference, mask));
    CHECK(relMse(result, reference, mask) == relMse(poisoned, reference, mask));
    CHECK(bias(result, reference, mask) == bias(poisoned, reference, mask));
    CHECK(flicker({poisoned, result, reference, reference}, mask) == 0.0);
    CHECK(psnr(result, reference, mask) != psnr(result, reference, {}));

    // A mask without pixels: no error, no division by 0.
    const Mask none(mask.size(), 0);
    CHECK(psnr(result, reference, none) == kMaxPsnr);
    CHECK(relMse(result, reference, none) == 0.0);
    CHECK(sample::flip(result, reference, none) == 0.0);
}

TEST_CASE("values that are not finite never make a measure so", "[unit]")
{
    const Picture reference = noise(32, 32, 3, 8);
    Picture result = reference;
    result.planes[0][17] = std::numeric_limits<float>::quiet_NaN();
    result.planes[1][18] = std::numeric_limits<float>::infinity();
    result.planes[2][19] = -5.0f;
    for (const double value :
         {psnr(toneMapped(result), toneMapped(reference), {}), ssim(toneMapped(result), toneMapped(reference), {}),
          sample::flip(rangeCompressed(result), rangeCompressed(reference), {}), relMse(result, reference, {}),
          bias(result, reference, {})})
        CHECK(std::isfinite(value));
}

TEST_CASE("more noise is worse in every measure", "[unit]")
{
    const Picture reference = constant(64, 64, {0.4f, 0.4f, 0.4f});
    double before[5] = {1e9, 1e9, 0.0, 0.0, 0.0};
    for (const float amplitude : {0.02f, 0.1f, 0.3f})
    {
        Picture result = reference;
        const Picture random = noise(64, 64, 3, 9, amplitude);
        for (size_t c = 0; c < 3; c++)
            for (size_t i = 0; i < result.pixelCount(); i++) result.planes[c][i] += random.planes[c][i];
        const double now[5] = {psnr(toneMapped(result), toneMapped(reference), {}),
                               ssim(toneMapped(result), toneMapped(reference), {}),
                               sample::flip(rangeCompressed(result), rangeCompressed(reference), {}),
                               relMse(result, reference, {}), bias(result, reference, {})};
        for (size_t i = 0; i < 5; i++)
        {
            INFO("measure " << i << ", amplitude " << amplitude);
            CHECK((i < 2 ? now[i] < before[i] : now[i] > before[i]));
            before[i] = now[i];
        }
    }
}
