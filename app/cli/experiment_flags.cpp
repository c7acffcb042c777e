#include "app/cli/experiment_flags.h"

#include <charconv>
#include <cmath>
#include <iostream>
#include <set>

#include "app/engine/execution.h"
#include "app/engine/from_project.h"
#include "projects/document_fields.h"
#include "projects/light_spec.h"
#include "projects/validate.h"
#include "renderers/core/describe.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/words.h"

namespace ir::cli {
namespace {

std::uint64_t parse_seed(const std::string& text) {
    std::uint64_t seed = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size())
        throw UsageError("--seed '" + text + "' is not an integer from 0 to 18446744073709551615");
    return seed;
}

std::string key_of(const std::string& set) {
    const auto equals = set.find('=');
    if (equals == std::string::npos) throw UsageError("--set '" + set + "' is not of the form key=value");
    return set.substr(0, equals);
}

void set(Settings& values, const MethodDescription& method, const std::vector<std::string>& sets) {
    for (const auto& text : sets) {
        const auto key = key_of(text);
        values[key] = parameter_named(method.parameters, key).parse(text.substr(key.size() + 1));
    }
}

/// The condition that keeps the parameter from having an effect: its own, or that of what it depends on.
const Condition* unmet(const std::vector<ParameterDescription>& parameters, const std::string& key,
                       const Settings& settings) {
    for (const auto* p = find(parameters, key); p; p = find(parameters, p->active_when.key))
        if (!is_active(*p, settings)) return &p->active_when;
    return nullptr;
}

glm::dvec3 parse_point(const std::string& text, const std::string& option) {
    const auto point = projects::parse_vec3(text, option);
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(static_cast<float>(point[i])))
            throw UsageError(option + " is beyond what single precision holds");
    return point;
}

CameraPose pose_of(const ExperimentFlags& flags) {
    if (!flags.camera.empty()) throw UsageError("give --camera or --eye and --target, not both");
    if (flags.eye.empty() || flags.target.empty()) throw UsageError("--eye and --target belong together");
    CameraPose pose;
    pose.eye = parse_point(flags.eye, "--eye");
    pose.target = parse_point(flags.target, "--target");
    if (!flags.up.empty()) pose.up = parse_point(flags.up, "--up");
    if (flags.fov_y) pose.fov_y_degrees = *flags.fov_y;
    const glm::vec3 view = glm::vec3(pose.target) - glm::vec3(pose.eye);
    if (glm::length(view) < 1e-9f) throw UsageError("--eye and --target are the same point");
    if (glm::length(glm::cross(view, glm::vec3(pose.up))) < 1e-9f)
        throw UsageError("--up points along the view; give another direction");
    return pose;
}

void set_camera(const ExperimentFlags& flags, projects::Project& project, projects::Experiment& experiment) {
    const bool is_posed = !flags.eye.empty() || !flags.target.empty();
    if (!is_posed && (flags.fov_y || !flags.up.empty()))
        throw UsageError(std::string(flags.fov_y ? "--fov-y" : "--up") +
                         " cannot be used without --eye and --target");
    if (is_posed) {
        projects::Camera camera;
        camera.name = "camera";
        camera.set_pose(pose_of(flags));
        engine::add_camera(project, experiment, std::move(camera));
    } else if (!flags.camera.empty()) {
        engine::choose_camera(project, experiment, flags.camera);
    }
}

void set_variant(const std::string& variant, projects::Project& project, const std::string& id) {
    if (auto* scene = projects::find_item(project.scenes, id))
        for (auto& part : scene->parts) part.variant = variant;
}

