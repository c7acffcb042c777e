#pragma once

#include <cmath>

#include "renderers/scene/builtin/detail.h"
#include "renderers/scene/builtin/mesh_builder.h"

/// Measures and parts of the corridor; metres. Three halls in a row along x.
namespace ir::scene::builtin::corridor_parts {

constexpr float hall_length = 6, hall_height = 3.2f, hall_half = 2;  ///< half: in z
constexpr float wall = 0.3f;                                         ///< thickness
/// Where hall 0, 1 or 2 begins.
constexpr float hall_start(int hall) {
    return hall * (hall_length + wall);
}
constexpr float duration = 8;  ///< seconds of the lamp's flight

/// An opening in the wall behind a hall, from the floor up.
struct Doorway {
    int hall;
    float low_z, high_z, height;
};
constexpr Doorway doorways[2] = {{0, -1.5f, -0.1f, 2.2f}, {1, 0.2f, 1.4f, 2.1f}};

void add_halls(Scene& scene);
void add_things(Scene& scene, const Detail& detail);             // what stands in the halls
void add_lamp(Scene& scene, const Detail& detail, float speed);  // with its light and its flight
void add_door(Scene& scene, const Detail& detail, float speed);  // in the second doorway

}  // namespace ir::scene::builtin::corridor_parts
