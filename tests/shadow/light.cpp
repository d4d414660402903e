#include "light.h"
#include <algorithm>
#include <cmath>

namespace shadow
{
namespace
{
constexpr float kLit = 65504.0f;

// To the middle of the light, and two vectors across it as long as its radius.
struct Disc
{
    glm::vec3 middle, right, up;

    glm::vec3 at(glm::vec2 point) const { return middle + point.x * right + point.y * up; }
};

Disc discOf(const Light& light, glm::vec3 P)
{
    const glm::vec3 middle = light.isLocal ? light.position - P : light.direction;
    const glm::vec3 W = glm::normalize(middle);
    const glm::vec3 right =
        glm::normalize(glm::cross(W, std::abs(W.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    const float size = light.isLocal ? light.radius : light.tangent;
    return {middle, size * right, size * glm::cross(W, right)};
}

std::optional<Hit> cast(const Light& light, const Occluder& occluder, glm::vec3 P, glm::vec3 V, int frame)
{
    const std::optional<Hit> hit = occluder(P, V, frame);
    return hit && hit->share > 0.0f && (!light.isLocal || hit->share < 1.0f) ? hit : std::nullopt;
}

// As SIGMA_FrontEnd_PackPenumbra().
float penumbraOf(const Light& light, float distance, float toLight)
{
    const float width =
        light.isLocal ? light.radius * distance / std::max(toLight - distance, 1e-6f) : distance * light.tangent;
    return std::clamp(width, 1e-4f, 32768.0f);
}
// Rays V with g.V >= 0 are free: the border of a straight edge's shadow cuts the disc along a line.
double visibleShare(const Disc& disc, glm::dvec3 g)
{
    const double radius = std::hypot(glm::dot(g, glm::dvec3(disc.right)), glm::dot(g, glm::dvec3(disc.up)));
    const double u = glm::dot(g, glm::dvec3(disc.middle)) / std::max(radius, 1e-12);
    if (std::abs(u) >= 1.0) return u > 0.0 ? 1.0 : 0.0;
    return 1.0 - (std::acos(u) - u * std::sqrt(1.0 - u * u)) / M_PI;
}
} // namespace

Light makeSun(float elevation, float azimuth, float tangent)
{
    const float e = glm::radians(elevation), a = glm::radians(azimuth);
    return {false, {std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a)}, tangent, {}, 0.0f};
}

Light makeLamp(glm::vec3 position, float radius) { return {true, {}, 0.0f, position, radius}; }

Occluder makeEdge(float height, float x)
{
    return [=](glm::vec3 P, glm::vec3 V, int) -> std::optional<Hit>
    {
        const float share = (height - P.y) / V.y;
        if (!(share > 0.0f) || P.x + share * V.x >= x) return std::nullopt;
        return Hit{share};
    };
}

Occluder makeWall()
{
    return [](glm::vec3 P, glm::vec3 V, int) -> std::optional<Hit>
    {
        const float share = -P.z / V.z;
        if (!(share > 0.0f) || P.x + share * V.x >= 0.0f) return std::nullopt;
        return Hit{share};
    };
}

Occluder makeSphere(glm::vec3 centre, float radius)
{
    return [=](glm::vec3 P, glm::vec3 V, int) -> std::optional<Hit>
    {
        const glm::vec3 toP = P - centre;
        const float a = glm::dot(V, V), b = glm::dot(toP, V), c = glm::dot(toP, toP) - radius * radius;
        const float discriminant = b * b - a * c;
        if (discriminant < 0.0f || b > 0.0f) return std::nullopt;
        return Hit{std::max((-b - std::sqrt(discriminant)) / a, 1e-6f)};
    };
}

Occluder join(std::vector<Occluder> occluders)
{
    return [occluders](glm::vec3 P, glm::vec3 V, int frame)
    {
        std::optional<Hit> nearest;
        for (const Occluder& occluder : occluders)
        {
            const std::optional<Hit> hit = occluder(P, V, frame);
            if (!hit || !(hit->share > 0.0f)) continue;
            nearest = nearest ? Hit{std::min(nearest->share, hit->share), nearest->color * hit->color} : *hit;
        }
        return nearest;
    };
}

options::LightRay castRay(const Light& light, const Occluder& occluder, glm::vec3 P, glm::ivec2 pixel, int frame)
{
    const float radius = std::sqrt(random(pixel, frame, 1)), angle = 6.2831853f * random(pixel, frame, 2);
    const glm::vec3 V = discOf(light, P).at(radius * glm::vec2(std::cos(angle), std::sin(angle)));
    const std::optional<Hit> hit = cast(light, occluder, P, V, frame);
    if (!hit) return {kLit, glm::vec4(1.0f)};
    const float length = glm::length(V);
    return {penumbraOf(light, hit->share * length, length), {0.0f, hit->color}};
}

double visibleBesideEdge(const Light& light, float height, float x, glm::vec3 P)
{
    return visibleShare(discOf(light, P), glm::dvec3(height - P.y, P.x - x, 0.0));
}

double visibleBesideWall(const Light& light, glm::vec3 P)
{
    return P.z > 0.0f ? visibleShare(discOf(light, P), glm::dvec3(P.z, 0.0, -P.x)) : 1.0;
}

glm::dvec4 meanOf(const Light& light, const Occluder& occluder, glm::vec3 P, int frame)
{
    constexpr int kRays = 600;
    const Disc disc = discOf(light, P);
    glm::dvec4 sum(0.0);
    for (int i = 0; i < kRays; i++)
    {
        // Vogel's spiral: even over the disc.
        const float radius = std::sqrt((static_cast<float>(i) + 0.5f) / kRays),
                    angle = 2.3999632f * static_cast<float>(i);
        const glm::vec3 V = disc.at(radius * glm::vec2(std::cos(angle), std::sin(angle)));
        const std::optional<Hit> hit = cast(light, occluder, P, V, frame);
        sum += hit ? glm::dvec4(0.0, hit->color) : glm::dvec4(1.0);
    }
    return sum / static_cast<double>(kRays);
}

float random(glm::ivec2 pixel, int frame, uint32_t use)
{
    uint32_t x =
        static_cast<uint32_t>(pixel.x + 4096 * pixel.y) * 0x9E3779B9u + static_cast<uint32_t>(frame) * 0x85EBCA6Bu;
    x = (x ^ (use * 0xC2B2AE35u)) * 0x27D4EB2Fu;
    x = (x ^ (x >> 15)) * 0x2C1B3C6Du;
    x = (x ^ (x >> 12)) * 0x297A2D39u;
    return static_cast<float>((x ^ (x >> 15)) >> 8) * (1.0f / 16777216.0f);
}
} // namespace shadow
