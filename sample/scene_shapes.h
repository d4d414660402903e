// What the built-in scenes are put together from.
#pragma once
#include "scene.h"

namespace sample
{
Material makeMaterial(const char* name, const glm::vec3& color, float metallic, float roughness);

/// A parallelogram, counter-clockwise seen from the side its normal points to. Texture coordinates are distances from
/// the origin along u and v, in world units.
void addQuad(Primitive& p, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v);
Primitive makeQuad(int material, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v);

/// Standing on y = 0 around the origin.
Primitive makeBlock(int material, const glm::vec3& size);

Primitive makeSphere(const glm::vec3& center, float radius, int material);

/// A node that stands at `translation`, turned about Y.
Node makeNode(const char* name, int mesh, const glm::vec3& translation, float angle);

/// Quaternions as animation channels hold them. `tilt` is about the turned X axis: negative looks down.
glm::vec4 turnAboutY(float angle);
glm::vec4 turnAndTilt(float angle, float tilt);

/// Keys of a smooth closed motion of `duration` seconds; `value` gives the numbers at a phase in [0; 2 pi].
template <class F>
AnimationChannel makeChannel(int node, AnimationPath path, uint32_t valueSize, float duration, F value)
{
    constexpr int kKeyCount = 65;
    constexpr float kTwoPi = 6.28318531f;
    AnimationChannel channel;
    channel.node = node;
    channel.path = path;
    channel.valueSize = valueSize;
    for (int i = 0; i < kKeyCount; ++i)
    {
        const float phase = kTwoPi * float(i) / float(kKeyCount - 1);
        channel.times.push_back(duration * float(i) / float(kKeyCount - 1));
        const auto numbers = value(phase);
        for (uint32_t c = 0; c < valueSize; ++c) channel.values.push_back(numbers[int(c)]);
    }
    return channel;
}
} // namespace sample
