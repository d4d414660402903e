#include "pictures.h"

#include "sequence.h"

#include <cmath>
#include <limits>

using namespace sample;
using namespace test;

namespace
{
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

CaptureInfo makeInfo()
{
    CaptureInfo info;
    info.width = 4;
    info.height = 1;
    info.denoisingRange = 100.0;
    return info;
}

void setAll(Planes& planes, Channel first, int count, float value)
{
    for (int c = 0; c < count; c++) planes[next(first, c)].assign(planes.pixelCount(), value);
}

// Four pixels of a surface at depth 10 with every layer, and a reference in which nothing is 0.
Planes makeFrame()
{
    Planes frame(4, 1);
    setAll(frame, Channel::ViewZ, 1, -10.0f);
    setAll(frame, Channel::Roughness, 1, 0.3f);
    setAll(frame, Channel::DiffuseR, 3, 1.0f);
    setAll(frame, Channel::DiffuseHitDist, 1, 2.0f);
    setAll(frame, Channel::SpecularR, 3, 2.0f);
    setAll(frame, Channel::SpecularHitDist, 1, 2.0f);
    setAll(frame, Channel::ShadowDist, 1, kHitDistMiss);
    setAll(frame, Channel::ShadowR, 3, 0.5f);
    setAll(frame, Channel::DiffuseFactorR, 3, 0.25f);
    setAll(frame, Channel::SpecularFactorR, 3, 0.125f);
    setAll(frame, Channel::SunR, 3, 8.0f);
    setAll(frame, Channel::DirectR, 3, 16.0f);
    return frame;
}

Planes makeReference()
{
    Planes reference(4, 1);
    setAll(reference, Channel::RefDiffuseR, 3, 1.5f);
    setAll(reference, Channel::RefDiffuseNormHitDist, 1, 0.5f);
    setAll(reference, Channel::RefSpecularR, 3, 2.5f);
    setAll(reference, Channel::RefShadowV, 1, 0.75f);
    setAll(reference, Channel::RefShadowR, 3, 0.625f);
    setAll(reference, Channel::RefComposedR, 3, 7.0f);
    return reference;
}

SignalSet setOf(std::initializer_list<Signal> signals)
{
    SignalSet set = {};
    for (Signal s : signals) set[static_cast<size_t>(s)] = true;
    return set;
}

float composedOf(std::initializer_list<Signal> produced)
{
    const Planes frame = makeFrame();
    Signals signals = noisySignals(frame, makeInfo(), setOf(produced));
    compose(signals, frame, referenceSignals(makeReference(), frame));
    return signals.has(Signal::Composed) ? signals[Signal::Composed].planes[0][0] : kNan;
}
} // namespace

TEST_CASE("hit distances are normalised as the front end does", "[unit]")
{
    const CaptureInfo info = makeInfo();
    CHECK(hitDistanceNormalization(info, 10.0, 1.0) == Approx(4.0));
    CHECK(hitDistanceNormalization(info, 10.0, 0.0) == Approx(80.0));
    CHECK(hitDistanceNormalization(info, 10.0, 0.3) == Approx(38.37324).epsilon(1e-5));
    CHECK(hitDistanceNormalization(info, -100.0, 0.1) == Approx(201.41881).epsilon(1e-5));
}

TEST_CASE("no sample is 0, a miss and the sky are 1, NaN is no sample", "[unit]")
{
    Planes frame = makeFrame();
    frame[Channel::DiffuseHitDist] = {0.0f, kHitDistMiss, 2.0f, kNan};
    Signals signals = noisySignals(frame, makeInfo(), setOf({Signal::NormHitDist, Signal::SpecularNormHitDist}));
    CHECK(signals[Signal::NormHitDist].planes[0] == std::vector<float>{0.0f, 1.0f, 0.5f, 0.0f});
    CHECK(signals[Signal::SpecularNormHitDist].planes[0][0] == Approx(0.05212).epsilon(1e-3));
    frame[Channel::ViewZ][0] = 2000.0f;
    signals = noisySignals(frame, makeInfo(), setOf({Signal::NormHitDist}));
    CHECK(signals[Signal::NormHitDist].planes[0][0] == 1.0f);
}

