#include "renderers/scene/gltf/scene_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderers/core/error.h"
#include "renderers/scene/gltf/accessor.h"
#include "renderers/scene/gltf/expansion_budget.h"

namespace ir::scene::gltf {
namespace {

using Indices = std::vector<std::uint32_t>;

std::size_t bytes_of(std::size_t vertices, std::size_t indices) {
    constexpr std::size_t vertex_bytes = 12 + 12 + 16 + 8 + 8 + 16;
    return vertices * vertex_bytes + indices * sizeof(std::uint32_t);
}

/// The primitive's corners in drawing order.
Indices corners(const Document& document, const tinygltf::Primitive& primitive, std::size_t vertices,
                ExpansionBudget& budget, const std::string& place) {
    Indices result;
    if (primitive.indices < 0) {
        budget.spend(bytes_of(vertices, 3 * vertices), place);
        result.resize(vertices);
        std::iota(result.begin(), result.end(), 0u);
        return result;
    }
    const Accessor accessor(document, primitive.indices, place + ".indices");
    if (!accessor.is_unsigned() || accessor.components() != 1)
        accessor.fail("indices must be unsigned scalars; export the file again");
    budget.spend(bytes_of(accessor.count(), 3 * accessor.count()), place);
    result.resize(accessor.count());
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = accessor.whole(i);
        if (result[i] >= vertices)
            accessor.fail("index " + std::to_string(result[i]) + " at " + std::to_string(i) +
                          ", but there are only " + std::to_string(vertices) +
                          " vertices; export the file again");
    }
    return result;
}

/// Triangles of a list, strip or fan, all with the first triangle's winding [glTF 2.0, 3.7.2.1].
Indices triangles(const Indices& corners, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES)
        return Indices(corners.begin(),
                       corners.begin() + static_cast<std::ptrdiff_t>(corners.size() / 3 * 3));
    Indices result;
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const std::size_t odd = i % 2;
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            result.insert(result.end(), {corners[i], corners[i + 1 + odd], corners[i + 2 - odd]});
        else
            result.insert(result.end(), {corners[i + 1], corners[i + 2], corners[0]});
    }
    return result;
}

/// Vertices that the indices name, ascending (several primitives often share one vertex buffer); renumbers
/// the indices to them.
Indices drawn_vertices(Indices& indices, std::size_t vertices) {
    Indices used;
    if (vertices / 4 > indices.size()) {  // a table would be mostly empty
        used = indices;
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (auto& index : indices)
            index =
                static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), index) - used.begin());
        return used;
    }
    Indices number(vertices, 0);
    for (const auto index : indices) number[index] = 1;
    for (std::uint32_t i = 0; i < number.size(); ++i) {
        if (number[i] == 0) continue;
        number[i] = static_cast<std::uint32_t>(used.size());
        used.push_back(i);
    }
    for (auto& index : indices) index = number[index];
    return used;
}

class PrimitiveReader {
  public:
    PrimitiveReader(const Document& document, const tinygltf::Primitive& primitive, std::string place)
        : document_(document), primitive_(primitive), place_(std::move(place)) {}

    bool has(const char* name) const { return primitive_.attributes.count(name) > 0; }

    Accessor attribute(const char* name) const {
        return Accessor(document_, primitive_.attributes.at(name), place_ + ".attributes." + name);
    }

    /// Empty where the primitive has no such attribute.
    template <class Vector>
    std::vector<Vector> vectors(const char* name, const Indices& chosen, std::size_t vertices,
                                int min_components = Vector::length()) const {
        if (!has(name)) return {};
        auto accessor = attribute(name);
        check(accessor, vertices, min_components, Vector::length());
        if (min_components != Vector::length()) accessor.set_normalised();  // colours
        return read_vectors<Vector>(accessor, &chosen);
    }

    std::vector<MorphTarget> targets(const Indices& chosen, std::size_t vertices) const {
        std::vector<MorphTarget> result;
        for (std::size_t i = 0; i < primitive_.targets.size(); ++i) {
            const auto& source = primitive_.targets[i];
            const auto deltas = [&](const char* name) -> std::vector<glm::vec3> {
                const auto found = source.find(name);
                if (found == source.end()) return {};
                const Accessor accessor(document_, found->second,
                                        place_ + "." + element("targets", i) + "." + name);
                check(accessor, vertices, 3, 3);
                return read_vectors<glm::vec3>(accessor, &chosen);
            };
            result.push_back({deltas("POSITION"), deltas("NORMAL"), deltas("TANGENT")});
        }
        return result;
    }

