#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <map>

#include "renderers/core/error.h"
#include "renderers/scene/gltf/accessor.h"
#include "renderers/scene/gltf/scene_parts.h"

namespace ir::scene::gltf {
namespace {

std::vector<glm::mat4> inverse_bind_of(const Document& document, int accessor_index, std::size_t joints,
                                       const std::string& place) {
    std::vector<glm::mat4> matrices(joints, glm::mat4(1));
    if (accessor_index < 0) return matrices;
    const Accessor accessor(document, accessor_index, place + ".inverseBindMatrices");
    if (!accessor.is_float() || accessor.components() != 16) accessor.fail("must be matrices of floats");
    if (accessor.count() < joints)
        accessor.fail("has " + std::to_string(accessor.count()) + " matrices for " + std::to_string(joints) +
                      " joints; export the file again");
    for (std::size_t j = 0; j < joints; ++j) accessor.floats(j, glm::value_ptr(matrices[j]));
    return matrices;
}

Skin skin_of(const Document& document, int index, const std::vector<int>& nodes) {
    const auto& source = document.model.skins[index];
    const auto place = element("skins", index);
    Skin skin;
    for (const int joint : source.joints) {
        if (nodes[joint] < 0)
            throw InputError(
                document.file, place + ".joints",
                element("nodes", joint) + " is not in the scene that is shown; export the file again");
        skin.joints.push_back(nodes[joint]);
    }
    skin.inverse_bind = inverse_bind_of(document, source.inverseBindMatrices, skin.joints.size(), place);
    return skin;
}

/// Joints that a mesh asks for, at least.
std::size_t needed_joints(const Mesh& mesh) {
    std::size_t count = 0;
    for (const auto& each : mesh.influences)
        for (std::size_t i = 0; i < Influences::max; ++i)
            if (each.weights[i] > 0) count = std::max<std::size_t>(count, each.joints[i] + 1);
    return count;
}

}  // namespace

void load_skins(Document& document, Scene& scene, const std::vector<int>& nodes) {
    scene.skins.resize(document.model.skins.size());
    std::map<int, std::size_t> needed;  // by mesh
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i] < 0 || scene.nodes[nodes[i]].skin < 0) continue;
        const auto& node = scene.nodes[nodes[i]];
        auto& skin = scene.skins[node.skin];
        if (skin.joints.empty()) skin = skin_of(document, node.skin, nodes);
        for (const int mesh : node.meshes) {
            const auto [found, is_new] = needed.try_emplace(mesh);
            if (is_new) found->second = needed_joints(scene.meshes[mesh]);
            if (found->second > skin.joints.size())
                throw InputError(document.file, element("nodes", i) + ".skin",
                                 "its mesh asks for " + std::to_string(found->second) + " joints, but " +
                                     element("skins", node.skin) + " has " +
                                     std::to_string(skin.joints.size()) + "; export the file again");
        }
    }
}

}  // namespace ir::scene::gltf
