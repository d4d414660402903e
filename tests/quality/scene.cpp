#include "scene.h"
#include <glm/gtc/matrix_transform.hpp>
#include <nrd/settings.h>

namespace quality
{
namespace
{
struct Sphere
{
    glm::vec3 centre;
    float radius;
    float roughness;
};

constexpr Sphere kSpheres[] = {
    {{-2.2f, 1.0f, 6.0f}, 1.0f, 0.02f},
    {{0.0f, 0.8f, 5.0f}, 0.8f, 0.25f},
    {{2.0f, 1.2f, 7.0f}, 1.2f, 0.6f},
    {{0.7f, 0.3f, 3.5f}, 0.3f, 1.0f},
};

void intersectSphere(const Sphere& sphere, glm::vec3 origin, glm::vec3 direction, Hit& hit)
{
    const glm::vec3 toOrigin = origin - sphere.centre;
    const float b = glm::dot(toOrigin, direction);
    const float discriminant = b * b - glm::dot(toOrigin, toOrigin) + sphere.radius * sphere.radius;
    if (discriminant < 0.0f) return;
    const float distance = -b - std::sqrt(discriminant);
    if (distance <= 0.0f || distance >= hit.distance) return;
    hit = {distance, glm::normalize(toOrigin + direction * distance), sphere.roughness};
}

void intersectPlane(glm::vec3 normal, float offset, float roughness, glm::vec3 origin, glm::vec3 direction, Hit& hit)
{
    const float distance = (offset - glm::dot(normal, origin)) / glm::dot(normal, direction);
    // A negated test, so that a ray parallel to the plane misses.
    if (!(distance > 0.0f && distance < hit.distance && distance < 60.0f)) return;
    hit = {distance, glm::dot(normal, direction) < 0.0f ? normal : -normal, roughness};
}

Hit traceScene(glm::vec3 origin, glm::vec3 direction)
{
    Hit hit;
    for (const Sphere& sphere : kSpheres) intersectSphere(sphere, origin, direction, hit);
    intersectPlane({0, 1, 0}, 0.0f, 0.4f, origin, direction, hit);
    Hit wall = hit;
    intersectPlane(glm::normalize(glm::vec3(-0.3f, 0.0f, -1.0f)), -9.0f, 0.9f, origin, direction, wall);
    if ((origin + direction * wall.distance).y < 3.0f) hit = wall; // sky above
    return hit;
}
} // namespace

Camera makeCamera(int frame, float speed, int width, int height)
{
    const float t = speed * static_cast<float>(frame);
    Camera camera;
    camera.position = {0.4f * std::sin(t), 1.5f + 0.1f * t, -1.0f + 0.3f * t};
    const glm::vec3 target = camera.position + glm::vec3(std::sin(0.1f * t), -0.1f, std::cos(0.1f * t));
    camera.worldToView = glm::lookAtLH(camera.position, target, {0, 1, 0});
    camera.viewToClip =
        glm::perspectiveLH_ZO(1.0f, static_cast<float>(width) / static_cast<float>(height), 0.05f, 500.0f);
    return camera;
}

float normalizeHitDist(float hitDist, float viewZ, float roughness)
{
    const float spread = (1.0f - std::exp2(-200.0f * roughness * roughness)) * std::sqrt(roughness);
    const nrd::HitDistanceParameters p;
    return std::min(hitDist / ((p.A + viewZ * p.B) * glm::mix(p.C, 1.0f, spread)), 1.0f);
}

Guides renderGuides(const Camera& camera, int width, int height)
{
    return renderGuides(camera, width, height, traceScene);
}

Guides renderGuides(const Camera& camera, int width, int height, const Trace& trace)
{
    const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height);
    Guides guides{camera, std::vector<float>(count), std::vector<glm::vec3>(count), std::vector<float>(count)};
    const glm::mat4 viewToWorld = glm::inverse(camera.worldToView), clipToView = glm::inverse(camera.viewToClip);
    const bool isOrthographic = camera.viewToClip[3][3] == 1.0f;
    for (int y = 0; y < height; y++)
    {
        for (int x = 0; x < width; x++)
        {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(width, height);
            const glm::vec4 target = clipToView * glm::vec4(2.0f * uv.x - 1.0f, 1.0f - 2.0f * uv.y, 1.0f, 1.0f);
            const glm::vec3 targetView = glm::vec3(target) / target.w;
            const glm::vec3 rayView = isOrthographic ? glm::vec3(0, 0, 1) : glm::normalize(targetView);
            const glm::vec4 start = viewToWorld * glm::vec4(targetView.x, targetView.y, 0.0f, 1.0f);
            const glm::vec3 origin = isOrthographic ? glm::vec3(start) : camera.position;
            const Hit hit = trace(origin, glm::normalize(glm::mat3(viewToWorld) * rayView));
            const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
            guides.viewZ[i] = std::isinf(hit.distance) ? 2.0f * kDenoisingRange : hit.distance * rayView.z;
            guides.normals[i] = hit.normal;
            guides.roughness[i] = hit.roughness;
        }
    }
    return guides;
}
} // namespace quality