    /// Empty where the primitive has none.
    std::vector<Influences> influences(const Indices& chosen, std::size_t vertices) const {
        std::vector<Influences> result;
        int first = 0;
        for (const auto& [joints, weights] :
             {std::pair{"JOINTS_0", "WEIGHTS_0"}, std::pair{"JOINTS_1", "WEIGHTS_1"}}) {
            if (has(joints) != has(weights))
                throw InputError(
                    document_.file, place_ + ".attributes",
                    std::string("has only one of ") + joints + " and " + weights + "; export the file again");
            if (has(joints)) {
                result.resize(chosen.size());
                add_influences(result, first, joints, weights, chosen, vertices);
            }
            first += 4;
        }
        return result;
    }

  private:
    void check(const Accessor& accessor, std::size_t vertices, int min_components, int max_components) const {
        if (accessor.components() < min_components || accessor.components() > max_components)
            accessor.fail("has the wrong type; export the file again");
        if (accessor.count() != vertices)
            accessor.fail("has " + std::to_string(accessor.count()) + " elements, but POSITION has " +
                          std::to_string(vertices) + "; export the file again");
    }

    void add_influences(std::vector<Influences>& result, int first, const char* joints, const char* weights,
                        const Indices& chosen, std::size_t vertices) const {
        const auto joint_accessor = attribute(joints), weight_accessor = attribute(weights);
        check(joint_accessor, vertices, 4, 4);
        check(weight_accessor, vertices, 4, 4);
        const auto numbers = read_vectors<glm::vec4>(joint_accessor, &chosen);
        const auto parts = read_vectors<glm::vec4>(weight_accessor, &chosen);
        for (std::size_t i = 0; i < chosen.size(); ++i)
            for (int c = 0; c < 4; ++c) {
                if (!(numbers[i][c] >= 0 && numbers[i][c] <= UINT16_MAX))
                    joint_accessor.fail("has a joint beyond 65535; export the file again");
                if (parts[i][c] < 0) weight_accessor.fail("has a negative weight; export the file again");
                result[i].joints[static_cast<std::size_t>(first + c)] =
                    static_cast<std::uint16_t>(numbers[i][c]);
                result[i].weights[static_cast<std::size_t>(first + c)] = parts[i][c];
            }
    }

    const Document& document_;
    const tinygltf::Primitive& primitive_;
    std::string place_;
};

template <class Vector>
void gather(std::vector<Vector>& values, const Indices& order) {
    if (values.empty()) return;
    std::vector<Vector> result(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) result[i] = values[order[i]];
    values = std::move(result);
}

void gather(Mesh& mesh, const Indices& order) {
    gather(mesh.positions, order);
    gather(mesh.uv0, order);
    gather(mesh.uv1, order);
    gather(mesh.colours, order);
    gather(mesh.influences, order);
    for (auto& target : mesh.targets) gather(target.positions, order);
}

/// One vertex per corner, which makes generated normals flat: what glTF 2.0, 3.7.2.1 wants where there are
/// none.
void separate_triangles(Mesh& mesh) {
    gather(mesh, mesh.indices);
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    for (auto& target : mesh.targets) target.normals = target.tangents = {};
    mesh.is_faceted = true;
}

/// Unit normals; those without a direction are replaced by generated ones. Returns how many were.
std::size_t mend_normals(Mesh& mesh) {
    std::vector<std::size_t> broken;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const float length = glm::length(mesh.normals[i]);
        if (length > 1e-6f && std::isfinite(length))
            mesh.normals[i] /= length;
        else
            broken.push_back(i);
    }
    if (broken.empty()) return 0;
    const auto given = mesh.normals;
    generate_normals(mesh);
    auto generated = std::move(mesh.normals);
    mesh.normals = given;
    for (const auto i : broken) mesh.normals[i] = generated[i];
    return broken.size();
}

bool has_usable_tangents(const Mesh& mesh) {
    return !mesh.tangents.empty() && std::all_of(mesh.tangents.begin(), mesh.tangents.end(), [](glm::vec4 t) {
        return glm::length(glm::vec3(t)) > 1e-6f && t.w != 0;
    });
}

/// Tangents along the texture coordinates that the normal map uses.
void tangents_along(Mesh& mesh, int uv_set) {
    const bool second = uv_set == 1 && !mesh.uv1.empty();
    if (second) std::swap(mesh.uv0, mesh.uv1);
    generate_tangents(mesh);
    if (second) std::swap(mesh.uv0, mesh.uv1);
}

void complete_frames(Document& document, Mesh& mesh, int uv_set) {
    if (mesh.normals.empty()) {
        separate_triangles(mesh);
        mesh.tangents.clear();
        generate_normals(mesh);
    } else if (mend_normals(mesh) > 0) {
        document.warnings.add("mesh \"" + one_line(mesh.name) +
                              "\" has normals of length zero; they were generated");
    }
    if (has_usable_tangents(mesh)) {
        for (auto& t : mesh.tangents) t = glm::vec4(glm::normalize(glm::vec3(t)), t.w < 0 ? -1.0f : 1.0f);
    } else {
        tangents_along(mesh, uv_set);
    }
}

