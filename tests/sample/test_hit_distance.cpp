// The hit distances of a reference against integrals over the lobes.
#include "catch.h"
#include "tracer_fixture.h"

#include <cmath>

using namespace sample;

namespace
{
constexpr double kPi = 3.14159265358979;

// Two walls that face each other, seen from between them: the one at z = 0 is what the camera looks at.
Scene facingWalls(float distance, float roughness)
{
    Primitive front = test::makeFloor(1000.0f, 0), back = test::makeFloor(1000.0f, 0);
    for (Primitive* wall : {&front, &back})
        for (size_t i = 0; i < 4; ++i)
        {
            wall->positions[i] = glm::vec3(wall->positions[i].x, -wall->positions[i].z, 0.0f);
            wall->normals[i] = glm::vec3(0, 0, 1);
        }
    for (size_t i = 0; i < 4; ++i)
    {
        back.positions[i] = glm::vec3(-back.positions[i].x, back.positions[i].y, distance);
        back.normals[i] = glm::vec3(0, 0, -1);
    }
    return test::makeScene({front, back}, {test::makeMaterial(glm::vec3(0.5f), 0.0f, roughness)});
}

// min(1, h / f) over directions at the angle theta to the normal, h = distance / cos(theta), weighted by `density` per
// solid angle. What of the density's integral is missing are directions into the wall: contacts, with h = 0.
template <class F> double integrate(double distance, double f, F density)
{
    constexpr int kSteps = 20000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i)
    {
        const double theta = 0.5 * kPi * (i + 0.5) / kSteps;
        const double normalized = std::min(1.0, distance / std::cos(theta) / f);
        sum += normalized * density(std::cos(theta)) * 2.0 * kPi * std::sin(theta) * 0.5 * kPi / kSteps;
    }
    return sum;
}

// Density of reflections of a ray along the normal: GGX normals, the half below the horizon of the ellipsoid left out
// as far as the bound of Eto and Tokuyoshi (2023) does.
double reflectionDensity(double cosine, double roughness)
{
    const double a2 = std::pow(roughness, 4.0), noh2 = 0.5 * (1.0 + cosine);
    const double d = noh2 * (a2 - 1.0) + 1.0, k = (1.0 - a2) / (1.0 + a2);
    return a2 / (kPi * d * d) / (2.0 * (k + 1.0));
}
} // namespace

TEST_CASE("the hit distances of a reference are the expectations of the format", "[gpu]")
{
    const float roughness = GENERATE(0.15f, 0.5f, 0.9f);
    constexpr float kDistance = 1.5f;
    test::TraceRequest r;
    r.desc.width = r.desc.height = 4;
    r.desc.maxBounces = 1;
    r.desc.hitDistanceParameters = glm::vec3(1.0f, 0.2f, 4.0f);
    r.view.camera = lookAt({0, 0, 1}, {0, 0, 0}, 0.001f, 1.0f, 0.01f);
    r.samples = 2048;
    const Environment sky = makeUniformEnvironment(glm::vec3(1.0f)); // seen by nobody
    const test::Traced traced = test::trace(facingWalls(kDistance, roughness), &sky, r);
    const glm::dvec3 diffuse = test::meanOf(
        16, [](size_t) { return true; }, [&](size_t i) { return glm::vec3(traced.diffuseMean[i].w); });
    const glm::dvec3 specular = test::meanOf(
        16, [](size_t) { return true; }, [&](size_t i) { return glm::vec3(traced.specularMean[i].w); });
    const double range = 1.0 + 0.2 * 1.0; // A + B |viewZ|
    const double spread = (1.0 - std::exp2(-200.0 * roughness * roughness)) * std::sqrt(roughness);
    INFO("roughness " << roughness);
    CHECK(diffuse.x == Approx(integrate(kDistance, range, [](double cosine) { return cosine / kPi; })).epsilon(0.003));
    const double expected = integrate(kDistance, range * (4.0 + spread * (1.0 - 4.0)),
                                      [&](double cosine) { return reflectionDensity(cosine, roughness); });
    CHECK(specular.x == Approx(expected).epsilon(0.005));
}
