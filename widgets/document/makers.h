#pragma once

#include <optional>
#include <string>

#include "renderers/core/method.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/item_ref.h"
#include "widgets/image/camera_motion.h"

/// Edits that take more than one call of projects/edits.h. Sources are as the document holds them: relative
/// to the project folder (projects::relative_source) or built-in names.
namespace ir::widgets::makers {

EditMaker add_scene(const std::string& name, const std::string& source);
EditMaker add_part(const std::string& scene, const std::string& source);
/// Another file for a part; the recorded hash is dropped.
EditMaker set_part_source(const std::string& scene, int part, const std::string& source);
/// A bookmark: named `name` or, where that is empty, "View 1", "View 2", …
EditMaker add_camera(const CameraPose& pose, const std::string& name = {});
/// The camera gets this pose of its own.
EditMaker set_pose(const std::string& camera, const CameraPose& pose);
EditMaker add_light_set();
EditMaker add_light(const std::string& set, projects::LightSpec::Type type);
/// Lights an experiment by one more light, which the last of its set becomes. What sees the scene by the
/// scene's own lights alone gets a set with these and the new one, together with all experiments that see it
/// so, because they are compared.
EditMaker light_experiment(const std::string& experiment, const projects::LightSpec& light);
EditMaker set_environment_map(const std::string& set, const std::string& source);
/// Compares the first two experiments, or `a` with `b`.
EditMaker add_comparison(const std::string& a = {}, const std::string& b = {});
/// Of the camera, or of the first with a pose of its own; one key where it stands.
EditMaker add_motion(const std::string& camera = {});
/// Of a light of a set, or of the first of all; of a file of a scene, likewise. One key where it stands.
EditMaker add_light_motion(const std::string& set = {}, int light = 0);
EditMaker add_part_motion(const std::string& scene = {}, int part = 0);
/// Of the experiment, or of the first; no axes yet.
EditMaker add_sweep(const std::string& experiment = {});
/// An axis that begins with what the experiment has, of the sweep; without one, of a new one of the
/// experiment.
EditMaker add_axis(const std::string& sweep, const std::string& experiment, const std::string& key);
/// Of the experiment, or of the first that has a reference, against its reference; over frames.
EditMaker add_plot(const std::string& experiment = {});
/// A question of this kind about the experiment, or about the first of all; about another one where only that
/// one can be asked about.
EditMaker add_analysis(const Registry& registry, const std::string& kind, const std::string& experiment = {});
EditMaker add_image(const std::string& name, const std::string& source);
EditMaker set_image_source(const std::string& image, const std::string& source);

// For every kind of item, parts and single lights included.
EditMaker remove(const ItemRef& item);
EditMaker duplicate(const ItemRef& item);
EditMaker rename(const ItemRef& item, const std::string& name);
EditMaker move(const ItemRef& item, int position);

}  // namespace ir::widgets::makers
