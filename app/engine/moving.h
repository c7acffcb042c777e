#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/engine/experiment.h"
#include "projects/match.h"

namespace ir::engine {

class SceneCache;

/// Answers by loading the scenes of a project; what cannot be loaded stands still and emits nothing, and
/// whoever renders it says what is wrong. Cache and project must outlive the answers.
projects::SceneFacts scene_facts(SceneCache& cache, const projects::Project& project,
                                 const std::filesystem::path& folder);

/// Whether camera or lights of their own accord are elsewhere at other times. What the scene animates does
/// not count: see scene::Scene::is_animated().
bool is_moving(const Experiment& experiment);

/// The experiment's own camera, which it has, at `time` (seconds).
scene::Camera camera_at(const Experiment& experiment, double time);

/// `lights`, which are the scene's or the experiment's in world space, with its motions at `time`. A name
/// that no light has moves none.
std::vector<scene::Light> lights_at(const Experiment& experiment, std::vector<scene::Light> lights,
                                    double time);

/// Everything that tells the motions of two experiments apart, parts' excepted; empty where nothing moves.
std::string motion_text(const Experiment& experiment);

}  // namespace ir::engine
