#include "inputs.h"
#include "catch.h"
#include "replay_camera.h"
#include <algorithm>
#include <cmath>

namespace test
{
using sample::Channel;

namespace
{
Texels interleave(const sample::Planes& planes, Channel first, int count)
{
    Texels result(planes.pixelCount() * 4, 0.0f);
    for (int c = 0; c < count && planes.has(sample::next(first, c)); c++)
        for (size_t i = 0; i < planes.pixelCount(); i++) result[i * 4 + size_t(c)] = planes[sample::next(first, c)][i];
    return result;
}

float quantise(double value, double steps)
{
    return static_cast<float>(std::round(std::clamp(value, 0.0, 1.0) * steps) / steps);
}

// NRD_FrontEnd_PackNormalAndRoughness for R10_G10_B10_A2_UNORM, written from its description.
void packGuides(const float* guide, float* packed)
{
    const double sum = std::abs(double(guide[0])) + std::abs(double(guide[1])) + std::abs(double(guide[2]));
    const double x = double(guide[0]) / sum, y = double(guide[1]) / sum;
    const double r = std::max(double(guide[3]), 1.5 / 512.0) * (guide[2] < 0.0f ? -1.0 : 1.0);
    packed[0] = quantise(0.5 * (x + y) + 0.5, 1023.0);
    packed[1] = quantise(0.5 * (y - x) + 0.5, 1023.0);
    packed[2] = quantise(0.5 * r + 0.5, 1023.0);
}

double range(double z, double roughness, const nrd::HitDistanceParameters& p)
{
    const double spread = (1.0 - std::exp2(-200.0 * roughness * roughness)) * std::sqrt(roughness);
    return (double(p.A) + std::abs(z) * double(p.B)) * (double(p.C) * (1.0 - spread) + spread);
}

void packSignal(const float* signal, double range, float* packed)
{
    const float r = signal[0], g = signal[1], b = signal[2];
    packed[0] = 0.25f * r + 0.5f * g + 0.25f * b;
    packed[1] = 0.5f * (r - b);
    packed[2] = 0.5f * g - 0.25f * (r + b);
    const bool isMiss = signal[3] >= sample::kHitDistMiss;
    packed[3] = isMiss ? 1.0f : static_cast<float>(std::min(double(signal[3]) / range, 1.0));
}

using Matrix = float[16];
std::array<double, 4> transform(const Matrix& m, const std::array<double, 4>& v)
{
    std::array<double, 4> result = {};
    for (size_t row = 0; row < 4; row++)
        for (size_t column = 0; column < 4; column++) result[row] += double(m[column * 4 + row]) * v[column];
    return result;
}

// World position of a view-space one: the matrices are rigid.
std::array<double, 4> toWorld(const Matrix& worldToView, const std::array<double, 4>& view)
{
    std::array<double, 4> result = {0.0, 0.0, 0.0, 1.0};
    for (size_t i = 0; i < 3; i++)
        for (size_t row = 0; row < 3; row++)
            result[i] += double(worldToView[i * 4 + row]) * (view[row] - double(worldToView[12 + row]));
    return result;
}
} // namespace

nrd::DoctorFrame FrameInputs::view() const
{
    nrd::DoctorFrame frame;
    frame.common = common;
    frame.normalEncoding = normalEncoding;
    frame.hitDistanceParameters = hitDistanceParameters;
    frame.viewZ = viewZ.data();
    frame.motion = motion.data();
    frame.normalRoughness = normalRoughness.data();
    frame.diffuse = diffuse.data();
    frame.specular = specular.data();
    frame.diffuseFactor = diffuseFactor.data();
    frame.specularFactor = specularFactor.data();
    frame.specularDirection = specularDirection.data();
    return frame;
}

void FrameInputs::pack()
{
    normalRoughness.assign(pixelCount() * 4, 0.0f);
    diffuse = specular = normalRoughness;
    for (size_t i = 0; i < pixelCount() * 4; i += 4)
    {
        packGuides(&guides[i], &normalRoughness[i]);
        packSignal(&diffuseSignal[i], range(double(viewZ[i]), 1.0, hitDistanceParameters), &diffuse[i]);
        packSignal(&specularSignal[i], range(double(viewZ[i]), double(guides[i + 3]), hitDistanceParameters),
                   &specular[i]);
    }
}

std::vector<FrameInputs> readInputs(const std::filesystem::path& folder, size_t first, size_t count)
{
    const sample::Capture capture = sample::Capture::open(folder);
    std::vector<FrameInputs> frames;
    for (size_t i = first; i < std::min(first + count, capture.info().frames.size()); i++)
    {
        const sample::Planes planes = capture.readFrame(i);
        FrameInputs frame;
        frame.common = sample::commonSettingsOf(capture.info(), i);
        frame.hitDistanceParameters = sample::hitDistanceParametersOf(capture.info());
        frame.width = static_cast<size_t>(planes.width);
        frame.height = static_cast<size_t>(planes.height);
        frame.viewZ = interleave(planes, Channel::ViewZ, 1);
        frame.motion = interleave(planes, Channel::MotionX, 3);
        frame.guides = interleave(planes, Channel::NormalX, 4);
        frame.diffuseSignal = interleave(planes, Channel::DiffuseR, 4);
        frame.specularSignal = interleave(planes, Channel::SpecularR, 4);
        frame.diffuseFactor = interleave(planes, Channel::DiffuseFactorR, 3);
        frame.specularFactor = interleave(planes, Channel::SpecularFactorR, 3);
        frame.specularDirection = interleave(planes, Channel::SpecularDX, 3);
        frame.pack();
        frames.push_back(std::move(frame));
    }
    return frames;
}

void toScreenMotion(std::vector<FrameInputs>& frames)
{
    for (FrameInputs& frame : frames)
    {
        nrd::CommonSettings& common = frame.common;
        const Matrix& clip = common.viewToClipMatrix;
        for (size_t i = 0; i < frame.pixelCount(); i++)
        {
            const double u = (double(i % frame.width) + 0.5 + double(common.cameraJitter[0])) / double(frame.width);
            const double v = (double(i / frame.width) + 0.5 + double(common.cameraJitter[1])) / double(frame.height);
            const double z = double(frame.viewZ[i * 4]);
            const double w = double(clip[11]) * z;
            const std::array<double, 4> view = {(2.0 * u - 1.0) * w / double(clip[0]),
                                                (1.0 - 2.0 * v) * w / double(clip[5]), z, 1.0};
            std::array<double, 4> world = toWorld(common.worldToViewMatrix, view);
            for (size_t c = 0; c < 3; c++) world[c] += double(frame.motion[i * 4 + c]);
            const std::array<double, 4> viewPrev = transform(common.worldToViewMatrixPrev, world);
            const std::array<double, 4> clipPrev = transform(common.viewToClipMatrixPrev, viewPrev);
            frame.motion[i * 4] = static_cast<float>(0.5 + 0.5 * clipPrev[0] / clipPrev[3] - u);
            frame.motion[i * 4 + 1] = static_cast<float>(0.5 - 0.5 * clipPrev[1] / clipPrev[3] - v);
            frame.motion[i * 4 + 2] = static_cast<float>(viewPrev[2] - z);
        }
        common.isMotionVectorInWorldSpace = false;
    }
}

Texels enlarge(const Texels& image, const FrameInputs& frame, size_t width, size_t height, size_t x, size_t y)
{
    Texels result(width * height * 4, std::nanf(""));
    for (size_t row = 0; row < frame.height; row++)
        std::copy_n(image.begin() + static_cast<std::ptrdiff_t>(row * frame.width * 4), frame.width * 4,
                    result.begin() + static_cast<std::ptrdiff_t>(((row + y) * width + x) * 4));
    return result;
}

void roundToHalf(Texels& texels)
{
    for (float& value : texels)
    {
        int exponent = 0;
        const float mantissa = std::frexp(value, &exponent);
        value = std::ldexp(std::round(mantissa * 2048.0f), exponent - 11);
    }
}

Diagnosis diagnose(const std::vector<FrameInputs>& frames)
{
    nrd::InputDoctor doctor;
    for (const FrameInputs& frame : frames)
    {
        INFO(doctor.GetLastMessage());
        REQUIRE(doctor.AddFrame(frame.view()) == nrd::Result::SUCCESS);
    }
    const nrd::Finding* findings = nullptr;
    uint32_t count = 0;
    REQUIRE(doctor.GetFindings(findings, count) == nrd::Result::SUCCESS);
    Diagnosis result;
    for (uint32_t i = 0; i < count; i++)
        result.entries.push_back({findings[i].rule, findings[i].slot, findings[i].text});
    return result;
}

std::string Diagnosis::text() const
{
    std::string result;
    for (const Entry& entry : entries) result += std::string(toString(entry.rule)) + ": " + entry.text + '\n';
    return result;
}

bool Diagnosis::has(nrd::DoctorRule rule) const
{
    for (const Entry& entry : entries)
        if (entry.rule == rule) return true;
    return false;
}
} // namespace test
