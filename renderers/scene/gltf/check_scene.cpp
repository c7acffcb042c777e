#include <algorithm>
#include <set>

#include "renderers/core/error.h"
#include "renderers/scene/gltf/check.h"
#include "renderers/scene/gltf/source.h"

namespace ir::scene::gltf {
namespace {

void check_attributes(Checking& checking, CheckedObject& primitive) {
    static const std::set<std::string> understood{"POSITION",   "NORMAL",  "TANGENT",  "TEXCOORD_0",
                                                  "TEXCOORD_1", "COLOR_0", "JOINTS_0", "WEIGHTS_0"};
    CheckedObject attributes(checking.file, primitive.place("attributes"),
                             primitive.required_object("attributes"));
    const auto& source = primitive.required_object("attributes");
    for (const auto& [name, unused] : source.items())
        if (understood.contains(name))
            attributes.index(name.c_str(), checking.count("accessors"), "accessors");
    primitive.result["attributes"] = attributes.result;
}

void check_primitives(Checking& checking, CheckedObject& mesh) {
    const auto* primitives = mesh.array("primitives");
    if (!primitives) mesh.fail("primitives", "is missing; export the file again");
    mesh.result["primitives"] = Json::array();
    for (std::size_t i = 0; i < primitives->size(); ++i) {
        CheckedObject primitive(checking.file, mesh.place(element("primitives", i)), (*primitives)[i]);
        check_attributes(checking, primitive);
        primitive.index("indices", checking.count("accessors"), "accessors");
        primitive.result.erase("indices");  // see restore_indices in document.cpp
        primitive.index("material", checking.count("materials"), "materials");
        primitive.integer("mode", 0, 6);
        if (const auto* targets = primitive.array("targets"); targets && !targets->empty())
            checking.warnings.add("morph targets are ignored; meshes keep their rest pose");
        mesh.result["primitives"].push_back(primitive.result);
    }
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
    });
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
        node.index("mesh", checking.count("meshes"), "meshes");
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
