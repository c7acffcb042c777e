#include <algorithm>
#include <set>

#include "renderers/core/error.h"
#include "renderers/scene/gltf/accessor.h"
#include "renderers/scene/gltf/scene_parts.h"

namespace ir::scene::gltf {
namespace {

AnimatedPath path_of(const std::string& path) {
    if (path == "translation") return AnimatedPath::translation;
    if (path == "weights") return AnimatedPath::weight;
    return path == "rotation" ? AnimatedPath::rotation : AnimatedPath::scale;
}

Interpolation interpolation_of(const Document& document, const std::string& name, const std::string& place) {
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubic;
    throw InputError(document.file, place + ".interpolation",
                     "\"" + one_line(name) + "\" is unknown; use LINEAR, STEP or CUBICSPLINE");
}

std::vector<float> times_of(const Document& document, int index, const std::string& place) {
    const Accessor accessor(document, index, place + ".input");
    if (!accessor.is_float() || accessor.components() != 1) accessor.fail("times must be float scalars");
    std::vector<float> times(accessor.count());
    for (std::size_t i = 0; i < times.size(); ++i) accessor.floats(i, &times[i]);
    for (std::size_t i = 1; i < times.size(); ++i)
        if (times[i] <= times[i - 1]) accessor.fail("times must ascend; export the file again");
    if (times[0] < 0) accessor.fail("times must not be negative; export the file again");
    return times;
}

std::vector<glm::vec4> values_of(const Document& document, int index, std::size_t count, int components,
                                 const std::string& place) {
    const Accessor accessor(document, index, place + ".output");
    if (accessor.components() != components) accessor.fail("has the wrong type for the animated property");
    if (accessor.count() != count)
        accessor.fail("has " + std::to_string(accessor.count()) + " elements where the times ask for " +
                      std::to_string(count) + "; export the file again");
    return read_vectors<glm::vec4>(accessor, nullptr);
}

class AnimationReader {
  public:
    AnimationReader(Document& document, Scene& scene, const std::vector<int>& nodes)
        : document_(document), scene_(scene), nodes_(nodes) {}

    void read(const tinygltf::Animation& animation, const std::string& place) {
        for (const auto& channel : animation.channels) {
            const int node = nodes_[channel.target_node];
            if (node < 0) continue;
            const auto path = path_of(channel.target_path);
            const bool is_weight = path == AnimatedPath::weight;
            if (is_weight && !has_targets(scene_.nodes[node])) {
                document_.warnings.add(
                    "animated weights of what has no morph targets, or of instances, are ignored");
            } else if (!is_weight && scene_.nodes[node].matrix) {
                document_.warnings.add("animation of a node with a matrix was ignored");
            } else if (!taken_.insert({node, static_cast<int>(path)}).second) {
                document_.warnings.add("several animations move the same node; the first one is played");
            } else {
                const auto sampler_place = place + "." + element("samplers", channel.sampler);
                read(animation.samplers[channel.sampler], node, path, sampler_place);
            }
        }
    }

  private:
    /// A file may refer to the same keys from many channels; what it may become is limited.
    void spend(std::size_t keys, const std::string& place) {
        constexpr std::size_t max_keys = std::size_t{1} << 24;
        keys_ += keys;
        if (keys_ > max_keys)
            throw InputError(document_.file, place, "more than 2^24 animation keys; resample the animation");
    }

    void read(const tinygltf::AnimationSampler& sampler, int node, AnimatedPath path,
              const std::string& place) {
        if (!Accessor(document_, sampler.input, place + ".input").has_data()) {
            document_.warnings.add("an animation without data was ignored");
            return;
        }
        spend(document_.model.accessors[sampler.input].count, place);
        AnimationChannel channel;
        channel.node = node;
        channel.path = path;
        channel.interpolation = interpolation_of(document_, sampler.interpolation, place);
        channel.times = times_of(document_, sampler.input, place);
        if (path == AnimatedPath::weight) return read_weights(sampler, std::move(channel), place);
        channel.values = values_of(document_, sampler.output, per_key(channel) * channel.times.size(),
                                   path == AnimatedPath::rotation ? 4 : 3, place);
        scene_.animation.push_back(std::move(channel));
    }

    /// A channel for each target; the file has their values side by side [glTF 2.0, 3.11].
    void read_weights(const tinygltf::AnimationSampler& sampler, AnimationChannel channel,
                      const std::string& place) {
        const auto targets = scene_.nodes[channel.node].weights.size();
        const auto parts = per_key(channel), keys = channel.times.size();
        spend(keys * (targets - 1), place);
        const auto values = values_of(document_, sampler.output, parts * keys * targets, 1, place);
        for (std::size_t target = 0; target < targets; ++target) {
            channel.target = static_cast<int>(target);
            channel.values.clear();
            for (std::size_t i = 0; i < parts * keys; ++i)
                channel.values.push_back(values[i * targets + target]);
            scene_.animation.push_back(channel);
        }
    }

    static std::size_t per_key(const AnimationChannel& channel) {
        return channel.interpolation == Interpolation::cubic ? 3 : 1;
    }
    static bool has_targets(const Node& node) { return !node.meshes.empty() && !node.weights.empty(); }

    Document& document_;
    Scene& scene_;
    const std::vector<int>& nodes_;
    std::set<std::pair<int, int>> taken_;
    std::size_t keys_ = 0;
};

}  // namespace

void load_animations(Document& document, Scene& scene, const std::vector<int>& nodes) {
    AnimationReader reader(document, scene, nodes);
    for (std::size_t i = 0; i < document.model.animations.size(); ++i)
        reader.read(document.model.animations[i], element("animations", i));
}

}  // namespace ir::scene::gltf