/// Makes weights add up to 1 [glTF 2.0, 3.7.3.3]. Vertices without any follow their first joint.
void complete_influences(Document& document, Mesh& mesh) {
    for (auto& each : mesh.influences) {
        const float sum = std::accumulate(each.weights.begin(), each.weights.end(), 0.0f);
        if (sum > 0 && std::isfinite(sum)) {
            for (auto& weight : each.weights) weight /= sum;
            continue;
        }
        each.weights = {1};
        document.warnings.add("mesh \"" + one_line(mesh.name) +
                              "\" has vertices without weights; they follow their first joint");
    }
}

std::map<int, int> variant_materials(const tinygltf::Primitive& primitive) {
    std::map<int, int> result;
    const auto extension = primitive.extensions.find(materials_variants);
    if (extension == primitive.extensions.end() || !extension->second.Has("pairs")) return result;
    const auto& pairs = extension->second.Get("pairs");
    for (std::size_t i = 0; i + 1 < pairs.ArrayLen(); i += 2)
        result[pairs.Get(static_cast<int>(i)).GetNumberAsInt()] =
            pairs.Get(static_cast<int>(i + 1)).GetNumberAsInt();
    return result;
}

/// Of a skin and morph targets.
std::size_t bytes_of_deformation(const tinygltf::Primitive& primitive, std::size_t vertices) {
    const auto has = [&](const char* name) { return primitive.attributes.contains(name); };
    std::size_t bytes = has("JOINTS_0") || has("JOINTS_1") ? sizeof(Influences) : 0;
    for (const auto& target : primitive.targets) bytes += target.size() * sizeof(glm::vec3);
    return vertices * bytes;
}

Mesh load_primitive(Document& document, const tinygltf::Primitive& primitive, ExpansionBudget& budget,
                    const std::string& name, const std::string& place, int normal_uv_set) {
    const PrimitiveReader reader(document, primitive, place);
    const auto vertices = reader.attribute("POSITION").count();
    const auto order = corners(document, primitive, vertices, budget, place);
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && order.size() % 3 != 0)
        document.warnings.add(place + " has corners left over after its last triangle");
    Mesh mesh;
    mesh.name = name;
    mesh.indices = triangles(order, primitive.mode);
    const auto used = drawn_vertices(mesh.indices, vertices);
    mesh.positions = reader.vectors<glm::vec3>("POSITION", used, vertices);
    mesh.normals = reader.vectors<glm::vec3>("NORMAL", used, vertices);
    mesh.tangents = reader.vectors<glm::vec4>("TANGENT", used, vertices);
    mesh.uv0 = reader.vectors<glm::vec2>("TEXCOORD_0", used, vertices);
    mesh.uv1 = reader.vectors<glm::vec2>("TEXCOORD_1", used, vertices);
    mesh.colours = reader.vectors<glm::vec4>("COLOR_0", used, vertices, 3);
    budget.spend(bytes_of_deformation(primitive, mesh.indices.size()), place);
    mesh.influences = reader.influences(used, vertices);
    mesh.targets = reader.targets(used, vertices);
    complete_influences(document, mesh);
    if (mesh.uv0.empty()) mesh.uv0.assign(mesh.positions.size(), glm::vec2(0));
    complete_frames(document, mesh, normal_uv_set);
    return mesh;
}

bool is_drawn(Document& document, const tinygltf::Primitive& primitive, const std::string& place) {
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        document.warnings.add("points and lines are not drawn");
        return false;
    }
    if (primitive.attributes.count("POSITION") == 0) {
        document.warnings.add(place + " has no positions and is not drawn");
        return false;
    }
    return true;
}

}  // namespace

std::vector<std::vector<int>> load_meshes(Document& document, Scene& scene, int default_material) {
    ExpansionBudget budget(document);
    std::vector<std::vector<int>> result;
    for (std::size_t m = 0; m < document.model.meshes.size(); ++m) {
        const auto& source = document.model.meshes[m];
        auto& meshes = result.emplace_back();
        for (std::size_t p = 0; p < source.primitives.size(); ++p) {
            const auto& primitive = source.primitives[p];
            const auto place = element("meshes", m) + "." + element("primitives", p);
            if (!is_drawn(document, primitive, place)) continue;
            const int material = primitive.material >= 0 ? primitive.material : default_material;
            auto mesh = load_primitive(document, primitive, budget, source.name, place,
                                       scene.materials[material].normal_texture.uv_set);
            if (mesh.indices.empty()) continue;
            mesh.material = material;
            mesh.variant_materials = variant_materials(primitive);
            meshes.push_back(static_cast<int>(scene.meshes.size()));
            scene.meshes.push_back(std::move(mesh));
        }
    }
    return result;
}

}  // namespace ir::scene::gltf
