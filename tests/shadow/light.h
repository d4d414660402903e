// Lights that are discs, what stands in their way, and what is visible of them: ray by ray, and in the mean.
#pragma once
#include <functional>
#include <optional>
#include <setup.h>
#include <vector>

namespace shadow
{
struct Light
{
    bool isLocal = false;
    glm::vec3 direction{0.0f, 1.0f, 0.0f}; // to the sun
    float tangent = 0.0f;                  // of the sun's angular radius
    glm::vec3 position{0.0f};              // of a lamp, metres
    float radius = 0.0f;                   // of a lamp, metres
};

// Angles in degrees; azimuth 0 is +X.
Light makeSun(float elevation, float azimuth, float tangent);
Light makeLamp(glm::vec3 position, float radius);

struct Hit
{
    float share; // of the ray's vector, which ends in a lamp
    glm::vec3 color{0.0f};
};

// What a ray from P along V meets.
using Occluder = std::function<std::optional<Hit>(glm::vec3 P, glm::vec3 V, int frame)>;

Occluder makeEdge(float height, float x); // a plate at that height over everything left of x
Occluder makeWall();                      // standing on the floor along z = 0, left of x = 0
Occluder makeSphere(glm::vec3 centre, float radius);
Occluder join(std::vector<Occluder> occluders); // the first hit's distance, the product of colours

// One ray towards a random point of the light, packed as the front end does it.
options::LightRay castRay(const Light& light, const Occluder& occluder, glm::vec3 P, glm::ivec2 pixel, int frame);

// Visible share and colour in the mean: by the closed form behind a straight edge, by 600 rays behind anything.
double visibleBesideEdge(const Light& light, float height, float x, glm::vec3 P);
double visibleBesideWall(const Light& light, glm::vec3 P);
glm::dvec4 meanOf(const Light& light, const Occluder& occluder, glm::vec3 P, int frame);

// [0; 1), another one for each pixel, frame and use.
float random(glm::ivec2 pixel, int frame, uint32_t use);
} // namespace shadow
