#include "renderers/scene/gltf/scene_parts.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <optional>

#include "renderers/core/error.h"
#include "renderers/scene/gltf/accessor.h"
#include "renderers/scene/gltf/expansion_budget.h"

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

/// Of the morph targets of a node's mesh: the node's own, the mesh's, or 0.
std::vector<float> weights_of(const Document& document, const tinygltf::Node& node, ExpansionBudget& budget,
                              const std::string& place) {
    const auto& mesh = document.model.meshes[node.mesh];
    const auto& given = node.weights.empty() ? mesh.weights : node.weights;
    const auto targets = mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
    budget.spend(targets * sizeof(float), place);
    std::vector<float> weights(targets, 0.0f);
    for (std::size_t i = 0; i < given.size(); ++i) weights[i] = static_cast<float>(given[i]);
    return weights;
}

/// A value of each instance of a node; all are the same where the file has none.
template <class Vector>
std::vector<Vector> values_of_instances(const Document& document, const tinygltf::Value& attributes,
                                        const std::string& place, const char* name) {
    if (!attributes.Has(name)) return {};
    const Accessor accessor(document, attributes.Get(name).GetNumberAsInt(), place + "." + name);
    if (accessor.components() != Vector::length()) accessor.fail("has the wrong type; export the file again");
    return read_vectors<Vector>(accessor, nullptr);
}

/// Adds the instances of a node, which has none of its own [EXT_mesh_gpu_instancing], as children.
void add_instances(Document& document, Scene& scene, ExpansionBudget& budget, int index, int parent,
                   const std::vector<int>& meshes) {
    const auto place = element("nodes", index) + ".extensions." + gpu_instancing;
    const auto& attributes = document.model.nodes[index].extensions.at(gpu_instancing);
    std::optional<std::size_t> count;
    for (const auto& name : attributes.Keys()) {
        const Accessor accessor(document, attributes.Get(name).GetNumberAsInt(), place + "." + name);
        if (count && accessor.count() != *count)
            accessor.fail("has another number of instances than the others; export the file again");
        count = accessor.count();
    }
    constexpr std::size_t digits = 20;
    const auto& weights = scene.nodes[parent].weights;
    const auto node_bytes = sizeof(Node) + scene.nodes[parent].name.size() + digits +
                            meshes.size() * sizeof(int) + weights.size() * sizeof(float);
    budget.spend(count.value_or(0) * node_bytes, place);
    const auto translations = values_of_instances<glm::vec3>(document, attributes, place, "TRANSLATION");
    const auto rotations = values_of_instances<glm::vec4>(document, attributes, place, "ROTATION");
    const auto scales = values_of_instances<glm::vec3>(document, attributes, place, "SCALE");
    for (std::size_t i = 0; i < count.value_or(0); ++i) {
        Node node;
        node.name = scene.nodes[parent].name + " " + std::to_string(i + 1);
        node.parent = parent;
        node.meshes = meshes;
        node.weights = scene.nodes[parent].weights;
        if (!translations.empty()) node.translation = translations[i];
        if (!scales.empty()) node.scale = scales[i];
        if (!rotations.empty()) {
            const glm::dvec4 q(rotations[i]);
            node.rotation = rotation_of(document, {q.x, q.y, q.z, q.w});
        }
        scene.nodes.push_back(std::move(node));
    }
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
    ExpansionBudget budget(document);
    std::vector<int> result(document.model.nodes.size(), -1);
    std::vector<std::pair<int, int>> queue;  // glTF node, scene parent
    for (const int root : roots(document)) queue.emplace_back(root, -1);
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const auto [index, parent] = queue[i];
        const auto& source = document.model.nodes[index];
        result[index] = static_cast<int>(scene.nodes.size());
        auto node = node_of(document, source, parent);
        const bool has_instances = source.mesh >= 0 && source.extensions.contains(gpu_instancing);
        if (source.mesh >= 0) node.weights = weights_of(document, source, budget, element("nodes", index));
        if (source.mesh >= 0 && !has_instances) node.meshes = meshes[source.mesh];
        if (source.mesh >= 0 && source.skin >= 0) {
            if (has_instances)
                document.warnings.add(
                    "skins of instances are ignored; they keep the rest pose of their vertices");
            else
                node.skin = source.skin;
        }
        scene.nodes.push_back(std::move(node));
        if (has_instances) add_instances(document, scene, budget, index, result[index], meshes[source.mesh]);
        for (const int child : source.children) queue.emplace_back(child, result[index]);
    }
    return result;
}

}  // namespace ir::scene::gltf
