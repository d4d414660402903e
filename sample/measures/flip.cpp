#include "flip.h"
#include "filter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sample
{
namespace
{
using Color = std::array<float, 3>;
using Planes3 = std::array<Plane, 3>;

constexpr double kPi = 3.14159265358979323846;

using Matrix3 = std::array<std::array<double, 3>, 3>;

// Linear sRGB to CIE XYZ, D65.
constexpr Matrix3 kRgbToXyz = {{
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0},
}};

// Cofactors over the determinant.
constexpr Matrix3 inverse(const Matrix3& m)
{
    Matrix3 result = {};
    double determinant = 0.0;
    for (size_t i = 0; i < 3; i++)
    {
        for (size_t j = 0; j < 3; j++)
        {
            const size_t r1 = (j + 1) % 3, r2 = (j + 2) % 3, c1 = (i + 1) % 3, c2 = (i + 2) % 3;
            result[i][j] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
        }
        determinant += m[0][i] * result[i][0];
    }
    for (auto& row : result)
        for (double& v : row) v /= determinant;
    return result;
}
constexpr Matrix3 kXyzToRgb = inverse(kRgbToXyz);
constexpr double whiteOf(size_t row) { return kRgbToXyz[row][0] + kRgbToXyz[row][1] + kRgbToXyz[row][2]; }
constexpr double kWhite[3] = {whiteOf(0), whiteOf(1), whiteOf(2)};

// The paper's constants: exponents, and the point (kRemapError * max, kRemapValue) of the error remapping.
constexpr float kColorExponent = 0.7f;
constexpr float kFeatureExponent = 0.5f;
constexpr float kRemapError = 0.4f;
constexpr float kRemapValue = 0.95f;
constexpr double kFeatureWidth = 0.082; // degrees

// Contrast sensitivity as sums of Gaussians, (a, b) each, in cycles per degree; only the blue-yellow one has two terms.
struct GaussianTerm
{
    double a;
    double b;
};
constexpr GaussianTerm kAchromatic = {1.0, 0.0047};
constexpr GaussianTerm kRedGreen = {1.0, 0.0053};
constexpr GaussianTerm kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};

Color multiply(const Matrix3& m, const Color& v)
{
    Color result = {};
    for (size_t i = 0; i < 3; i++) result[i] = static_cast<float>(m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2]);
    return result;
}

Color toYCxCz(const Color& rgb)
{
    Color xyz = multiply(kRgbToXyz, rgb);
    for (size_t i = 0; i < 3; i++) xyz[i] /= static_cast<float>(kWhite[i]);
    return {116.0f * xyz[1] - 16.0f, 500.0f * (xyz[0] - xyz[1]), 200.0f * (xyz[1] - xyz[2])};
}

Color toLinear(const Color& yCxCz)
{
    const float y = (yCxCz[0] + 16.0f) / 116.0f;
    Color xyz = {y + yCxCz[1] / 500.0f, y, y - yCxCz[2] / 200.0f};
    for (size_t i = 0; i < 3; i++) xyz[i] *= static_cast<float>(kWhite[i]);
    return multiply(kXyzToRgb, xyz);
}

float labCurve(float t)
{
    constexpr float kDelta = 6.0f / 29.0f;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
}

// CIELAB with the Hunt effect: colours of dark patches look less chromatic.
Color toHuntLab(const Color& rgb)
{
    Color f = multiply(kRgbToXyz, rgb);
    for (size_t i = 0; i < 3; i++) f[i] = labCurve(f[i] / static_cast<float>(kWhite[i]));
    const float lightness = 116.0f * f[1] - 16.0f;
    return {lightness, 0.01f * lightness * 500.0f * (f[0] - f[1]), 0.01f * lightness * 200.0f * (f[1] - f[2])};
}

float hyab(const Color& a, const Color& b)
{
    const float da = a[1] - b[1];
    const float db = a[2] - b[2];
    return std::abs(a[0] - b[0]) + std::sqrt(da * da + db * db);
}

// The largest error there is, between green and blue.
float maxColorError()
{
    static const float error = std::pow(hyab(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), kColorExponent);
    return error;
}

// One term of a contrast-sensitivity filter along one axis; the amplitude is in the other factor.
Kernel csfKernel(const GaussianTerm& term, int radius, double pixelsPerDegree)
{
    Kernel kernel;
    for (int x = -radius; x <= radius; x++)
    {
        const double degrees = x / pixelsPerDegree;
        kernel.push_back(static_cast<float>(std::exp(-kPi * kPi * degrees * degrees / term.b)));
    }
    return kernel;
}

double sumOf(const Kernel& kernel)
{
    double sum = 0.0;
    for (float w : kernel) sum += w;
    return sum;
}

Kernel scaled(Kernel kernel, double factor)
{
    for (float& w : kernel) w = static_cast<float>(w * factor);
    return kernel;
}

struct CsfFilter
{
    std::array<Kernel, 2> luma;                      // achromatic, red-green, each of sum 1
    std::array<std::array<Kernel, 2>, 2> blueYellow; // two terms, horizontal and vertical, of sum 1 together
};

CsfFilter makeCsfFilter(double pixelsPerDegree)
{
    // Three standard deviations of the widest Gaussian.
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(kBlueYellow[0].b / (2.0 * kPi * kPi)) * pixelsPerDegree));
    CsfFilter filter;
    const GaussianTerm single[2] = {kAchromatic, kRedGreen};
    for (size_t i = 0; i < 2; i++)
    {
        const Kernel kernel = csfKernel(single[i], radius, pixelsPerDegree);
        filter.luma[i] = scaled(kernel, 1.0 / sumOf(kernel));
    }
    double total = 0.0;
    for (size_t i = 0; i < 2; i++)
    {
        const Kernel kernel = csfKernel(kBlueYellow[i], radius, pixelsPerDegree);
        const double amplitude = kBlueYellow[i].a * std::sqrt(kPi / kBlueYellow[i].b);
        filter.blueYellow[i] = {scaled(kernel, amplitude), kernel};
        total += amplitude * sumOf(kernel) * sumOf(kernel);
    }
    for (auto& term : filter.blueYellow) term[0] = scaled(term[0], 1.0 / total);
    return filter;
}

