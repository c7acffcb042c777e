#pragma once

#include <cmath>

#include "renderers/scene/builtin/detail.h"
#include "renderers/scene/builtin/mesh_builder.h"

/// Measures and parts of the still life; metres.
namespace ir::scene::builtin::still_life_parts {

/// Middle of the table's top.
constexpr glm::vec3 table_top{-0.1f, 0.74f, -0.5f};
constexpr glm::vec2 table_half{0.78f, 0.46f};

void add_table(Scene& scene, const Detail& detail);    // with its cloth
void add_fruit(Scene& scene, const Detail& detail);    // in a bowl on the cloth
void add_vessels(Scene& scene, const Detail& detail);  // teapot, bottle, candlestick
void add_shapes(Scene& scene, const Detail& detail);   // balls and rings, from smooth metal to dull plastic

/// Appends a material; `metallic` is 0 or 1.
int add_surface(Scene& scene, const std::string& name, glm::vec3 colour, float roughness, float metallic = 0);

}  // namespace ir::scene::builtin::still_life_parts
