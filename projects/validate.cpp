#include "projects/validate.h"

#include <cmath>

#include "projects/document_fields.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"

namespace ir::projects {
namespace {

void refuse_unless(bool good, const std::string& what) {
    if (!good) throw UsageError(what);
}

void check_id(const std::string& id, const std::string& word) {
    refuse_unless(is_valid_id(id), word + " '" + printable(id, 60) +
                                       "': no valid id; use up to 100 letters, digits, '-', '_' and '.', not "
                                       "beginning with '.'");
}

bool is_finite(const Settings& values) {
    for (const auto& [key, value] : values)
        if (const auto* number = std::get_if<double>(&value); number && !std::isfinite(*number)) return false;
    return true;
}

/// Keys between which a light cannot be told from interpolation are refused.
void validate_light_key(const std::vector<Motion::Key>& keys, std::size_t i, const std::string& where) {
    const auto& key = keys[i];
    refuse_unless(!(key.look_at && key.direction), where + "a key has a target or a direction, not both");
    refuse_unless(!key.direction || *key.direction != glm::dvec3(0), where + "a direction must not be 0,0,0");
    if (i == 0) return;
    const auto& before = keys[i - 1];
    refuse_unless(key.position.has_value() == before.position.has_value() &&
                      key.look_at.has_value() == before.look_at.has_value() &&
                      key.direction.has_value() == before.direction.has_value(),
                  where + "all its keys must give the same of position, target and direction");
    if (!key.direction) return;
    refuse_unless(glm::dot(glm::normalize(*key.direction), glm::normalize(*before.direction)) > -1 + 1e-9,
                  where + "two successive directions are opposite; give a key between them");
}

}  // namespace

void validate(const Scene& scene) {
    check_id(scene.id, "scene");
    const std::string where = "scene '" + scene.id + "': ";
    refuse_unless(!scene.parts.empty(), where + "needs at least one file");
    for (const auto& part : scene.parts) {
        validate_fields(part, part_fields(), where + "a part's ");
        for (const auto& [name, change] : part.materials)
            validate_fields(change, material_fields(), where + "material '" + printable(name, 60) + "': ");
        if (!part.transform) continue;
        for (const double number : *part.transform)
            refuse_unless(std::isfinite(number), where + "a transform must hold finite numbers");
    }
}

void validate(const Camera& camera) {
    check_id(camera.id, "camera");
    const std::string where = "camera '" + camera.id + "': ";
    validate_fields(camera, camera_fields(), where);
    if (!camera.scene_camera.empty()) return;
    refuse_unless(camera.eye != camera.target, where + "target must differ from eye");
    refuse_unless(camera.up != glm::dvec3(0), where + "up must not be 0,0,0");
}

void validate(const LightSet& lights) {
    check_id(lights.id, "set of lights");
    const std::string where = "set of lights '" + lights.id + "': ";
    refuse_unless(lights.id != scene_lights, where + "this id stands for the scene's own; take another");
    for (const auto& light : lights.lights) validate(light);
    auto environment = lights.environment;
    const auto problem = problem_with(constant_environment_text(), &environment.constant);
    refuse_unless(problem.empty(), where + "the environment's radiance " + problem);
    if (environment.kind == Environment::Kind::map)
        validate_fields(environment, map_fields(), where + "the environment map's ");
}

void validate(const Motion& motion) {
    check_id(motion.id, "motion");
    const std::string where = "motion '" + motion.id + "': ";
    validate_fields(motion, motion_fields(motion.kind), where);
    refuse_unless(motion.light >= 0 && motion.light <= max_moved, where + "counts lights from 0");
    for (std::size_t i = 0; i < motion.keys.size(); ++i) {
        const auto& key = motion.keys[i];
        validate_fields(key, key_fields(motion.kind), where + "key " + std::to_string(i + 1) + ": ");
        refuse_unless(i == 0 || key.time > motion.keys[i - 1].time,
                      where + "the times of its keys must ascend");
        if (motion.kind == Motion::Kind::light) validate_light_key(motion.keys, i, where);
        if (motion.kind == Motion::Kind::part)
            refuse_unless(key.scale.x != 0 && key.scale.y != 0 && key.scale.z != 0,
                          where + "a part cannot be scaled by 0");
    }
}

void validate(const ForeignImage& image) {
    check_id(image.id, "image");
    validate_fields(image, image_fields(), "image '" + image.id + "': ");
}

void validate(const Experiment& experiment) {
    check_id(experiment.id, "experiment");
    const std::string where = "experiment '" + experiment.id + "': ";
    refuse_unless(!experiment.method.empty(), where + "its method is missing; give one");
    refuse_unless(experiment.method_version >= 1 && experiment.method_version <= 1'000'000,
                  where + "the method's version must be at least 1");
    validate_fields(experiment, experiment_fields(), where);
    refuse_unless(is_finite(experiment.values), where + "values must be finite");
    refuse_unless(experiment.shaders.size() <= most_changed_shaders,
                  where + "it changes more than " + std::to_string(most_changed_shaders) + " shaders");
    for (const auto& [file, hunks] : experiment.shaders) {
        const auto problem = problem_with_change(file, hunks);
        refuse_unless(problem.empty(), where + "shader '" + printable(file, 60) + "' " + problem);
    }
    for (const auto& [name, preset] : experiment.presets) {
        validate_fields(preset, preset_fields(), where);
        refuse_unless(is_finite(preset.values), where + "values must be finite");
    }
    refuse_unless(experiment.active_preset.empty() || experiment.presets.count(experiment.active_preset) != 0,
                  where + "has no preset '" + printable(experiment.active_preset, 60) + "'");
}

void validate(const Comparison& comparison) {
    check_id(comparison.id, "comparison");
    validate_fields(comparison, comparison_fields(), "comparison '" + comparison.id + "': ");
}

void validate(const Sweep& sweep) {
    check_id(sweep.id, "sweep");
    const std::string where = "sweep '" + sweep.id + "': ";
    validate_fields(sweep, sweep_fields(), where);
    for (const auto& axis : sweep.axes) validate_fields(axis, axis_fields(), where + "an axis' ");
}

void validate(const ErrorPlot& plot) {
    check_id(plot.id, "plot");
    validate_fields(plot, plot_fields(), "plot '" + plot.id + "': ");
}

void validate(const Analysis& analysis) {
    check_id(analysis.id, "analysis");
    validate_fields(analysis, analysis_fields(), "analysis '" + analysis.id + "': ");
}

}  // namespace ir::projects
