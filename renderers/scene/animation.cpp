#include <algorithm>
#include <cmath>

#include "renderers/scene/scene.h"

namespace ir::scene {
namespace {

glm::quat quaternion(glm::vec4 xyzw) {
    return {xyzw.w, xyzw.x, xyzw.y, xyzw.z};
}
glm::vec4 components(glm::quat q) {
    return {q.x, q.y, q.z, q.w};
}

/// [glTF 2.0, appendix C.5]
glm::vec4 cubic(const AnimationChannel& channel, std::size_t key, float t, float interval) {
    const auto value = channel.values[3 * key + 1], next = channel.values[3 * key + 4];
    const auto out = interval * channel.values[3 * key + 2], in = interval * channel.values[3 * key + 3];
    const float t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * value + (t3 - 2 * t2 + t) * out + (-2 * t3 + 3 * t2) * next +
           (t3 - t2) * in;
}

/// `time` taken back into the channel's own, where that begins again.
float within(const AnimationChannel& channel, double time) {
    const double first = channel.times.front(), length = channel.times.back() - first;
    if (!channel.loop || !(length > 0)) return static_cast<float>(time);
    return static_cast<float>(first + (time - first) - length * std::floor((time - first) / length));
}

/// The channel's value at `time`, clamped to the first and last key; rotations are not yet unit length.
glm::vec4 sample(const AnimationChannel& channel, float time) {
    const bool is_cubic = channel.interpolation == Interpolation::cubic;
    const auto value = [&](std::size_t key) { return channel.values[is_cubic ? 3 * key + 1 : key]; };
    const auto& times = channel.times;
    const auto after =
        static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    if (after == 0) return value(0);
    const auto key = after - 1;
    if (after == times.size() || channel.interpolation == Interpolation::step) return value(key);
    const float interval = times[after] - times[key];
    const float t = (time - times[key]) / interval;
    if (is_cubic) return cubic(channel, key, t, interval);
    if (channel.path != AnimatedPath::rotation) return glm::mix(value(key), value(after), t);
    return components(
        glm::slerp(glm::normalize(quaternion(value(key))), glm::normalize(quaternion(value(after))), t));
}

void apply(const AnimationChannel& channel, double time, Node& node) {
    if (channel.times.empty()) return;
    const auto value = sample(channel, within(channel, time));
    if (channel.path == AnimatedPath::translation) node.translation = glm::vec3(value);
    if (channel.path == AnimatedPath::scale) node.scale = glm::vec3(value);
    if (channel.path == AnimatedPath::weight)
        node.weights[static_cast<std::size_t>(channel.target)] = value.x;
    if (channel.path != AnimatedPath::rotation) return;
    const auto rotation = quaternion(value);
    const float length = glm::length(rotation);
    if (length > 1e-6f && std::isfinite(length)) node.rotation = rotation / length;
}

glm::mat4 local_matrix(const Node& node) {
    if (node.matrix) return *node.matrix;
    glm::mat4 matrix = glm::mat4_cast(node.rotation);
    for (int i = 0; i < 3; ++i) matrix[i] *= node.scale[i];
    matrix[3] = glm::vec4(node.translation, 1);
    return matrix;
}

std::vector<Node> animated_nodes(const Scene& scene, double time) {
    auto nodes = scene.nodes;
    for (const auto& channel : scene.animation) apply(channel, time, nodes[channel.node]);
    return nodes;
}

Pose pose_of(const std::vector<Node>& nodes) {
    Pose pose;
    pose.matrices.resize(nodes.size());
    pose.weights.resize(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto local = local_matrix(nodes[i]);
        pose.matrices[i] = nodes[i].parent >= 0 ? pose.matrices[nodes[i].parent] * local : local;
        pose.weights[i] = nodes[i].weights;
    }
    return pose;
}

}  // namespace

Pose pose_at(const Scene& scene, double time) {
    return scene.is_animated() ? pose_of(animated_nodes(scene, time)) : pose_of(scene.nodes);
}

std::vector<glm::mat4> world_matrices(const Scene& scene, double time) {
    return pose_at(scene, time).matrices;
}

}  // namespace ir::scene