TEST_CASE("a shadow ray is through or not, whatever it crossed", "[unit]")
{
    Planes frame = makeFrame();
    frame[Channel::ShadowDist] = {0.0f, 3.0f, kHitDistMiss, 65472.0f};
    const Signals signals = noisySignals(frame, makeInfo(), setOf({Signal::Shadow, Signal::Translucency}));
    CHECK(signals[Signal::Shadow].planes[0] == std::vector<float>{0.0f, 0.0f, 1.0f, 0.0f});
    CHECK(signals[Signal::Translucency].planes[1][0] == 0.5f);
    CHECK_FALSE(signals.has(Signal::Diffuse)); // not asked for
}

TEST_CASE("the composed picture takes from the reference what the denoiser does not produce", "[unit]")
{
    // direct 16 + sun 8 * shadow + diffuse * 0.25 + specular * 0.125; noisy 1, 2, V 1, RGB 0.5; reference 1.5, 2.5,
    // 0.625.
    CHECK(composedOf({Signal::Diffuse, Signal::Specular}) == 16.0f + 8.0f * 0.625f + 0.25f + 0.25f);
    CHECK(composedOf({Signal::Diffuse}) == 16.0f + 8.0f * 0.625f + 0.25f + 2.5f * 0.125f);
    CHECK(composedOf({Signal::Shadow}) == 16.0f + 8.0f * 1.0f + 1.5f * 0.25f + 2.5f * 0.125f);
    CHECK(composedOf({Signal::Shadow, Signal::Translucency}) == 16.0f + 8.0f * 0.5f + 1.5f * 0.25f + 2.5f * 0.125f);
    CHECK(std::isnan(composedOf({Signal::NormHitDist}))); // hit distances alone make no picture
}

TEST_CASE("the reference is composed of its own signals, or taken as recorded where one is missing", "[unit]")
{
    const Planes frame = makeFrame();
    const Signals whole = referenceSignals(makeReference(), frame);
    CHECK(whole[Signal::Composed].planes[2][3] == 16.0f + 8.0f * 0.625f + 1.5f * 0.25f + 2.5f * 0.125f);
    Planes reference = makeReference();
    for (int c = 0; c < 4; c++) reference[next(Channel::RefSpecularR, c)].clear();
    const Signals partial = referenceSignals(reference, frame);
    CHECK(partial[Signal::Composed].planes[2][3] == 7.0f);
    // Then a denoiser that has no specular either composes nothing, instead of something wrong.
    Signals signals = noisySignals(frame, makeInfo(), setOf({Signal::Diffuse}));
    compose(signals, frame, partial);
    CHECK_FALSE(signals.has(Signal::Composed));
}

TEST_CASE("sky pixels count in the composed picture only", "[unit]")
{
    Planes frame = makeFrame();
    frame[Channel::ViewZ][3] = -1000.0f;
    const Mask mask = surfaceMask(frame, 100.0);
    CHECK(mask == Mask{1, 1, 1, 0});
    const Signals reference = referenceSignals(makeReference(), frame);
    Signals result = reference;
    for (Picture& picture : result.pictures)
        for (auto& plane : picture.planes) plane[3] += 1.0f; // wrong in the sky pixel only
    const Comparable a = makeComparable(result);
    const Comparable b = makeComparable(reference);
    const FrameMeasures m = measureFrame({a, b, mask}, nullptr);
    CHECK(*m[static_cast<size_t>(Signal::Composed)].psnr < kMaxPsnr);
    CHECK(*m[static_cast<size_t>(Signal::Diffuse)].psnr == kMaxPsnr);
    CHECK(*m[static_cast<size_t>(Signal::Diffuse)].flip == 0.0);
    CHECK(*m[static_cast<size_t>(Signal::NormHitDist)].rmse == 0.0);
    CHECK(*m[static_cast<size_t>(Signal::Shadow)].rmse == 0.0);
    CHECK_FALSE(m[static_cast<size_t>(Signal::Shadow)].flip);
    CHECK_FALSE(m[static_cast<size_t>(Signal::SpecularNormHitDist)].psnr); // the reference has none
    CHECK_FALSE(m[static_cast<size_t>(Signal::Composed)].flicker);         // no frame before
}