/// The shaders that the file changes. Notes where it takes the place of the experiment's own changes.
std::vector<std::string> change_shaders(projects::Experiment& experiment, const std::string& file) {
    try {
        auto changes = read_changes(real_file_system().read(file, most_changed_shaders * most_hunk_bytes));
        std::vector<std::string> changed, replaced;
        for (auto& [shader, hunks] : changes) {
            changed.push_back(shader);
            auto& change = experiment.shaders[shader];
            if (!change.empty() && change != hunks) replaced.push_back(shader);
            change = std::move(hunks);
        }
        validate(experiment);
        if (!replaced.empty())
            std::cerr << "note: --shader-diff " << file << " takes the place of what "
                      << (experiment.id.empty() ? "the experiment" : "experiment '" + experiment.id + "'")
                      << " changes in " << listed(replaced) << "\n";
        return changed;
    } catch (const Error& error) {
        throw UsageError("--shader-diff '" + file + "': " + error.what());
    }
}

/// What --shader-diff changes is one's own: an experiment without other changes waits for nobody.
void change_shaders(projects::Project& project, projects::Experiment& experiment,
                    const std::vector<std::string>& files) {
    std::set<std::string> others;
    for (const auto& [shader, hunks] : experiment.shaders) others.insert(shader);
    for (const auto& file : files)
        for (const auto& shader : change_shaders(experiment, file)) others.erase(shader);
    if (others.empty()) project.shaders_allowed = true;
}

}  // namespace

void add_experiment_flags(CLI::App& command, ExperimentFlags& flags) {
    const auto camera_text = [](const char* key) {
        return projects::field_of(projects::camera_fields(), key).text;
    };
    const auto text = [](const char* key) {
        return projects::field_of(projects::experiment_fields(), key).text;
    };
    command.add_option("--set", flags.sets, "Parameter key=value; repeat for more");
    command.add_option("--shader-diff", flags.shader_diffs,
                       "File of `git diff` or `diff -ru` that changes shaders; repeat for more");
    command.add_option("--camera", flags.camera,
                       "Id of one of the project's cameras, or name of one of the scene's");
    command.add_option("--eye", flags.eye, camera_text("eye").doc);
    command.add_option("--target", flags.target, camera_text("target").doc);
    command.add_option("--up", flags.up, camera_text("up").doc + " (default 0,1,0)");
    command.add_option("--fov-y", flags.fov_y, camera_text("fov_y_degrees").doc)
        ->check(within(camera_text("fov_y_degrees")));
    command.add_option("--variant", flags.variant,
                       "Variant of the scene's materials (KHR_materials_variants); `scene` lists them");
    command.add_option("--size", flags.size, text("size").doc + ", as 800x600");
    command.add_option("--seed", flags.seed, text("seed").doc);
    command.add_option("--frames", flags.frames, text("frames").doc)->check(whole_within(text("frames")));
    command.add_option("--time", flags.time, text("time").doc)->check(within(text("time")));
}

void apply(const ExperimentFlags& flags, projects::Project& project, projects::Experiment& experiment) {
    experiment = effective(experiment);
    if (!flags.sets.empty()) set(experiment.values, engine::registry().at(experiment.method), flags.sets);
    set_camera(flags, project, experiment);
    if (!flags.variant.empty()) set_variant(flags.variant, project, experiment.scene);
    if (!flags.size.empty()) experiment.size = projects::parse_size(flags.size, "--size");
    if (!flags.seed.empty()) experiment.seed = parse_seed(flags.seed);
    if (flags.frames) experiment.frames = *flags.frames;
    if (flags.time) experiment.time = *flags.time;
    if (!flags.shader_diffs.empty()) change_shaders(project, experiment, flags.shader_diffs);
}

std::vector<Message> notes_of(const ExperimentFlags& flags, const std::string& method,
                              const Settings& given) {
    const auto& parameters = engine::registry().at(method).parameters;
    const auto settings = completed(parameters, given);
    std::vector<Message> notes;
    for (const auto& text : flags.sets)
        if (const auto* condition = unmet(parameters, key_of(text), settings))
            notes.push_back({Severity::note, "render",
                             "--set " + text + " does nothing here, it counts only where " +
                                 condition_text(*condition) + " (it is " +
                                 to_string(settings.at(condition->key)) + ")"});
    return notes;
}

}  // namespace ir::cli
