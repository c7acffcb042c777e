#include "renderers/scene/part_motion.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/error.h"

namespace ir::scene {
namespace {

bool is_finite(const PartMotion::Key& key) {
    const auto& q = key.rotation;
    float sum = key.time + q.x + q.y + q.z + q.w;
    for (int i = 0; i < 3; ++i) sum += key.translation[i] + key.scale[i];
    return std::isfinite(sum);
}

}  // namespace

void check_motion(const PartMotion& motion, const std::string& source) {
    const auto& keys = motion.keys;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool ascends = i == 0 || keys[i].time > keys[i - 1].time;
        if (!is_finite(keys[i]) || !ascends || !(glm::length(keys[i].rotation) > 0))
            throw UsageError("part '" + source + "': key " + std::to_string(i + 1) +
                             " of its motion must hold finite numbers, a rotation that is not 0, and a later "
                             "time than the key before");
    }
}

std::vector<AnimationChannel> channels_of(const PartMotion& motion, int node) {
    std::vector<AnimationChannel> channels;
    if (motion.keys.empty()) return channels;
    const auto add = [&](AnimatedPath path, auto value_of) {
        AnimationChannel channel;
        channel.node = node;
        channel.path = path;
        channel.loop = motion.loop;
        for (const auto& key : motion.keys) {
            channel.times.push_back(key.time);
            channel.values.push_back(value_of(key));
        }
        channels.push_back(std::move(channel));
    };
    using Key = PartMotion::Key;
    add(AnimatedPath::translation, [](const Key& key) { return glm::vec4(key.translation, 0); });
    add(AnimatedPath::rotation, [](const Key& key) {
        return glm::vec4(key.rotation.x, key.rotation.y, key.rotation.z, key.rotation.w);
    });
    add(AnimatedPath::scale, [](const Key& key) { return glm::vec4(key.scale, 0); });
    return channels;
}

Node node_of(const Camera& camera) {
    Node node;
    node.name = camera.name;
    const auto view_from_part = glm::lookAt(camera.eye, camera.target, camera.up);
    node.matrix = glm::inverse(view_from_part);
    return node;
}

}  // namespace ir::scene
