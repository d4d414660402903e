#include "weights.h"
#include "lobes.h"

namespace nrdtest
{
double smooth01(double x)
{
    const double t = saturated(x);
    return t * t * (3.0 - 2.0 * t);
}

double soft(double x)
{
    const double root = saturated(1.0 - x * x);
    return root * root;
}

double heavy(double x) { return 1.0 / (1.0 + 3.0 * x + 9.0 * x * x); }

double ramp(double a, double b, double x)
{
    if (a == b) return x > a ? 1.0 : 0.0;
    return saturated((x - a) / (b - a));
}

std::array<double, 4> bilinearWeights(const glm::dvec2& position)
{
    const glm::dvec2 f = glm::fract(position - 0.5);
    return {(1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y};
}

double customBilinear(const std::array<double, 4>& values, const std::array<double, 4>& weights)
{
    double sum = 0.0, weightSum = 0.0;
    for (size_t i = 0; i < 4; i++)
    {
        sum += values[i] * weights[i];
        weightSum += weights[i];
    }
    return weightSum < 1e-4 ? 0.0 : sum / weightSum;
}

CatmullRom catmullRom(const glm::dvec2& position)
{
    const glm::dvec2 centre = glm::floor(position - 0.5) + 0.5, t = position - centre, t2 = t * t, t3 = t2 * t;
    const glm::dvec2 w0 = 0.5 * (-t3 + 2.0 * t2 - t), w1 = 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0);
    const glm::dvec2 w2 = 0.5 * (-3.0 * t3 + 4.0 * t2 + t), w3 = 0.5 * (t3 - t2), inner = w1 + w2;
    const double sum = inner.x * inner.y + inner.x * (w0.y + w3.y) + inner.y * (w0.x + w3.x);
    return {{inner.x * w0.y / sum, w0.x * inner.y / sum, inner.x * inner.y / sum, w3.x * inner.y / sum,
             inner.x * w3.y / sum},
            centre + w2 / inner};
}

double hitDistWeight(double centre, double other, double inverseWidth, double least)
{
    return least + heavy(std::abs(other - centre) / (other + centre + 1e-6) * inverseWidth);
}

double roughnessWeight(double a, double b, double fraction, double sensitivity)
{
    const double m = a * a;
    return soft(std::abs(b * b - m) / lerp(sensitivity, 1.0, lerp(m * m, m, saturated(fraction))));
}

double angleConfidence(double angle, double explained, double forgiven)
{
    return smooth01((smooth01(1.0 - (angle - explained) / forgiven) - 0.05) / 0.9);
}

// As the shader's: within 0.005 of the arc tangent.
double angleOf(double tangent)
{
    if (tangent <= 1.0) return tangent / (1.0 + 0.28 * tangent * tangent);
    return 1.57079632679489662 - tangent / (tangent * tangent + 0.28);
}

double normalCutoff(double roughness, double share, double least)
{
    return std::max(angleOf(lobeTangent(roughness, share)), least);
}

EdgeStops edgeStops(const StopSettings& s, const StopInput& in)
{
    const double settled = saturated(in.frames / 5.0);
    double cone;
    if (in.isSpecular)
    {
        const double narrowing = 10.0 - 9.0 * settled * lerp(1.0, in.confidence, s.normalRelaxation);
        cone = std::atan(lobeTangent(in.roughness, s.lobeAngle)) * narrowing + s.lobeAngleSlack;
    }
    else
    {
        const double own = s.lobeAngle / std::sqrt(std::ldexp(1.0, in.step));
        cone = std::atan(lobeTangent(1.0, lerp(0.99, lerp(own, 0.99, saturated(in.doubt * s.normalDoubt)), settled)));
    }
    EdgeStops stops;
    stops.normal = 1.0 / std::clamp(cone, s.encodingError, 1.5708);
    stops.roughness = in.isSpecular && s.hasRoughnessStop
                          ? 1.0 / lerp(0.01, 1.0, saturated(in.roughness * s.roughnessFraction))
                          : 0.0;
    stops.plane = 1.0 / (s.depthThreshold * in.viewZ);
    stops.maxLuma = s.maxLuma;
    stops.relax = in.isSpecular && in.step <= 2 ? lerp(1.0, in.confidence, s.lumaRelaxation) : 1.0;
    stops.relax *= lerp(0.1, 1.0, settled) * (1.0 - saturated(in.doubt * s.lumaDoubt));
    return stops;
}

double edgeWeight(const EdgeStops& stops, double distance, double angle, double roughnessDifference)
{
    return soft(distance * stops.plane) * soft(angle * stops.normal) * soft(roughnessDifference * stops.roughness);
}

double lumaStop(double centre, double other, double inverseWidth, double cap, double relax)
{
    return std::exp(-std::min(std::abs(other - centre) * inverseWidth, cap) * relax);
}
} // namespace nrdtest
