#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "projects/json.h"
#include "projects/object_reader.h"

namespace ir::projects {

/// What a part of a scene changes of one material; absent members stay as the file has them. These are
/// factors: textures of the material still multiply them.
struct MaterialOverride {
    std::optional<glm::dvec4> base_colour;  ///< linear RGBA, each from 0 to 1
    std::optional<double> metallic, roughness;
    std::optional<glm::dvec3> emission;  ///< W/(m² sr)
    std::optional<double> normal_scale, ior, transmission;
    Json extra = Json::object();
    bool operator==(const MaterialOverride&) const = default;
};

/// Throws UsageError for values out of range; `where` begins the message.
void validate(const MaterialOverride& change, const std::string& where);

/// Throws InputError with the place of what is wrong.
MaterialOverride read_material_override(ObjectReader& reader);

/// Members in a fixed order; only known ones.
Json to_json(const MaterialOverride& change);

}  // namespace ir::projects
