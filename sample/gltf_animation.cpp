#include "gltf_accessor.h"
#include "gltf_parts.h"

#include <algorithm>
#include <tiny_gltf.h>

namespace sample
{
namespace
{
bool readPath(const std::string& name, AnimationChannel& channel, size_t weightCount)
{
    if (name == "translation")
        channel.path = AnimationPath::Translation;
    else if (name == "rotation")
        channel.path = AnimationPath::Rotation;
    else if (name == "scale")
        channel.path = AnimationPath::Scale;
    else if (name == "weights")
        channel.path = AnimationPath::Weights;
    else
        return false; // of an extension we do not know
    channel.valueSize = channel.path == AnimationPath::Rotation  ? 4
                        : channel.path == AnimationPath::Weights ? static_cast<uint32_t>(weightCount)
                                                                 : 3;
    return channel.valueSize > 0;
}

Interpolation toInterpolation(const std::string& name, const std::string& what)
{
    if (name.empty() || name == "LINEAR") return Interpolation::Linear;
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::Cubic;
    throw SceneError(what + " has the unknown interpolation '" + name + "'");
}

size_t morphCount(const Scene& scene, const Node& node)
{
    size_t count = 0;
    if (node.mesh == kNone) return 0;
    for (const Primitive& p : scene.meshes[size_t(node.mesh)].primitives) count = std::max(count, p.targets.size());
    return count;
}

void readKeys(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, const std::string& what,
              AnimationChannel& channel)
{
    channel.interpolation = toInterpolation(sampler.interpolation, what);
    channel.times = readFloats(model, sampler.input, what + ", times").values;
    channel.values = readFloats(model, sampler.output, what + ", values").values;
    if (channel.times.empty()) throw SceneError(what + " has no keys");
    if (!std::is_sorted(channel.times.begin(), channel.times.end()))
        throw SceneError(what + " has times that decrease");
    const size_t perKey = channel.interpolation == Interpolation::Cubic ? 3 : 1;
    if (channel.values.size() != channel.times.size() * channel.valueSize * perKey)
        throw SceneError(what + " has " + std::to_string(channel.values.size()) + " numbers for " +
                         std::to_string(channel.times.size()) + " keys");
}
} // namespace

void readAnimation(const tinygltf::Model& model, const std::vector<int>& nodeMap, Scene& scene)
{
    if (model.animations.empty()) return;
    const tinygltf::Animation& animation = model.animations.front();
    for (size_t i = 0; i < animation.channels.size(); ++i)
    {
        const tinygltf::AnimationChannel& in = animation.channels[i];
        const std::string what = "animation 0, channel " + std::to_string(i) + ",";
        if (in.target_node < 0) continue;
        if (size_t(in.target_node) >= nodeMap.size())
            throw SceneError(what + " moves node " + std::to_string(in.target_node) + ", which does not exist");
        if (in.sampler < 0 || size_t(in.sampler) >= animation.samplers.size())
            throw SceneError(what + " uses sampler " + std::to_string(in.sampler) + ", which does not exist");
        AnimationChannel channel;
        channel.node = nodeMap[size_t(in.target_node)];
        if (channel.node == kNone) continue; // outside the scene
        if (!readPath(in.target_path, channel, morphCount(scene, scene.nodes[size_t(channel.node)]))) continue;
        readKeys(model, animation.samplers[size_t(in.sampler)], what, channel);
        scene.duration = std::max(scene.duration, channel.times.back());
        scene.channels.push_back(std::move(channel));
    }
}
} // namespace sample