Planes3 toYCxCzPlanes(const Picture& rgb)
{
    Planes3 result;
    for (Plane& plane : result) plane.resize(rgb.pixelCount());
    for (size_t i = 0; i < rgb.pixelCount(); i++)
    {
        const Color color = toYCxCz({rgb.planes[0][i], rgb.planes[1][i], rgb.planes[2][i]});
        for (size_t c = 0; c < 3; c++) result[c][i] = color[c];
    }
    return result;
}

// What the eye resolves at this distance, as Hunt-adjusted Lab.
Planes3 perceived(const Planes3& yCxCz, int width, int height, const CsfFilter& filter)
{
    Planes3 result;
    for (size_t c = 0; c < 2; c++) result[c] = convolve(yCxCz[c], width, height, filter.luma[c], filter.luma[c]);
    result[2] = convolve(yCxCz[2], width, height, filter.blueYellow[0][0], filter.blueYellow[0][1]);
    const Plane second = convolve(yCxCz[2], width, height, filter.blueYellow[1][0], filter.blueYellow[1][1]);
    for (size_t i = 0; i < second.size(); i++)
    {
        Color rgb = toLinear({result[0][i], result[1][i], result[2][i] + second[i]});
        for (float& v : rgb) v = std::clamp(v, 0.0f, 1.0f);
        const Color lab = toHuntLab(rgb);
        for (size_t c = 0; c < 3; c++) result[c][i] = lab[c];
    }
    return result;
}

// Errors above a large share of the maximum are compressed into what is left of [0; 1].
float remapColorError(float error)
{
    const float maximum = maxColorError();
    const float e = std::pow(error, kColorExponent);
    const float knee = kRemapError * maximum;
    if (e < knee) return e * kRemapValue / knee;
    return std::min(1.0f, kRemapValue + (e - knee) / (maximum - knee) * (1.0f - kRemapValue));
}

// Positive and negative weights are normalised separately, to 1 and -1.
Kernel balanced(Kernel kernel)
{
    double positive = 0.0;
    double negative = 0.0;
    for (float w : kernel) (w > 0.0f ? positive : negative) += std::abs(w);
    for (float& w : kernel) w = static_cast<float>(w / (w > 0.0f ? positive : negative));
    return kernel;
}

struct FeatureFilter
{
    Kernel smooth; // Gaussian
    Kernel edge;   // its first derivative
    Kernel point;  // its second derivative
};

FeatureFilter makeFeatureFilter(double pixelsPerDegree)
{
    const double sigma = 0.5 * kFeatureWidth * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    FeatureFilter filter{gaussian(sigma, radius), {}, {}};
    for (int x = -radius; x <= radius; x++)
    {
        const double g = std::exp(-0.5 * x * x / (sigma * sigma));
        filter.edge.push_back(static_cast<float>(-x * g));
        filter.point.push_back(static_cast<float>((x * x / (sigma * sigma) - 1.0) * g));
    }
    filter.edge = balanced(filter.edge);
    filter.point = balanced(filter.point);
    return filter;
}

// Length of the gradient made by a derivative kernel along each axis.
Plane gradient(const Plane& luma, int width, int height, const Kernel& derivative, const Kernel& smooth)
{
    Plane x = convolve(luma, width, height, derivative, smooth);
    const Plane y = convolve(luma, width, height, smooth, derivative);
    for (size_t i = 0; i < x.size(); i++) x[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
    return x;
}

struct Features
{
    Plane edges;
    Plane points;
};

Features detectFeatures(const Plane& y, int width, int height, const FeatureFilter& filter)
{
    Plane luma(y.size());
    for (size_t i = 0; i < y.size(); i++) luma[i] = (y[i] + 16.0f) / 116.0f;
    return {gradient(luma, width, height, filter.edge, filter.smooth),
            gradient(luma, width, height, filter.point, filter.smooth)};
}
} // namespace

std::vector<float> flipMap(const Picture& reference, const Picture& test, double pixelsPerDegree)
{
    const int width = reference.width;
    const int height = reference.height;
    const CsfFilter csf = makeCsfFilter(pixelsPerDegree);
    const FeatureFilter featureFilter = makeFeatureFilter(pixelsPerDegree);
    std::array<Planes3, 2> colors = {toYCxCzPlanes(reference), toYCxCzPlanes(test)};
    std::array<Features, 2> features;
    for (size_t p = 0; p < 2; p++)
    {
        features[p] = detectFeatures(colors[p][0], width, height, featureFilter);
        colors[p] = perceived(colors[p], width, height, csf);
    }
    std::vector<float> errors(reference.pixelCount());
    for (size_t i = 0; i < errors.size(); i++)
    {
        const float color = remapColorError(hyab({colors[0][0][i], colors[0][1][i], colors[0][2][i]},
                                                 {colors[1][0][i], colors[1][1][i], colors[1][2][i]}));
        const float edge = std::abs(features[0].edges[i] - features[1].edges[i]);
        const float point = std::abs(features[0].points[i] - features[1].points[i]);
        const float feature = std::pow(std::max(edge, point) / std::sqrt(2.0f), kFeatureExponent);
        errors[i] = std::pow(color, 1.0f - std::min(feature, 1.0f));
    }
    return errors;
}
} // namespace sample
