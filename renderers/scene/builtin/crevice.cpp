// Light leaking through thin walls. A solid block of 2.4 × 0.8 × 1.2 m (diagonal 2.8 m) holds four chambers
// that are open to nothing. All their walls are at least 0.16 m thick except the one at the front (+z): its
// thickness is 4, 2, 1 and ½ times the option `texel`, from left to right, and outside it is the open sky.
//
// From every point in a chamber the accessibility with unlimited distance is exactly 0, so the mean over a
// camera's picture is the *leaked fraction*. Maps that store surfaces at texel centres leak where the centre
// of the texel that a point falls into lies beyond the wall: on the thin wall's inner face for directions
// along it, and beside it on its neighbours. The cameras look at that face and its surroundings from the
// chamber's back.
//
// A map that spreads r texels over the diagonal of the scene's bounds has texels of 2.8 m / r; the default of
// 0.014 m belongs to r = 200. For other resolutions set texel = 2.8 / r.

#include "renderers/scene/builtin/mesh_builder.h"
#include "renderers/scene/builtin/registry.h"

namespace ir::scene::builtin {
namespace crevice_scene {

constexpr glm::vec3 block_size{2.4f, 0.8f, 1.2f};
constexpr float thick = 0.16f;         ///< of all walls but the thin ones, metres
constexpr float chamber_width = 0.4f;  ///< 4 chambers and 5 walls make 2.4 m

struct Chamber {
    const char* name;
    float texels;  ///< thickness of its front wall
};
constexpr Chamber chambers[] = {{"wall-4", 4}, {"wall-2", 2}, {"wall-1", 1}, {"wall-half", 0.5f}};

Scene make(const Values& values) {
    Scene scene;
    const int outside = add_material(scene, "block", {0.55f, 0.57f, 0.6f});
    const int inside = add_material(scene, "chamber", {0.75f, 0.6f, 0.45f});
    const auto texel = static_cast<float>(values.at("texel"));
    const glm::vec3 half = 0.5f * block_size;
    MeshBuilder b;
    b.box(-half, half);
    add_mesh(scene, b.take("block", outside));
    float x = -half.x + thick;
    for (const auto& chamber : chambers) {
        const glm::vec3 low{x, -half.y + thick, -half.z + thick};
        const glm::vec3 high{x + chamber_width, half.y - thick, half.z - chamber.texels * texel};
        b.cavity(low, high);
        add_mesh(scene, b.take(chamber.name, inside));
        const float middle = 0.5f * (low.x + high.x);
        add_camera(scene, chamber.name, {middle, 0, low.z + 0.05f}, {middle, 0, high.z}, 40);
        x += chamber_width + thick;
    }
    add_camera(scene, "outside", {1.2f, 1.4f, 2.6f}, {0, 0, 0}, 45);
    scene.lights.push_back(sun({-0.4f, -0.7f, -0.6f}, 3));
    return scene;
}

}  // namespace crevice_scene

Description crevice() {
    return {"crevice",
            1,
            "Four closed chambers behind walls of 4, 2, 1 and ½ texel: whatever is open there has leaked.",
            {{"texel", 0.014, 0.0005, 0.03, "m", "size of a map's texel; 2.8 m / resolution"}},
            crevice_scene::make};
}

}  // namespace ir::scene::builtin
