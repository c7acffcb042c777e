#include <algorithm>
#include <cstring>

#include "app/engine/camera_pose.h"
#include "app/engine/execution.h"
#include "app/engine/moving.h"
#include "app/engine/version.h"
#include "projects/hash.h"
#include "projects/samples.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

/// A text of everything given to it, exactly.
class Exact {
  public:
    template <class... Numbers>
    void add(Numbers... numbers) {
        ((text_ << ' ' << numbers), ...);
    }
    void add_text(const std::string& text) { text_ << ' ' << text.size() << ':' << text; }
    std::string hash() const { return hash_bytes(text_.str()); }
    Exact() { text_ << std::hexfloat; }

  private:
    std::ostringstream text_;
};

void add(Exact& exact, const scene::Light& light) {
    exact.add(static_cast<int>(light.type));
    for (const float number : light.numbers()) exact.add(number);
}

void add(Exact& exact, const scene::Environment& environment) {
    exact.add(environment.constant.x, environment.constant.y, environment.constant.z);
    if (!environment.map) return;
    const auto& map = *environment.map;
    exact.add(map.width, map.height, map.channels);
    exact.add_text(environment.hash_of_map());
}

void add(Exact& exact, const scene::Camera& camera) {
    std::apply([&](auto... numbers) { exact.add(numbers...); }, seen_by(camera));
}

}  // namespace

std::string state_fingerprint(const Experiment& experiment, const std::string& scene_hash) {
    const auto& method = registry().at(experiment.method);
    Exact exact;
    exact.add_text(method.id);
    exact.add(method.version);
    for (const auto& [key, value] : completed(method.parameters, experiment.settings)) {
        const auto* parameter = find(method.parameters, key);
        if (parameter && parameter->accumulates) continue;
        exact.add_text(key);
        exact.add_text(to_string(value));
    }
    exact.add_text(scene_hash);
    exact.add(experiment.replace_lights, experiment.lights.size());
    for (const auto& light : experiment.lights) add(exact, light);
    exact.add(experiment.environment.has_value());
    if (experiment.environment) add(exact, *experiment.environment);
    exact.add_text(experiment.camera_name);
    exact.add(experiment.camera.has_value());
    if (experiment.camera) add(exact, *experiment.camera);
    exact.add(experiment.width, experiment.height, experiment.seed, experiment.time);
    if (const auto motion = motion_text(experiment); !motion.empty()) exact.add_text(motion);
    if (const auto shaders = digest_of(experiment.shaders) + shader_folder_digest(); !shaders.empty())
        exact.add_text(shaders);
    if (const auto& shard = experiment.shard; shard.count > 1) exact.add(shard.index, shard.count);
    return exact.hash();
}

bool Execution::accumulates() const {
    return projects::accumulates(method_->description) && !scene_->is_animated();
}

std::uint64_t Execution::samples_per_frame() const {
    return projects::samples_per_frame(method_->description, settings_);
}

std::uint64_t Execution::samples_requested() const {
    return static_cast<std::uint64_t>(std::max(0, experiment_.frames)) * samples_per_frame();
}

std::uint64_t Execution::sample_limit(std::uint64_t limit) const {
    if (!accumulates()) return unlimited;
    if (samples_ == 0) return std::max<std::uint64_t>(1, limit);
    if (!shown_ && frame_ >= experiment_.frames) return 0;
    const auto beyond = samples_ % samples_per_frame();
    return beyond == 0 ? limit : std::min(limit, samples_per_frame() - beyond);
}

void Execution::count_frame(const FrameReport& report, std::uint64_t limit) {
    if (report.began_anew) {
        samples_ = 0;
        origins_.clear();
        limit = unlimited;
    }
    const auto added = std::min(samples_per_frame(), limit);
    is_extended_ = is_extended_ || added > 0;
    set_samples(samples_ + added);
    shown_ = true;
}

void Execution::set_samples(std::uint64_t samples) {
    samples_ = samples;
    frame_ = static_cast<int>(std::min<std::uint64_t>(samples_ / samples_per_frame(), 1'000'000'000));
}

void Execution::restore(StoredState state) {
    if (!accumulates())
        throw Error(
            "a stored state cannot be continued here: " +
            std::string(scene_->is_animated() ? "the scene moves" : "the method does not accumulate"));
    if (state.fingerprint != state_fingerprint(experiment_, scene_->content_hash))
        throw Error("the stored state is of another picture");
    restart();
    graph_->restore(std::move(state.history));
    origins_ = std::move(state.origins);
    set_samples(state.samples);
}

std::optional<StoredState> Execution::state() const {
    if (!accumulates() || samples_ == 0) return {};
    auto history = graph_->history();
    if (!history) return {};
    StoredState state{std::move(*history), samples_, state_fingerprint(experiment_, scene_->content_hash),
                      origins_};
    if (is_extended_ || origins_.empty()) {
        const auto& report = graph_->last_report();
        state.origins.push_back({version_and_commit(), report.device, report.backend, projects::utc_now(),
                                 samples_, report.processor});
    }
    return state;
}

}  // namespace ir::engine
