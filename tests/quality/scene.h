// A closed-form scene: a floor, a wall and spheres of several roughnesses under sky, seen by a camera that moves.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace quality
{
constexpr float kDenoisingRange = 1000.0f;

struct Camera
{
    glm::mat4 viewToClip{1.0f}; // left-handed, perspective or orthographic, depth in [0; 1]
    glm::mat4 worldToView{1.0f};
    glm::vec3 position{0.0f};
};

struct Guides
{
    Camera camera;
    std::vector<float> viewZ; // sky: beyond kDenoisingRange
    std::vector<glm::vec3> normals;
    std::vector<float> roughness;
};

// speed: world units a frame moves the camera and degrees it turns; 0 = static.
Camera makeCamera(int frame, float speed, int width, int height);

struct Hit
{
    float distance = INFINITY; // sky
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
    float roughness = 1.0f;
};
using Trace = std::function<Hit(glm::vec3 origin, glm::vec3 direction)>; // unit direction

// As REBLUR's front end does it with the default parameters.
float normalizeHitDist(float hitDist, float viewZ, float roughness);

Guides renderGuides(const Camera& camera, int width, int height); // of the scene above
Guides renderGuides(const Camera& camera, int width, int height, const Trace& trace);
} // namespace quality
