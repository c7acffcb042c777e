#include "tests/fuzz/scene/attempts.h"

#include "renderers/core/error.h"
#include "renderers/scene/gltf/scene_parts.h"
#include "renderers/scene/world.h"
#include "tests/fuzz/require.h"

namespace ir::fuzz {
namespace {

void check_world(const scene::Scene& scene) {
    const auto world = scene::flatten(scene, 0.5, 0);
    for (const auto index : world.indices)
        require(index < world.positions.size(), "an index beyond the vertices");
    for (const auto material : world.triangle_materials)
        require(material < scene.materials.size(), "a material that is not there");
    require(world.normals.size() == world.positions.size(), "not a normal for each vertex");
}

}  // namespace

bool loads_scene(const std::string& file, bool wants_camera) {
    constexpr std::size_t many_triangles = 100'000;  // instances multiply
    try {
        const auto scene = wants_camera ? scene::load_gltf(file) : scene::gltf::load_without_camera(file);
        if (scene.instanced_triangles() < many_triangles) check_world(scene);
        return true;
    } catch (const InputError& error) {
        require_one_line(error.what(), file + ": ");
        return false;
    }
}

}  // namespace ir::fuzz
