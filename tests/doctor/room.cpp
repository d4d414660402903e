#include "room.h"
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <random>

namespace test
{
namespace
{
using glm::dvec3;

const dvec3 kHalf = {2.0, 1.5, 3.0};
constexpr double kTanX = 0.8;

struct Hit
{
    dvec3 position, normal;
    double distance = 0.0;
};

Hit traceFromInside(const dvec3& origin, const dvec3& direction)
{
    Hit hit;
    hit.distance = 1e30;
    for (int axis = 0; axis < 3; axis++)
    {
        const double wall = direction[axis] > 0.0 ? kHalf[axis] : -kHalf[axis];
        const double distance = (wall - origin[axis]) / direction[axis];
        if (!(distance < hit.distance)) continue;
        hit.distance = distance;
        hit.normal = dvec3(0.0);
        hit.normal[axis] = direction[axis] > 0.0 ? -1.0 : 1.0;
    }
    hit.position = origin + direction * hit.distance;
    return hit;
}

glm::dmat3 basisAround(const dvec3& n)
{
    const dvec3 x = glm::normalize(glm::cross(std::abs(n.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), n));
    return {x, glm::cross(n, x), n};
}

class Painter
{
public:
    Painter(size_t index, size_t width, size_t height)
        : m_random(static_cast<uint32_t>(index)), m_width(width), m_height(height)
    {
        m_frame.width = width;
        m_frame.height = height;
        m_frame.viewZ.assign(width * height * 4, 0.0f);
        for (Texels* texels : {&m_frame.motion, &m_frame.guides, &m_frame.diffuseSignal, &m_frame.specularSignal,
                               &m_frame.diffuseFactor, &m_frame.specularFactor, &m_frame.specularDirection})
            *texels = m_frame.viewZ;
        setCamera(index, true);
        if (index > 0) setCamera(index - 1, false);
    }

    FrameInputs paint(size_t index)
    {
        m_frame.common.frameIndex = static_cast<uint32_t>(index);
        m_frame.common.denoisingRange = 1000.0f;
        m_frame.common.isMotionVectorInWorldSpace = true;
        if (index == 0) m_frame.common.accumulationMode = nrd::AccumulationMode::RESTART;
        m_frame.hitDistanceParameters.A = 6.0f;
        for (size_t i = 0; i < m_width * m_height; i++) paintPixel(i);
        m_frame.pack();
        return std::move(m_frame);
    }

private:
    void setCamera(size_t index, bool isCurrent)
    {
        const double t = static_cast<double>(index);
        const dvec3 eye = {0.3 + 0.02 * t, 0.1, 2.0};
        const double yaw = 0.35 + 0.02 * t, pitch = -0.25 + 0.01 * t;
        const dvec3 forward = {std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
        const glm::dmat4 view = glm::lookAt(eye, eye + forward, dvec3(0, 1, 0));
        const double aspect = double(m_width) / double(m_height);
        const float clip[16] = {
            float(1.0 / kTanX), 0, 0, 0, 0, float(aspect / kTanX), 0, 0, 0, 0, 0, -1, 0, 0, 0.01f, 0};
        const float jitter[2] = {0.3f * static_cast<float>(std::cos(2.4 * t)),
                                 0.3f * static_cast<float>(std::sin(2.4 * t))};
        nrd::CommonSettings& common = m_frame.common;
        const auto set = [&](float(&viewTo)[16], float(&clipTo)[16], float(&jitterTo)[2])
        {
            for (int i = 0; i < 16; i++) viewTo[i] = static_cast<float>(glm::value_ptr(view)[i]);
            std::copy_n(clip, 16, clipTo);
            std::copy_n(jitter, 2, jitterTo);
        };
        set(common.worldToViewMatrixPrev, common.viewToClipMatrixPrev, common.cameraJitterPrev);
        if (isCurrent)
        {
            set(common.worldToViewMatrix, common.viewToClipMatrix, common.cameraJitter);
            m_eye = eye;
            m_view = view;
            m_aspect = aspect;
        }
        const dvec3 delta = eye - m_eye;
        for (int i = 0; i < 3; i++) common.cameraDelta[i] = delta[i];
        common.isCameraDeltaAvailable = true;
        for (uint16_t* size : {common.resourceSize, common.resourceSizePrev, common.rectSize, common.rectSizePrev})
        {
            size[0] = static_cast<uint16_t>(m_width);
            size[1] = static_cast<uint16_t>(m_height);
        }
        common.timeDeltaBetweenFrames = 16.0f;
    }

    double uniform() { return std::uniform_real_distribution<double>(1e-6, 1.0 - 1e-6)(m_random); }

    void paintPixel(size_t pixel)
    {
        const nrd::CommonSettings& common = m_frame.common;
        const double u = (double(pixel % m_width) + 0.5 + double(common.cameraJitter[0])) / double(m_width);
        const double v = (double(pixel / m_width) + 0.5 + double(common.cameraJitter[1])) / double(m_height);
        const dvec3 inView = {(2.0 * u - 1.0) * kTanX, (1.0 - 2.0 * v) * kTanX / m_aspect, -1.0};
        const dvec3 ray = glm::normalize(glm::transpose(glm::dmat3(m_view)) * inView);
        const Hit hit = traceFromInside(m_eye, ray);
        const size_t i = pixel * 4;
        m_frame.viewZ[i] = static_cast<float>((m_view * glm::dvec4(hit.position, 1.0)).z);
        const dvec3 cell = glm::floor(hit.position * 2.0 + 0.001 * hit.normal);
        const bool isDark = std::fmod(std::abs(cell.x + cell.y + cell.z), 2.0) > 0.5;
        const double roughness = hit.normal.y != 0.0 ? 0.3 : 0.6;
        put(m_frame.guides, i, hit.normal, roughness);
        put(m_frame.diffuseFactor, i, dvec3(isDark ? 0.2 : 0.7), 0.0);
        put(m_frame.specularFactor, i, dvec3(0.2), 0.0);
        paintDiffuse(i, hit);
        paintSpecular(i, hit, -ray, roughness * roughness);
    }

    void paintDiffuse(size_t i, const Hit& hit)
    {
        const double r = std::sqrt(uniform()), phi = 6.283185307 * uniform();
        const dvec3 local = {r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - r * r)};
        const Hit next = traceFromInside(hit.position, basisAround(hit.normal) * local);
        put(m_frame.diffuseSignal, i, dvec3(radiance()), next.distance);
    }

