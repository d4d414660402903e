// Noise of a known mean converges to it, without bias and flicker.
#include "catch.h"
#include "harness.h"
#include "noise.h"
#include <cmath>
#include <cstdio>

using namespace quality;

namespace
{
struct Statistics
{
    double mean = 0.0;
    double deviation = 0.0; // of pixels from the true mean
    double flicker = 0.0;   // mean change against the frame before
};

Statistics measure(const Signal& signal, const Signal& before, const Guides& guides, double expected)
{
    Statistics s;
    double count = 0.0;
    for (size_t i = 0; i < signal.size(); i++)
    {
        if (guides.viewZ[i] > kDenoisingRange) continue;
        s.mean += signal[i].x;
        s.deviation += (signal[i].x - expected) * (signal[i].x - expected);
        s.flicker += std::abs(signal[i].x - before[i].x);
        count += 1.0;
    }
    return {s.mean / count, std::sqrt(s.deviation / count), s.flicker / count};
}

Statistics runNoise(float speed, bool isSpecular)
{
    constexpr int kWidth = 128, kHeight = 80;
    Harness harness(kWidth, kHeight);
    Signal before(kWidth * kHeight, glm::vec4(0.0f));
    Statistics last;
    for (int frame = 0; frame < 40; frame++)
    {
        const Frame input{renderGuides(makeCamera(frame, speed, kWidth, kHeight), kWidth, kHeight),
                          makeNoise(kWidth * kHeight, 1.0f, unsigned(2 * frame)),
                          makeNoise(kWidth * kHeight, 1.0f, unsigned(2 * frame + 1))};
        harness.denoise(input);
        const Signal& out = isSpecular ? harness.specular() : harness.diffuse();
        last = measure(out, before, input.guides, 1.0);
        before = out;
    }
    return last;
}
} // namespace

TEST_CASE("white noise converges to its mean", "[gpu]")
{
    for (const float speed : {0.0f, 0.02f})
    {
        for (const bool isSpecular : {false, true})
        {
            const Statistics s = runNoise(speed, isSpecular);
            std::printf("FIGURE %s noise at speed %g: mean %.4f, deviation %.4f, flicker %.4f\n",
                        isSpecular ? "specular" : "diffuse", double(speed), s.mean, s.deviation, s.flicker);
            CHECK(std::abs(s.mean - 1.0) < 0.02);
            CHECK(s.deviation < (isSpecular ? 0.2 : 0.05)); // the input's is 1
            CHECK(s.flicker < (isSpecular ? 0.05 : 0.02));
        }
    }
}

TEST_CASE("the same input gives the same bits twice", "[gpu]")
{
    constexpr int kWidth = 80, kHeight = 48;
    Signal results[2];
    for (Signal& result : results)
    {
        Harness harness(kWidth, kHeight);
        for (int frame = 0; frame < 6; frame++)
        {
            harness.denoise({renderGuides(makeCamera(frame, 0.05f, kWidth, kHeight), kWidth, kHeight),
                             makeNoise(kWidth * kHeight, 1.0f, unsigned(frame)),
                             makeNoise(kWidth * kHeight, 1.0f, unsigned(frame + 50))});
        }
        result = harness.specular();
    }
    CHECK(results[0] == results[1]);
}
