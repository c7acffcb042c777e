#include "app/engine/execution.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "app/engine/camera_pose.h"
#include "app/engine/lighting_digest.h"
#include "app/engine/moving.h"
#include "projects/samples.h"
#include "renderers/core/error.h"
#include "renderers/core/light_use.h"
#include "renderers/core/limits.h"
#include "renderers/core/words.h"
#include "renderers/methods/all_methods.h"
#include "renderers/passes/preview/preview.h"
#include "renderers/scene/light_sources.h"

namespace ir::engine {
namespace {

bool same_camera(const std::optional<scene::Camera>& a, const std::optional<scene::Camera>& b) {
    return a.has_value() == b.has_value() && (!a || seen_by(*a) == seen_by(*b));
}

bool shine_alike(const scene::Light& a, const scene::Light& b) {
    return a.shines_like(b);
}

bool same_lights(const Experiment& a, const Experiment& b) {
    return a.replace_lights == b.replace_lights &&
           std::equal(a.lights.begin(), a.lights.end(), b.lights.begin(), b.lights.end(), shine_alike);
}

}  // namespace

const Registry& registry() {
    static const Registry all = [] {
        std::vector<const MethodDescription*> descriptions;
        for (const auto* method : methods::all_methods()) descriptions.push_back(&method->description);
        return Registry(std::move(descriptions));
    }();
    return all;
}

const graph::Method& find_method(const std::string& id) {
    for (const auto* method : methods::all_methods())
        if (method->description.id == id) return *method;
    if (id == passes::preview().description.id) return passes::preview();
    registry().at(id);  // throws, naming the known ones
    throw Error("method '" + id + "' is not built");
}

Execution::Execution(Machine& machine, Experiment experiment, std::shared_ptr<graph::SharedContents> shared)
    : machine_(machine), experiment_(std::move(experiment)) {
    check_size();
    load();
    graph_ = std::make_unique<graph::Graph>(machine_.device(), &machine_.context(), &machine_.programs(),
                                            std::move(shared));
    machine_.programs().hold(experiment_.shaders);
}

Execution::~Execution() {
    machine_.programs().release(experiment_.shaders);
}

const MethodDescription& Execution::method() const {
    return method_->description;
}

void Execution::check_size() const {
    const int max_side = std::min(max_image_side, machine_.context().info().max_texture_size);
    if (experiment_.width < 1 || experiment_.height < 1 || experiment_.width > max_side ||
        experiment_.height > max_side)
        throw UsageError("image size " + std::to_string(experiment_.width) + "x" +
                         std::to_string(experiment_.height) + " is not allowed; this device takes 1 to " +
                         std::to_string(max_side) + " pixels a side");
}

void Execution::load() {
    const auto& method = find_method(experiment_.method);
    auto settings = completed(method.description.parameters, experiment_.settings);
    if (experiment_.shard.count > 1 && !method.join)
        throw UsageError("a picture of " + method.description.id +
                         " cannot be divided; only those of references can");
    for (const auto& [file, hunks] : experiment_.shaders)
        changed_shader(machine_.shader_folder(), file, hunks);  // throws where a change does not fit
    auto loaded = machine_.scenes().load(experiment_.composition());
    if (experiment_.replace_lights || !experiment_.lights.empty() || experiment_.environment) {
        auto changed = std::make_shared<scene::Scene>(*loaded);
        changed->lights = experiment_.lights_with(loaded->lights);
        if (experiment_.environment) changed->environment = *experiment_.environment;
        loaded = changed;
    }
    if (!experiment_.camera_name.empty() && !loaded->find_camera(experiment_.camera_name)) {
        throw UsageError("scene " + loaded->name + " has no camera '" + experiment_.camera_name + "'" +
                         known_are(experiment_.camera_name, words_of(loaded->cameras, &scene::Camera::name)));
    }
    // Nothing throws from here on: an experiment that cannot be loaded leaves the old one as it was.
    method_ = &method;
    settings_ = std::move(settings);
    scene_ = std::move(loaded);
    inputs_ = {};  // they point into the old scene
    world_time_ = std::nan("");
    forget_frames();
}

void Execution::forget_frames() {
    lights_time_ = std::nan("");
    time_ = experiment_.time;
    previous_view_.reset();
    frame_ = first_frame_ = 0;
    samples_ = 0;
    shown_ = is_extended_ = false;
    origins_.clear();
}

bool Execution::update(Experiment experiment) {
    const auto& old = experiment_;
    const bool reload = experiment.composition() != old.composition() || experiment.method != old.method ||
                        experiment.shaders != old.shaders || !same_lights(experiment, old) ||
                        experiment.environment != old.environment;
    bool changed =
        reload || experiment.width != old.width || experiment.height != old.height ||
        experiment.seed != old.seed || experiment.time != old.time || experiment.shard != old.shard ||
        experiment.camera_name != old.camera_name || !same_camera(experiment.camera, old.camera) ||
        experiment.camera_motion != old.camera_motion || experiment.light_motions != old.light_motions ||
        (experiment.frames < frame_ && !accumulates());
    if (!changed) {
        const auto after = completed(method_->description.parameters, experiment.settings);
        for (const auto& parameter : method_->description.parameters)
            if (parameter.on_change != OnChange::nothing && !(parameter.accumulates && accumulates()) &&
                after.at(parameter.key) != settings_.at(parameter.key))
                changed = true;
    }
    auto backup = std::exchange(experiment_, std::move(experiment));
    try {
        check_size();
        if (reload)
            load();
        else
            settings_ = completed(method_->description.parameters, experiment_.settings);
    } catch (...) {
        experiment_ = std::move(backup);
        throw;
    }
    if (backup.shaders != experiment_.shaders) {
        machine_.programs().hold(experiment_.shaders);
        machine_.programs().release(backup.shaders);
    }
    if (changed)
        restart();
    else
        set_samples(samples_);
    return changed;
}

void Execution::restart(int first) {
    forget_frames();
    graph_->reset_history();
    if (projects::accumulates(method_->description)) return;
    first_frame_ = first;
    set_samples(static_cast<std::uint64_t>(first));
    time_ = experiment_.time + first * seconds_per_frame();
}

bool Execution::is_moving() const {
    return scene_->is_animated() || engine::is_moving(experiment_);
}

double Execution::seconds_per_frame() const {
    // What adds up over frames is a picture of one moment.
    return projects::accumulates(method_->description) ? 0 : projects::frame_seconds;
}

scene::Camera Execution::camera() const {
    if (experiment_.camera) return camera_at(experiment_, time_);
    for (const auto& camera : world_.cameras)
        if (camera.name == experiment_.camera_name) return camera;
    return world_.cameras.front();
}

/// The world at `time`, and how it has moved since the frame before.
void Execution::move_world(double time) {
    const double before = frame_ > first_frame_ ? time - seconds_per_frame() : time;
    const double world_time = scene_->is_animated() ? time : 0;
    const double world_previous = scene_->is_animated() ? before : world_time;
    if (world_time != world_time_ || world_previous != world_previous_) {
        world_ = scene::flatten(*scene_, world_time, world_previous);
        world_time_ = world_time;
        world_previous_ = world_previous;
        own_lights_ = world_.lights;
        lights_time_ = std::nan("");
    }
    if (time == lights_time_) return;
    lights_time_ = time;
    world_.lights = lights_at(experiment_, own_lights_, time);
    const auto previous = lights_at(experiment_, own_lights_, before);
    world_.lights_moved = !std::equal(previous.begin(), previous.end(), world_.lights.begin(), shine_alike);
}

FrameReport Execution::run_frame(const graph::FrameOptions& options, std::uint64_t max_samples) {
    machine_.context().make_current();
    time_ = experiment_.time + frame_ * seconds_per_frame();
    move_world(time_);
    auto& inputs = inputs_;
    inputs.scene = scene_.get();
    inputs.world = &world_;
    inputs.geometry_fingerprint = geometry_fingerprint();
    inputs.world_fingerprint =
        inputs.geometry_fingerprint + ' ' + lighting_digest(world_.lights, scene_->environment);
    inputs.view = scene::make_view(camera(), experiment_.width, experiment_.height, world_.bounds);
    inputs.previous_view = previous_view_.value_or(inputs.view);
    inputs.seed = experiment_.seed;
    inputs.frame = frame_ - first_frame_;
    inputs.time = time_;
    inputs.threads = machine_.options().threads;
    inputs.processor = machine_.processor();
    inputs.inspection = inspection_;
    inputs.sample_limit = sample_limit(max_samples);
    inputs.shard = experiment_.shard;
    inputs.shader_changes = experiment_.shaders;
    auto report = graph_->run(*method_, settings_, inputs, options);
    report.lights = used_lights(*this);
    if (report.complete) {
        previous_view_ = inputs.view;
        count_frame(report, inputs.sample_limit);
    }
    return report;
}

namespace {

std::vector<LightSource> sources_of(const Execution& execution) {
    const auto& scene = execution.scene();
    return scene::light_sources(scene, execution.world().lights, scene.environment);
}

}  // namespace

std::vector<UsedLight> used_lights(const Execution& execution) {
    return used_lights(sources_of(execution), light_use(execution.method(), execution.settings()));
}

std::vector<UsedLight> lights_of_lit(const Execution& execution) {
    const auto& outputs = execution.method().outputs;
    const bool has_lit = std::ranges::any_of(outputs, [&](const OutputDescription& output) {
        return output.key == lit_output_key && holds(output.active_when, execution.settings());
    });
    if (!has_lit) return {};
    return used_lights(sources_of(execution), light_use_of_lit(execution.method(), execution.settings()));
}

bool Execution::explain(const graph::FrameOptions& options) {
    if (!inputs_.scene) return false;
    machine_.context().make_current();
    inputs_.inspection = inspection_;
    return graph_->explain(*method_, settings_, inputs_, options);
}

std::string Execution::geometry_fingerprint() const {
    std::ostringstream text;
    text << std::hexfloat << scene_->content_hash << '@' << world_time_;
    if (world_previous_ != world_time_) text << '<' << world_previous_;
    return text.str();
}

}  // namespace ir::engine
