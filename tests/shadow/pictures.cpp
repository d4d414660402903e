#include "pictures.h"
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace shadow
{
namespace
{
using Slot = nrd::ResourceType;
constexpr Slot kOut = Slot::OUT_SHADOW_TRANSLUCENCY;
constexpr float kEyeHeight = 2.0f;

quality::Guides renderFloor(const quality::Camera& camera, glm::ivec2 size, int)
{
    const auto trace = [](glm::vec3 origin, glm::vec3 direction)
    {
        const float distance = -origin.y / direction.y;
        return distance > 0.0f && distance < 60.0f ? quality::Hit{distance} : quality::Hit{};
    };
    return quality::renderGuides(camera, size.x, size.y, trace);
}

quality::Camera lookFrom(glm::vec3 position, glm::vec3 target, glm::vec3 up)
{
    quality::Camera camera;
    camera.position = position;
    camera.worldToView = glm::lookAtLH(position, target, up);
    return camera;
}
} // namespace

float pixelSizeOf(glm::ivec2 size) { return kVisibleMeters / static_cast<float>(size.y); }

options::Setup makeSetup(nrd::Denoiser denoiser, glm::ivec2 size, const Light& light, const Occluder& occluder)
{
    options::Setup setup;
    setup.denoiser = denoiser;
    setup.size = setup.rect = size;
    setup.hasLargeFormats = true;
    setup.projection = options::Projection::Orthographic;
    setup.camera = [](int) { return lookFrom({0, kEyeHeight, 0}, {0, 0, 0}, {0, 0, 1}); };
    setup.scene = renderFloor;
    setup.rayAt = [=](glm::vec3 P, glm::ivec2 pixel, int frame) { return castRay(light, occluder, P, pixel, frame); };
    setup.sigmaSettings.isLightLocal = light.isLocal;
    for (int i = 0; i < 3; i++)
    {
        setup.sigmaSettings.lightDirection[i] = light.isLocal ? 0.0f : light.direction[i];
        setup.sigmaSettings.lightPosition[i] = light.position[i];
    }
    return setup;
}

void hideLight(options::Setup& setup)
{
    setup.sigmaSettings.isLightLocal = false;
    for (float& v : setup.sigmaSettings.lightDirection) v = 0.0f;
}

void lookAlong(options::Setup& setup)
{
    setup.projection = options::Projection::Perspective;
    setup.camera = [](int) { return lookFrom({0, 1.5f, -4.0f}, {0, 0, 1.0f}, {0, 1, 0}); };
}

glm::vec4 shadowOf(const options::Result& result, size_t texel)
{
    const glm::vec4 root = result.outputs.at(kOut)[texel];
    return root * root;
}

glm::vec4 noisyOf(const options::Result& result, size_t pixel)
{
    const glm::vec4 root = result.frame.noisy.at(kOut)[pixel];
    return root * root;
}

namespace
{
template <class Visit> void forEachPosition(const options::Frame& frame, Visit&& visit)
{
    for (int y = 0; y < frame.rect.y; y++)
        for (int x = 0; x < frame.rect.x; x++)
            if (frame.isInRange(x, y)) visit(x, y, options::worldPosition(frame, x, y));
}

template <class Value> std::vector<double> profileOf(const options::Result& result, Rows rows, Value&& value)
{
    std::vector<double> profile(static_cast<size_t>(result.frame.rect.x), 0.0);
    for (int y = rows.first; y < rows.first + rows.count; y++)
        for (int x = 0; x < result.frame.rect.x; x++) profile[static_cast<size_t>(x)] += value(x, y) / rows.count;
    return profile;
}

double square(double x) { return x * x; }
} // namespace

Errors measureErrors(const options::Result& result, const Truth& truth)
{
    Errors sum = {0.0, 0.0};
    double count = 0.0;
    forEachPosition(result.frame,
                    [&](int x, int y, glm::vec3 P)
                    {
                        const double mean = truth(P);
                        sum.denoised += square(double(shadowOf(result, result.frame.texel(x, y)).x) - mean);
                        sum.noisy += square(double(noisyOf(result, result.frame.pixel(x, y)).x) - mean);
                        count += 1.0;
                    });
    return {std::sqrt(sum.denoised / count), std::sqrt(sum.noisy / count)};
}

std::vector<double> denoisedProfile(const options::Result& result, Rows rows)
{
    return profileOf(result, rows, [&](int x, int y) { return double(shadowOf(result, result.frame.texel(x, y)).x); });
}

std::vector<double> trueProfile(const options::Result& result, Rows rows, const Truth& truth)
{
    return profileOf(result, rows, [&](int x, int y) { return truth(options::worldPosition(result.frame, x, y)); });
}

double widthOf(const std::vector<double>& profile)
{
    const auto crossing = [&](double level)
    {
        for (size_t i = 1; i < profile.size(); i++)
            if (profile[i] >= level && profile[i - 1] < level)
                return double(i) - (profile[i] - level) / (profile[i] - profile[i - 1]);
        return 0.0;
    };
    return crossing(0.9) - crossing(0.1);
}
} // namespace shadow
