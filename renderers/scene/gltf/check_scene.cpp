#include <algorithm>
#include <set>

#include "renderers/core/error.h"
#include "renderers/scene/gltf/check.h"
#include "renderers/scene/gltf/source.h"

namespace ir::scene::gltf {
namespace {

std::size_t target_count(const Json& primitive) {
    const auto targets = primitive.find("targets");
    return targets == primitive.end() ? 0 : targets->size();
}

/// References to accessors by the names of `understood`.
Json checked_attributes(Checking& checking, const std::string& place, const Json& source,
                        const std::set<std::string>& understood) {
    CheckedObject attributes(checking.file, place, source);
    for (const auto& [name, unused] : source.items())
        if (understood.contains(name))
            attributes.index(name.c_str(), checking.count("accessors"), "accessors");
    return attributes.result;
}

void check_targets(Checking& checking, CheckedObject& primitive) {
    static const std::set<std::string> understood{"POSITION", "NORMAL", "TANGENT"};
    const auto* targets = primitive.array("targets");
    if (!targets || targets->empty()) return;
    for (std::size_t i = 0; i < targets->size(); ++i)
        primitive.result["targets"].push_back(
            checked_attributes(checking, primitive.place(element("targets", i)), (*targets)[i], understood));
}

/// Leaves the mappings of a primitive as one list: variant, material, variant, material, …
void check_mappings(Checking& checking, CheckedObject& primitive) {
    const auto* source = primitive.extension(materials_variants);
    const auto count = checking.variants.size();
    if (!source || count == 0) return;
    const CheckedObject extension(checking.file,
                                  primitive.place(std::string("extensions.") + materials_variants), *source);
    const auto* mappings = extension.array("mappings");
    if (!mappings) extension.fail("mappings", "is missing; export the file again");
    auto pairs = Json::array();
    for (std::size_t i = 0; i < mappings->size(); ++i) {
        CheckedObject mapping(checking.file, extension.place(element("mappings", i)), (*mappings)[i]);
        const int material =
            mapping.required(mapping.index("material", checking.count("materials"), "materials"), "material");
        for (const int variant :
             mapping.required(mapping.indices("variants", count, "variants"), "variants")) {
            pairs.push_back(variant);
            pairs.push_back(material);
        }
    }
    primitive.result["extensions"][materials_variants]["pairs"] = std::move(pairs);
}

void check_primitives(Checking& checking, CheckedObject& mesh) {
    static const std::set<std::string> understood{"POSITION",   "NORMAL",   "TANGENT",  "TEXCOORD_0",
                                                  "TEXCOORD_1", "COLOR_0",  "JOINTS_0", "JOINTS_1",
                                                  "WEIGHTS_0",  "WEIGHTS_1"};
    const auto* primitives = mesh.array("primitives");
    if (!primitives) mesh.fail("primitives", "is missing; export the file again");
    auto& checked = mesh.result["primitives"] = Json::array();
    for (std::size_t i = 0; i < primitives->size(); ++i) {
        CheckedObject primitive(checking.file, mesh.place(element("primitives", i)), (*primitives)[i]);
        const auto& attributes = primitive.required_object("attributes");
        for (const auto& [name, unused] : attributes.items())
            if (name.starts_with("JOINTS_") && !understood.contains(name))
                checking.warnings.add("joints beyond the eighth of a vertex are ignored");
        primitive.result["attributes"] =
            checked_attributes(checking, primitive.place("attributes"), attributes, understood);
        primitive.index("indices", checking.count("accessors"), "accessors");
        primitive.result.erase("indices");  // see restore_indices in document.cpp
        primitive.index("material", checking.count("materials"), "materials");
        primitive.integer("mode", 0, 6);
        check_targets(checking, primitive);
        check_mappings(checking, primitive);
        checked.push_back(primitive.result);
        if (target_count(checked.back()) != target_count(checked.front()))
            primitive.fail("targets",
                           "are not as many as in the mesh's other primitives; export the file again");
    }
}

/// Of a mesh or node, one for each morph target.
void check_weights(CheckedObject& object, std::size_t targets) {
    const auto* weights = object.array("weights");
    if (!weights || weights->empty()) return;
    if (weights->size() != targets)
        object.fail("weights", "are " + std::to_string(weights->size()) + ", but the mesh has " +
                                   std::to_string(targets) + " morph targets; export the file again");
    object.numbers("weights", targets);
}

/// Every node has one parent at most and none is its own ancestor.
void check_tree(const Checking& checking, const std::vector<std::vector<int>>& children) {
    std::vector<int> parent(children.size(), -1);
    for (std::size_t i = 0; i < children.size(); ++i)
        for (const int child : children[i]) {
            if (parent[child] >= 0 || child == static_cast<int>(i))
                throw InputError(
                    checking.file, element("nodes", i) + ".children",
                    element("nodes", child) + " has two parents or itself; export the file again");
            parent[child] = static_cast<int>(i);
        }
    std::vector<int> reached;
    for (std::size_t i = 0; i < children.size(); ++i)
        if (parent[i] < 0) reached.push_back(static_cast<int>(i));
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (const int child : children[reached[i]]) reached.push_back(child);
    if (reached.size() != children.size())
        throw InputError(checking.file, "nodes", "some nodes are their own ancestors; export the file again");
}

void check_spot(Checking& checking, CheckedObject& light) {
    static const Json none = Json::object();
    const auto* source = light.object("spot");
    CheckedObject spot(checking.file, light.place("spot"), source ? *source : none);
    spot.number("innerConeAngle");
    spot.number("outerConeAngle");
    light.result["spot"] = spot.result;
}

}  // namespace

void check_meshes(Checking& checking) {
    checking.for_each("meshes", [&](CheckedObject& mesh) {
        mesh.text("name");
        check_primitives(checking, mesh);
        const auto& primitives = mesh.result["primitives"];
        check_weights(mesh, primitives.empty() ? 0 : target_count(primitives.front()));
    });
}

void check_skins(Checking& checking) {
    checking.for_each("skins", [&](CheckedObject& skin) {
        skin.text("name");
        if (skin.required(skin.indices("joints", checking.count("nodes"), "nodes"), "joints").empty())
            skin.fail("joints", "is empty; export the file again");
        skin.index("inverseBindMatrices", checking.count("accessors"), "accessors");
    });
}

void check_variants(Checking& checking) {
    const auto* source = CheckedObject(checking.file, "", checking.source).extension(materials_variants);
    if (!source) return;
    const CheckedObject extension(checking.file, std::string("extensions.") + materials_variants, *source);
    const auto* variants = extension.array("variants");
    if (!variants) extension.fail("variants", "is missing; export the file again");
    for (std::size_t i = 0; i < variants->size(); ++i) {
        CheckedObject variant(checking.file, extension.place(element("variants", i)), (*variants)[i]);
        checking.variants.push_back(one_line(variant.required(variant.text("name"), "name")));
    }
}

void check_nodes(Checking& checking) {
    std::vector<std::vector<int>> children;
    const auto* extensions =
        CheckedObject(checking.file, "", checking.source).extension("KHR_lights_punctual");
    const auto lights = extensions && extensions->contains("lights") ? (*extensions)["lights"].size() : 0;
    const auto check_instances = [&](CheckedObject& node, const Json& source) {
        CheckedObject extension(checking.file, node.place(std::string("extensions.") + gpu_instancing),
                                source);
        CheckedObject attributes(checking.file, extension.place("attributes"),
                                 extension.required_object("attributes"));
        for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"})
            attributes.index(name, checking.count("accessors"), "accessors");
        node.result["extensions"][gpu_instancing] = attributes.result;
    };
    checking.for_each("nodes", [&](CheckedObject& node) {
        node.text("name");
        node.index("camera", checking.count("cameras"), "cameras");
        const auto mesh = node.index("mesh", checking.count("meshes"), "meshes");
        if (mesh) {
            const auto& primitives =
                checking.checked["meshes"][static_cast<std::size_t>(*mesh)]["primitives"];
            check_weights(node, primitives.empty() ? 0 : target_count(primitives.front()));
        }
        node.index("skin", checking.count("skins"), "skins");
        node.numbers("matrix", 16);
        node.numbers("translation", 3);
        node.numbers("rotation", 4);
        node.numbers("scale", 3);
        children.push_back(
            node.indices("children", checking.count("nodes"), "nodes").value_or(std::vector<int>{}));
        if (const auto* source = node.extension("KHR_lights_punctual")) {
            CheckedObject extension(checking.file, node.place("extensions.KHR_lights_punctual"), *source);
            extension.required(extension.index("light", lights, "lights"), "light");
            node.result["extensions"]["KHR_lights_punctual"] = extension.result;
        }
        if (const auto* source = node.extension(gpu_instancing)) check_instances(node, *source);
    });
    check_tree(checking, children);
    checking.for_each("scenes", [&](CheckedObject& scene) {
        scene.text("name");
        scene.indices("nodes", checking.count("nodes"), "nodes");
    });
    CheckedObject document(checking.file, "", checking.source);
    if (const auto scene = document.index("scene", checking.count("scenes"), "scenes"))
        checking.checked["scene"] = *scene;
}

void check_cameras(Checking& checking) {
    checking.for_each("cameras", [&](CheckedObject& camera) {
        camera.text("name");
        const auto type = camera.required(camera.text("type"), "type");
        if (type != "perspective" && type != "orthographic")
            camera.fail("type", "must be perspective or orthographic");
        CheckedObject lens(checking.file, camera.place(type), camera.required_object(type.c_str()));
        for (const auto* key : type == "perspective" ? std::vector{"yfov"} : std::vector{"xmag", "ymag"})
            if (lens.required(lens.number(key), key) == 0) lens.fail(key, "must not be zero");
        // tinygltf wants clipping planes; ours enclose the scene's bounds instead.
        lens.result["znear"] = 0.1;
        lens.result["zfar"] = 100.0;
        camera.result[type] = lens.result;
    });
}

void check_lights(Checking& checking) {
    CheckedObject document(checking.file, "", checking.source);
    const auto* extension = document.extension("KHR_lights_punctual");
    if (!extension) return;
    CheckedObject owner(checking.file, "extensions.KHR_lights_punctual", *extension);
    const auto* lights = owner.array("lights");
    if (!lights) owner.fail("lights", "is missing; export the file again");
    auto& checked = checking.checked["extensions"]["KHR_lights_punctual"]["lights"] = Json::array();
    for (std::size_t i = 0; i < lights->size(); ++i) {
        CheckedObject light(checking.file, owner.place(element("lights", i)), (*lights)[i]);
        light.text("name");
        light.numbers("color", 3);
        light.number("intensity");
        light.number("range");
        if (light.required(light.text("type"), "type") == "spot") check_spot(checking, light);
        checked.push_back(light.result);
    }
}

}  // namespace ir::scene::gltf
