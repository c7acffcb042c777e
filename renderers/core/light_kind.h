#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renderers/core/condition.h"

namespace ir {

/// What emits light, as far as methods differ in it.
enum class LightKind {
    punctual,    ///< point, spot and directional lights
    lamp,        ///< rectangle and disk lights
    surface,     ///< emissive meshes
    environment  ///< a constant or a map
};
inline constexpr std::size_t light_kinds = 4;

/// How light comes into a picture.
enum class LightPart {
    seen,      ///< a source as it is seen; the environment's background counts nowhere, as it is not valid
    direct,    ///< one scattering
    indirect,  ///< more than one
};
inline constexpr std::size_t light_parts = 3;

/// As files have it: "lamp", "indirect".
std::string to_string(LightKind kind);
std::string to_string(LightPart part);
/// For people: "rectangle and disk lights", "indirect light".
std::string text_of(LightKind kind);
std::string text_of(LightPart part);

/// Light that a method's picture lacks although its transport has it.
struct MissingLight {
    std::vector<LightPart> parts;
    std::vector<LightKind> kinds;
    std::vector<Condition> active_when = {};  ///< where any does not hold it is there
};

/// One source of a scene: "light 'lamp'", "material 'neon'", "the environment".
struct LightSource {
    LightKind kind = LightKind::punctual;
    std::string name;
    bool operator==(const LightSource&) const = default;
};

/// A source of a picture, and which parts of its light are in it.
struct UsedLight {
    LightSource source;
    std::vector<LightPart> parts;
    bool operator==(const UsedLight&) const = default;
};

}  // namespace ir
