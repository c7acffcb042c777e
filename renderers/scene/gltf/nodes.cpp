#include "renderers/scene/gltf/scene_parts.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "renderers/core/error.h"

namespace ir::scene::gltf {
namespace {

glm::vec3 vec3_of(const std::vector<double>& values, glm::vec3 otherwise) {
    return values.empty() ? otherwise : glm::vec3(glm::make_vec3(values.data()));
}

glm::quat rotation_of(Document& document, const std::vector<double>& xyzw) {
    if (xyzw.empty()) return {1, 0, 0, 0};
    const glm::dquat q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    if (glm::length(q) < 1e-6) {
        document.warnings.add("rotations of length zero were replaced by none");
        return {1, 0, 0, 0};
    }
    return glm::quat(glm::normalize(q));
}

Node node_of(Document& document, const tinygltf::Node& source, int parent) {
    Node node;
    node.name = source.name;
    node.parent = parent;
    node.translation = vec3_of(source.translation, glm::vec3(0));
    node.rotation = rotation_of(document, source.rotation);
    node.scale = vec3_of(source.scale, glm::vec3(1));
    if (!source.matrix.empty()) node.matrix = glm::mat4(glm::make_mat4(source.matrix.data()));
    return node;
}

std::vector<int> roots(Document& document) {
    const auto& model = document.model;
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const auto& node : model.nodes)
        for (const int child : node.children) is_child[child] = true;
    if (model.scenes.empty()) {
        std::vector<int> result;
        for (std::size_t i = 0; i < model.nodes.size(); ++i)
            if (!is_child[i]) result.push_back(static_cast<int>(i));
        if (!result.empty()) document.warnings.add("the file has no scene; all nodes are shown");
        return result;
    }
    if (model.scenes.size() > 1)
        document.warnings.add("the file has " + std::to_string(model.scenes.size()) +
                              " scenes; only the default one is shown");
    const int scene = std::max(0, model.defaultScene);
    auto result = model.scenes[scene].nodes;
    for (const int root : result)
        if (is_child[root])
            throw InputError(document.file, element("scenes", scene) + ".nodes",
                             element("nodes", root) + " is not a root; export the file again");
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

}  // namespace

std::vector<int> load_nodes(Document& document, Scene& scene, const std::vector<std::vector<int>>& meshes) {
    std::vector<int> result(document.model.nodes.size(), -1);
    std::vector<std::pair<int, int>> queue;  // glTF node, scene parent
    for (const int root : roots(document)) queue.emplace_back(root, -1);
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const auto [index, parent] = queue[i];
        const auto& source = document.model.nodes[index];
        result[index] = static_cast<int>(scene.nodes.size());
        auto node = node_of(document, source, parent);
        if (source.mesh >= 0) node.meshes = meshes[source.mesh];
        if (source.mesh >= 0 && source.skin >= 0)
            document.warnings.add("skins are ignored; meshes keep the rest pose of their vertices");
        scene.nodes.push_back(std::move(node));
        for (const int child : source.children) queue.emplace_back(child, result[index]);
    }
    return result;
}

}  // namespace ir::scene::gltf
