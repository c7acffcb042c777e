#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "projects/document.h"
#include "renderers/core/changed_shaders.h"
#include "renderers/core/shard.h"
#include "renderers/core/value.h"
#include "renderers/scene/compose.h"
#include "renderers/scene/scene.h"

namespace ir::engine {

/// A light that moves: one of Experiment::lights, or the scene's with a name.
struct LightMotion {
    std::size_t light = 0;
    std::string name;          ///< not empty: of the scene's light
    projects::LightSpec spec;  ///< of one of Experiment::lights, as it is without its motion
    projects::Motion motion;   ///< with keys
    bool operator==(const LightMotion&) const = default;
};

/// Everything that one picture depends on, resolved: what the command line and the project document both
/// become.
struct Experiment {
    std::string scene;               ///< path or builtin:NAME; with `parts` only their name
    std::vector<scene::Part> parts;  ///< of a composed scene, instead of `scene`
    std::string method;              ///< id
    ShaderChanges shaders;           ///< with which it is computed
    Settings settings;               ///< may be incomplete; completed from the method's description
    std::string camera_name;         ///< of the scene's; empty: `camera`, or the scene's first
    std::optional<scene::Camera> camera;
    std::vector<scene::Light> lights;  ///< beside the scene's, or in their place when `replace_lights`
    bool replace_lights = false;
    /// All that shine, its own first.
    std::vector<scene::Light> lights_with(const std::vector<scene::Light>& of_scene) const {
        auto all = lights;
        if (!replace_lights) all.insert(all.end(), of_scene.begin(), of_scene.end());
        return all;
    }
    /// How things move from `time` on, where `camera` and `lights` stand then; parts have their own.
    std::optional<projects::Motion> camera_motion;
    std::vector<LightMotion> light_motions;
    std::optional<scene::Environment> environment;
    int width = 800, height = 600;
    std::uint64_t seed = 0;
    int frames = 1;   ///< each 1/30 s after the one before, unless the method accumulates
    double time = 0;  ///< seconds, of the first frame
    /// Only a part of the picture is computed, to be joined with the others (graph::Method::join).
    Shard shard = {};
    /// The project that it comes from, cut down to what it uses (projects::recipe_of), as JSON; empty: none.
    std::string recipe = {};

    /// The parts, or `scene` as the only one.
    std::vector<scene::Part> composition() const {
        return parts.empty() ? std::vector{scene::Part{scene}} : parts;
    }
};

}  // namespace ir::engine
