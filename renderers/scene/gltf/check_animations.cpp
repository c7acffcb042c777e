#include "renderers/core/error.h"
#include "renderers/scene/gltf/check.h"
#include "renderers/scene/gltf/source.h"

namespace ir::scene::gltf {
namespace {

const Json& required_array(const CheckedObject& owner, const char* key) {
    const auto* values = owner.array(key);
    if (!values) owner.fail(key, "is missing; export the file again");
    return *values;
}

/// The target of a channel, or nothing where we animate no such thing.
std::optional<Json> checked_target(Checking& checking, const CheckedObject& channel) {
    CheckedObject target(checking.file, channel.place("target"), channel.required_object("target"));
    const auto path = target.required(target.text("path"), "path");
    const auto node = target.index("node", checking.count("nodes"), "nodes");
    if (path == "pointer") checking.warnings.add("animated properties other than nodes' are ignored");
    const bool known = path == "translation" || path == "rotation" || path == "scale" || path == "weights";
    if (!known || !node) return {};
    return target.result;
}

}  // namespace

void check_animations(Checking& checking) {
    checking.for_each("animations", [&](CheckedObject& animation) {
        animation.text("name");
        const auto& samplers = required_array(animation, "samplers");
        animation.result["samplers"] = Json::array();
        for (std::size_t i = 0; i < samplers.size(); ++i) {
            CheckedObject sampler(checking.file, animation.place(element("samplers", i)), samplers[i]);
            const auto accessors = checking.count("accessors");
            sampler.required(sampler.index("input", accessors, "accessors"), "input");
            sampler.required(sampler.index("output", accessors, "accessors"), "output");
            sampler.text("interpolation");
            animation.result["samplers"].push_back(sampler.result);
        }
        const auto& channels = required_array(animation, "channels");
        animation.result["channels"] = Json::array();
        for (std::size_t i = 0; i < channels.size(); ++i) {
            CheckedObject channel(checking.file, animation.place(element("channels", i)), channels[i]);
            channel.required(channel.index("sampler", samplers.size(), "samplers"), "sampler");
            const auto target = checked_target(checking, channel);
            if (!target) continue;
            channel.result["target"] = *target;
            animation.result["channels"].push_back(channel.result);
        }
    });
}

}  // namespace ir::scene::gltf
