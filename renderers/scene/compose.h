#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderers/core/material_change.h"
#include "renderers/scene/scene.h"

namespace ir::scene {

/// Where a part stands over time: T R S in place of its transform, linear between keys (rotations on the
/// shortest arc), clamped at the ends.
struct PartMotion {
    struct Key {
        float time = 0;  ///< seconds, ascending
        glm::vec3 translation{0};
        glm::quat rotation{1, 0, 0, 0};
        glm::vec3 scale{1};
        bool operator==(const Key&) const = default;
    };
    std::vector<Key> keys;
    bool loop = false;
    bool operator==(const PartMotion&) const = default;
};

/// A scene as a part of a composed one.
struct Part {
    std::string source;                                    ///< as load_scene() takes it
    glm::mat4 transform{1};                                ///< affine, of the whole part, metres
    std::map<std::string, MaterialChange> materials = {};  ///< by the material's name
    PartMotion motion = {};    ///< without keys the part stands still; else `transform` does not count
    std::string variant = {};  ///< one of Scene::variants; empty: the default materials
    bool operator==(const Part&) const = default;
};

using SceneLoader = std::function<std::shared_ptr<const Scene>(const std::string&)>;

/// Loads all parts and makes one scene of them. One part without transform and overrides is exactly
/// load_scene(source). Otherwise:
/// - above the nodes of each part stands one more, named after its source, with the part's transform or,
///   where it moves, an animation of its own;
/// - lights and cameras whose names are taken get new ones: "lamp (2)";
/// - cameras that only frame a file without cameras give way to the other parts' cameras, or, where there
///   are none, to one that frames the whole;
/// - the environment is that of the first part that has one;
/// - a part's lights and cameras move with it, lights of a part with a motion hang on its node; sizes of area
/// lights and heights of orthographic cameras that
///   hang on no node scale by the cube root of the transform's volume;
/// - `variant` chooses materials [KHR_materials_variants]; a part whose file has no variants keeps its
/// materials, but at least one part that names a variant must have it;
/// - an override that names no material of its part is a warning which lists the known names.
/// Throws as load_scene(), and UsageError for values out of range, for transforms that are not affine, and
/// for variants that a part does not have.
Scene compose(const std::vector<Part>& parts);
/// With scenes that a cache may hold already.
Scene compose(const std::vector<Part>& parts, const SceneLoader& load);

/// Everything that tells two compositions apart, as one text; for a plain part its source.
std::string composition_key(const std::vector<Part>& parts);
/// For people: the sources, joined by " + ".
std::string composition_name(const std::vector<Part>& parts);

}  // namespace ir::scene