TEST_CASE("specular occlusion is measured where the references have it, without the sky", "[unit]")
{
    Planes frame = makeFrame();
    frame[Channel::ViewZ][3] = -1000.0f;
    Planes reference = makeReference();
    setAll(reference, Channel::RefSpecularNormHitDist, 1, 0.25f);
    Signals noisy = noisySignals(frame, makeInfo(), setOf({Signal::SpecularNormHitDist}));
    const Signals expected = referenceSignals(reference, frame);
    REQUIRE(noisy.has(Signal::SpecularNormHitDist));
    noisy[Signal::SpecularNormHitDist].planes[0] = {0.25f, 0.25f, 0.55f, 1.0f};
    const Comparable a = makeComparable(noisy), b = makeComparable(expected);
    const Mask mask = surfaceMask(frame, 100.0);
    Signals steady = noisy;
    steady[Signal::SpecularNormHitDist].planes[0] = {0.25f, 0.25f, 0.25f, 0.0f};
    const Comparable before = makeComparable(steady);
    const MeasuredFrame frameBefore{before, b, mask};
    const SignalMeasures m = measureFrame({a, b, mask}, &frameBefore)[static_cast<size_t>(Signal::SpecularNormHitDist)];
    CHECK(*m.rmse == Approx(0.3 / std::sqrt(3.0)));
    CHECK(*m.psnr == Approx(-20.0 * std::log10(0.3 / std::sqrt(3.0))));
    CHECK(*m.flicker == Approx(0.1));
}

TEST_CASE("a mean is over the frames that have the measure", "[unit]")
{
    FrameMeasures a, b;
    a[0].psnr = 10.0;
    b[0].psnr = 20.0;
    b[0].flicker = 0.5;
    const FrameMeasures mean = meanOf({a, b});
    CHECK(*mean[0].psnr == 15.0);
    CHECK(*mean[0].flicker == 0.5);
    CHECK_FALSE(mean[0].ssim);
    CHECK_FALSE(mean[1].psnr);
}

TEST_CASE("a sequence measures extracted colours on their own", "[unit]")
{
    const Planes frame = makeFrame(), reference = makeReference();
    const CaptureInfo info = makeInfo();
    const SignalSet produced = setOf({Signal::Diffuse});
    const Signals resolved = referenceSignals(reference, frame); // perfect
    Signals extracted = noisySignals(frame, info, produced);
    SequenceMeasurer measurer(info, produced);
    for (size_t i = kFirstMeanFrame; i < kFirstMeanFrame + 2; i++)
        measurer.add(i, frame, reference, &resolved, &extracted);
    const size_t s = static_cast<size_t>(Signal::Diffuse), composed = static_cast<size_t>(Signal::Composed);
    CHECK(*measurer.meanDenoised()[s].psnr == kMaxPsnr);
    CHECK(*measurer.meanExtracted()[s].psnr == *measurer.meanNoisy()[s].psnr);
    CHECK(*measurer.meanExtracted()[composed].flicker == 0.0);
    CHECK(*measurer.meanExtracted()[composed].psnr < kMaxPsnr);
    SequenceMeasurer plain(info, produced);
    plain.add(kFirstMeanFrame, frame, reference, &resolved);
    CHECK_FALSE(plain.meanExtracted()[composed].psnr);
}
