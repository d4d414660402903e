#include "environment.h"

#include <algorithm>
#include <cmath>

namespace sample
{
namespace
{
constexpr double kPi = 3.14159265358979323846;

double luminance(const glm::vec3& c) { return 0.2126 * double(c.r) + 0.7152 * double(c.g) + 0.0722 * double(c.b); }

float cleaned(float x) { return std::isfinite(x) ? std::clamp(x, 0.0f, 1e6f) : 0.0f; }

Environment finish(Environment environment)
{
    std::vector<double> weights(environment.radiance.size());
    glm::dvec3 sum(0.0);
    for (int y = 0; y < environment.height; ++y)
    {
        const double solidAngle = texelSolidAngle(environment.width, environment.height, y);
        for (int x = 0; x < environment.width; ++x)
        {
            const size_t i = size_t(y) * size_t(environment.width) + size_t(x);
            weights[i] = luminance(environment.radiance[i]) * solidAngle;
            sum += glm::dvec3(environment.radiance[i]) * solidAngle;
        }
    }
    environment.mean = glm::vec3(sum / (4.0 * kPi));
    environment.alias = buildAliasTable(weights);
    return environment;
}

// Elevation colours as of a clear afternoon; the sun is 5 degrees wide so that a texel of this picture can hold it.
glm::vec3 skyRadiance(const glm::vec3& d, const glm::vec3& sunDirection)
{
    if (d.y < 0.0f) return glm::mix(glm::vec3(0.30f, 0.28f, 0.25f), glm::vec3(0.12f), std::min(-2.0f * d.y, 1.0f));
    const glm::vec3 zenith(0.18f, 0.36f, 0.85f), horizon(0.85f, 0.88f, 0.92f);
    const glm::vec3 sky = glm::mix(horizon, zenith, std::pow(d.y, 0.5f));
    const float toSun = std::max(glm::dot(d, sunDirection), 0.0f);
    const glm::vec3 glow = glm::vec3(1.0f, 0.85f, 0.6f) * (0.4f * std::pow(toSun, 32.0f));
    const glm::vec3 sun = toSun > std::cos(0.0436f) ? glm::vec3(260.0f, 235.0f, 200.0f) : glm::vec3(0.0f);
    return sky + glow + sun;
}
} // namespace

double texelSolidAngle(int width, int height, int y)
{
    return 2.0 * kPi / width * (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height));
}

Environment makeEnvironment(const Image& picture)
{
    if (picture.width < 1 || picture.height < 1) throw FileError("the environment picture is empty");
    if (picture.width > 8192) throw FileError("the environment picture is wider than 8192 pixels");
    Environment environment;
    environment.width = picture.width;
    environment.height = picture.height;
    environment.radiance.resize(size_t(picture.width) * size_t(picture.height));
    for (size_t i = 0; i < environment.radiance.size(); ++i)
        for (int c = 0; c < 3; ++c) environment.radiance[i][c] = cleaned(picture.rgba[i * 4 + size_t(c)]);
    return finish(std::move(environment));
}

const glm::vec3 kDefaultSun = glm::normalize(glm::vec3(0.45f, 0.65f, 0.6f));

Environment makeSky(const glm::vec3& toSun)
{
    Environment environment;
    environment.width = 512;
    environment.height = 256;
    for (int y = 0; y < environment.height; ++y)
    {
        for (int x = 0; x < environment.width; ++x)
        {
            const double phi = ((x + 0.5) / environment.width - 0.5) * 2.0 * kPi;
            const double theta = (y + 0.5) / environment.height * kPi;
            const glm::dvec3 direction(std::sin(theta) * std::sin(phi), std::cos(theta),
                                       -std::sin(theta) * std::cos(phi));
            environment.radiance.push_back(skyRadiance(glm::vec3(direction), toSun));
        }
    }
    return finish(std::move(environment));
}

Environment rotated(const Environment& environment, float turns)
{
    Environment out = environment;
    const int width = environment.width;
    const int shift = int(std::lround(double(turns) * width) % width + width) % width;
    for (int y = 0; y < environment.height; ++y)
    {
        const auto row = out.radiance.begin() + std::ptrdiff_t(y) * width;
        std::rotate(row, row + (width - shift) % width, row + width);
    }
    return finish(std::move(out));
}

Environment makeUniformEnvironment(const glm::vec3& radiance)
{
    Environment environment;
    environment.width = 16;
    environment.height = 8;
    environment.radiance.assign(128, radiance);
    return finish(std::move(environment));
}
} // namespace sample
