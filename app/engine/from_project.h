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

/// A project of one scene and one experiment of it, which are told without a document: the method at its
/// defaults. Throws UsageError for an unknown method.
projects::Project project_of(const std::string& scene, const std::string& method);
/// That experiment as it runs, whatever was changed since; the scene keeps the name that it was given.
Experiment from_single(const projects::Project& project);

/// The project's own camera of that id, else the scene's of that name.
void choose_camera(projects::Project& project, projects::Experiment& experiment, const std::string& name);
/// A new camera of the project, whose id is made of its name.
void add_camera(projects::Project& project, projects::Experiment& experiment, projects::Camera camera);

/// A light of the command line or of a project as the renderers take it.
scene::Light to_scene_light(const projects::LightSpec& spec, const std::string& name);

}  // namespace ir::engine
