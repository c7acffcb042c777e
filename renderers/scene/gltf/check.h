#pragma once

#include <string>
#include <vector>

#include "renderers/core/report.h"
#include "renderers/scene/gltf/checked_object.h"
#include "renderers/scene/scene.h"

/// Checks of a parsed document before tinygltf sees it: types, required members, references, ranges. Each
/// check copies what it understood to `checked`; extras and unknown extensions stay behind.
namespace ir::scene::gltf {

/// Names of extensions that stand in more than one file.
inline constexpr const char* gpu_instancing = "EXT_mesh_gpu_instancing";
inline constexpr const char* meshopt_compression = "EXT_meshopt_compression";
inline constexpr const char* draco_compression = "KHR_draco_mesh_compression";
inline constexpr const char* materials_variants = "KHR_materials_variants";

/// Warnings in the order in which they came, each text once.
class Warnings {
  public:
    void add(const std::string& text);
    std::vector<Message> messages;
};

struct Checking {
    const std::string& file;
    const Json& source;
    Warnings& warnings;
    Json checked = Json::object();
    /// Per accessor: why it cannot be read; empty where it can. Unused accessors may be odd.
    std::vector<std::string> accessor_problems;
    std::vector<std::string> variants;  ///< names of KHR_materials_variants

    /// Number of elements of a top-level array; throws InputError where it is something else.
    std::size_t count(const char* array) const;
    /// Elements of a top-level array, each checked by `check(CheckedObject&)`, to `checked`.
    template <class Check>
    void for_each(const char* array, Check check) {
        for (std::size_t i = 0; i < count(array); ++i) {
            CheckedObject object(file, element(array, i), source[array][i]);
            check(object);
            checked[array].push_back(std::move(object.result));
        }
    }
};

void check_asset(Checking& checking);
std::vector<Extension> check_extensions(Checking& checking);  ///< those that the file uses
void check_buffer_views(Checking& checking);
void check_accessors(Checking& checking);
void check_textures(Checking& checking);  ///< with samplers
void check_materials(Checking& checking);
void check_variants(Checking& checking);  ///< their names
void check_meshes(Checking& checking);    ///< after the variants
void check_skins(Checking& checking);
void check_nodes(Checking& checking);  ///< with scenes, after the meshes
void check_cameras(Checking& checking);
void check_lights(Checking& checking);
void check_animations(Checking& checking);

}  // namespace ir::scene::gltf
