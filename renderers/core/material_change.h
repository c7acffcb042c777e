#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderers/core/fields.h"

namespace ir {

/// What is changed of a material; absent members stay as the file has them. These are factors: the material's
/// textures still multiply them, so a base colour tints a textured surface and paints an untextured one.
struct MaterialChange {
    std::optional<glm::dvec4> base_colour;  ///< linear RGBA, each from 0 to 1
    std::optional<double> metallic, roughness;
    std::optional<glm::dvec3> emission;  ///< W/(m² sr)
    std::optional<double> normal_scale, ior, transmission;
    IR_FIELDS(base_colour, metallic, roughness, emission, normal_scale, ior, transmission)
    bool operator==(const MaterialChange&) const = default;
};

}  // namespace ir