    // Visible normals (Dupuy and Benyoub 2023); a path that ends below the surface has no sample.
    void paintSpecular(size_t i, const Hit& hit, const dvec3& toCamera, double alpha)
    {
        const glm::dmat3 basis = basisAround(hit.normal);
        const dvec3 view = glm::transpose(basis) * toCamera;
        const dvec3 stretched = glm::normalize(dvec3(alpha * view.x, alpha * view.y, view.z));
        const double phi = 6.283185307 * uniform();
        const double z = (1.0 - uniform()) * (1.0 + stretched.z) - stretched.z;
        const double sine = std::sqrt(std::max(1.0 - z * z, 0.0));
        const dvec3 cap = dvec3(sine * std::cos(phi), sine * std::sin(phi), z) + stretched;
        const dvec3 half = glm::normalize(dvec3(alpha * cap.x, alpha * cap.y, cap.z));
        const dvec3 direction = 2.0 * glm::dot(view, half) * half - view;
        if (direction.z <= 0.0) return;
        const Hit next = traceFromInside(hit.position, basis * direction);
        put(m_frame.specularSignal, i, dvec3(radiance()), next.distance);
        put(m_frame.specularDirection, i, basis * direction, 0.0);
    }

    double radiance() { return uniform() < 0.5 ? 0.1 : 1.5; }

    static void put(Texels& texels, size_t i, const dvec3& xyz, double w)
    {
        for (size_t c = 0; c < 3; c++) texels[i + c] = static_cast<float>(xyz[static_cast<int>(c)]);
        texels[i + 3] = static_cast<float>(w);
    }

    std::mt19937 m_random;
    size_t m_width, m_height;
    FrameInputs m_frame;
    dvec3 m_eye = {};
    glm::dmat4 m_view = {};
    double m_aspect = 1.0;
};
} // namespace

std::vector<FrameInputs> makeRoom(size_t frameCount, size_t width, size_t height)
{
    std::vector<FrameInputs> frames;
    for (size_t i = 0; i < frameCount; i++) frames.push_back(Painter(i, width, height).paint(i));
    return frames;
}
} // namespace test
