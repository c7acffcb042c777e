// `interreflect-cli scene`: what a scene holds, and what is done about it.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/engine/camera_pose.h"
#include "projects/text.h"
#include "renderers/passes/lights/emitted_power.h"
#include "renderers/scene/light_sources.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;

template <class Vector>
Json vector_json(const Vector& v) {
    Json list = Json::array();
    for (int i = 0; i < Vector::length(); ++i) list.push_back(v[i]);
    return list;
}

Json textures_of(const scene::Material& material) {
    Json json = Json::object();
    const auto add = [&](const char* key, const scene::TextureSlot& slot) {
        if (slot.texture >= 0) json[key] = slot.texture;
    };
    add("base_colour", material.base_colour_texture);
    add("metallic_roughness", material.metallic_roughness_texture);
    add("normal", material.normal_texture);
    add("emission", material.emission_texture);
    add("transmission", material.transmission_texture);
    return json;
}

Json material_json(const scene::Material& material, std::size_t triangles) {
    Json json{{"name", material.name},
              {"triangles", triangles},
              {"base_colour", vector_json(material.base_colour)},
              {"metallic", material.metallic},
              {"roughness", material.roughness},
              {"emission", vector_json(material.emission)},
              {"alpha_mask", material.alpha_mode == scene::AlphaMode::mask},
              {"unlit", material.unlit},
              {"transmission", material.transmission},
              {"ior", material.ior},
              {"thickness", material.thickness},
              {"textures", textures_of(material)}};
    return json;
}

Json materials_json(const scene::Scene& scene, const scene::World& world) {
    std::vector<std::size_t> triangles(scene.materials.size());
    for (const auto& range : world.ranges)
        triangles[static_cast<std::size_t>(range.material)] += range.triangle_count;
    Json list = Json::array();
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        list.push_back(material_json(scene.materials[i], triangles[i]));
    return list;
}

Json emitters_json(const scene::Scene& scene, const scene::World& world) {
    const passes::EntryBox box(world.bounds);
    Json list = Json::array();
    scene::for_each_light_source(
        scene, world.lights, scene.environment, [&](const LightSource& source, std::size_t i) {
            const float power = source.kind == LightKind::environment
                                    ? passes::emitted_power(scene.environment, box)
                                : source.kind == LightKind::surface
                                    ? passes::emitted_power_of_material(scene, world, static_cast<int>(i))
                                    : passes::emitted_power(world.lights[i], box);
            list.push_back(
                {{"source", source.name}, {"kind", to_string(source.kind)}, {"power_watts", power}});
        });
    return list;
}

Json textures_json(const scene::Scene& scene) {
    Json list = Json::array();
    for (const auto& texture : scene.textures)
        list.push_back({{"name", texture.name},
                        {"size", {texture.width, texture.height}},
                        {"srgb", texture.srgb},
                        {"memory_bytes", texture.rgba.size()}});
    return list;
}

Json cameras_json(const scene::World& world) {
    Json list = Json::array();
    for (const auto& camera : world.cameras) {
        Json json{{"name", camera.name}};
        json.update(engine::camera_json(camera));
        json["made_up"] = camera.is_made_up;
        list.push_back(std::move(json));
    }
    return list;
}

std::size_t texture_bytes(const scene::Scene& scene) {
    std::size_t bytes = 0;
    for (const auto& texture : scene.textures) bytes += texture.rgba.size();
    return bytes;
}

/// Of all meshes.
std::size_t morph_targets(const scene::Scene& scene) {
    std::size_t count = 0;
    for (const auto& mesh : scene.meshes) count += mesh.targets.size();
    return count;
}

Json scene_json(const scene::Scene& scene) {
    const auto world = scene::flatten(scene, 0, 0);
    Json json{
        {"schema_version", 1},  // projects/schemas/scene.schema.json
        {"name", scene.name},
        {"content_hash", scene.content_hash},
        {"triangles", scene.primitive_triangles()},
        {"instanced_triangles", scene.instanced_triangles()},
        {"nodes", scene.nodes.size()},
        {"skins", scene.skins.size()},
        {"morph_targets", morph_targets(scene)},
        {"animated", scene.is_animated()},
        {"duration", scene.duration()},
        {"bounds", {{"min", vector_json(world.bounds.min)}, {"max", vector_json(world.bounds.max)}}},
        {"memory_bytes", {{"triangles", scene::memory_bytes(world)}, {"textures", texture_bytes(scene)}}},
        {"materials", materials_json(scene, world)},
        {"textures", textures_json(scene)},
        {"emitters", emitters_json(scene, world)},
        {"cameras", cameras_json(world)}};
    json["variants"] = scene.variants;
    json["extensions"] = Json::array();
    for (const auto& each : scene.extensions)
        json["extensions"].push_back({{"name", each.name}, {"read", each.is_read}, {"text", each.treatment}});
    json["warnings"] = Json::array();
    for (const auto& warning : scene.warnings) json["warnings"].push_back(warning.text);
    return json;
}

/// Numbers with what a person reads of them; members of objects by name, but for those that say no.
std::string text_of(const Json& value) {
    constexpr std::size_t longest = 400;
    if (value.is_string()) return projects::printable(value.get<std::string>(), longest);
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_number_float()) {
        char number[32];
        std::snprintf(number, sizeof number, "%.4g", value.get<double>());
        return number;
    }
    if (!value.is_structured()) return value.dump();
    std::string text;
    for (const auto& [key, member] : value.items()) {
        if (value.is_array()) {
            text += (text.empty() ? "" : " ") + text_of(member);
        } else if (member.is_boolean()) {
            if (member.get<bool>()) text += (text.empty() ? "" : ", ") + key;
        } else if (!member.is_structured() || !member.empty()) {
            text += (text.empty() ? "" : ", ") + key + " " + text_of(member);
        }
    }
    return text;
}

/// A line of its own for what has a name.
std::string line_of(Json item) {
    if (!item.is_object()) return text_of(item);
    if (item.contains("read"))
        return text_of(item["name"]) + (item["read"].get<bool>() ? ": read: " : ": ignored: ") +
               text_of(item["text"]);
    const auto name = text_of(item.begin().value());
    item.erase(item.begin());
    return (name.empty() ? "(no name)" : name) + ": " + text_of(item);
}

int print_scene(const std::string& name, bool as_json) {
    const auto json = scene_json(scene::load_scene(name));
    if (as_json) {
        std::cout << json.dump(2) << "\n";
        return done;
    }
    for (const auto& [key, value] : json.items()) {
        if (key == "schema_version") continue;
        const bool is_list = value.is_array();
        std::cout << key << ": " << (is_list ? std::to_string(value.size()) : text_of(value)) << "\n";
        if (!is_list) continue;
        for (const auto& item : value) std::cout << "  " << line_of(item) << "\n";
    }
    return done;
}

}  // namespace

void add_scene(CLI::App& app, Run& run) {
    struct Flags {
        std::string scene;
        bool json = false;
    };
    auto flags = std::make_shared<Flags>();
    auto* command = app.add_subcommand(
        "scene",
        "What a scene holds: materials, emitters with their power, cameras, textures, memory, and what is done "
        "about the glTF extensions that it uses");
    command->add_option("SCENE", flags->scene, "A .gltf or .glb file, or builtin:NAME")->required();
    add_json_flag(*command, flags->json);
    add_outside_flag(*command);
    command->callback([flags, &run] { run = [flags] { return print_scene(flags->scene, flags->json); }; });
}

}  // namespace ir::cli
