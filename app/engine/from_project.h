#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/engine/experiment.h"
#include "projects/document.h"

namespace ir::engine {

/// An experiment of a project as it runs: presets applied, ids resolved, files located. Throws Error or
/// InputError with one line when something that it needs is missing. The environment's map is read here,
/// unless `map` is what was read of it.
Experiment from_project(const projects::Project& project, const projects::Experiment& experiment,
                        const std::filesystem::path& folder,
                        const std::optional<scene::Environment>& map = {});

/// A light of the command line or of a project as the renderers take it.
scene::Light to_scene_light(const projects::LightSpec& spec, const std::string& name);

}  // namespace ir::engine
