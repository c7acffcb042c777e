#include "app/gui/session.h"

#include "app/engine/from_project.h"
#include "app/gui/signature.h"
#include "projects/check.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"

namespace ir::gui {
namespace {

const std::string live_tag = "view";
constexpr int autosave_ms = 20000;

engine::Experiment with_pose(engine::Experiment experiment, const widgets::CameraPose& pose) {
    scene::Camera camera;
    camera.eye = pose.eye;
    camera.target = pose.target;
    camera.up = pose.up;
    camera.fov_y = float(glm::radians(pose.fov_y_degrees));
    camera.orthographic = pose.orthographic;
    camera.height = float(pose.height);
    experiment.camera = camera;
    return experiment;
}

}  // namespace

Session::Session(Renderer& renderer, const Registry& registry, QObject* parent)
    : QObject(parent), renderer_(renderer), registry_(registry) {
    connect(&renderer_, &Renderer::result_arrived, this, &Session::on_result);
    connect(&renderer_, &Renderer::failed, this, &Session::on_failure);
    connect(&renderer_, &Renderer::progressed, this,
            [this](const std::string& tag, const std::string& what, double fraction) {
                if (tag == live_tag && state_ == State::rendering) emit progressed(what, fraction);
            });
    connect(&renderer_, &Renderer::scene_arrived, this, [this](const engine::SceneSummary& scene) {
        if (scene.composition_key != scene_key_) return;
        scene_ = scene;
        for (const auto& warning : scene.warnings) emit message({Severity::warning, "scene", warning});
        emit scene_changed();
    });
    connect(&renderer_, &Renderer::messages_arrived, this, [this](const std::vector<Message>& messages) {
        for (const auto& each : messages) emit message(each);
    });
    connect(&renderer_, &Renderer::no_device, this, [this](const std::string& error) {
        emit message({Severity::error, "gl", error});
        set_state(State::failed, error);
    });
    connect(&environments_, &EnvironmentLoader::arrived, this, &Session::update_request);
    connect(&environments_, &EnvironmentLoader::failed, this, [this](const std::string& error) {
        emit message({Severity::error, "environment", error});
        set_state(State::blocked, error);
    });
    autosave_timer_.setInterval(autosave_ms);
    connect(&autosave_timer_, &QTimer::timeout, this, &Session::autosave);
    autosave_timer_.start();
}

const projects::Experiment* Session::experiment() const {
    if (!project_ || document().experiments.empty()) return nullptr;
    const auto* found = projects::find_item(document().experiments, experiment_id_);
    return found ? found : &document().experiments.front();
}

const MethodDescription* Session::method() const {
    const auto* chosen = experiment();
    return chosen ? registry_.find(chosen->method) : nullptr;
}

void Session::select_experiment(const std::string& id) {
    if (id == experiment_id_) return;
    finish_camera_move();
    experiment_id_ = id;
    shown_.clear();
    level_ = layer_ = 0;
    moved_pose_.reset();
    emit experiment_selected();
    update_request();
}

bool Session::changed(bool really) {
    if (!really) return false;
    emit document_changed();
    update_request();
    return true;
}

void Session::end_gesture() {
    if (project_) project_->end_gesture();
}

void Session::undo() {
    finish_camera_move();
    if (!project_ || !project_->undo_stack().can_undo()) return;
    moved_pose_.reset();
    guarded([&] { return project_->undo(), changed(true); });
}

void Session::redo() {
    finish_camera_move();
    if (!project_ || !project_->undo_stack().can_redo()) return;
    moved_pose_.reset();
    guarded([&] { return project_->redo(), changed(true); });
}

void Session::show_buffer(const std::string& key) {
    if (key == shown_) return;
    shown_ = key;
    level_ = layer_ = 0;
    update_request();
}

std::string Session::shown_key(const engine::LiveResult& result) const {
    const auto& key = result.images.empty() ? shown_ : result.images.begin()->first.key;
    const auto* described = method();
    return !key.empty() || !described ? key : described->outputs.front().key;
}

void Session::show_part(int level, int layer) {
    level_ = level;
    layer_ = layer;
    update_request();
}

void Session::set_thumbnails_wanted(bool wanted) {
    const bool more = wanted && !thumbnails_;
    thumbnails_ = wanted;
    if (more) render_again();
}

void Session::render_again() {
    signature_.clear();
    update_request();
}

void Session::cancel() {
    renderer_.cancel(live_tag);
}

void Session::update_request() {
    const auto* chosen = experiment();
    if (!chosen) return set_state(State::empty, project_ ? "The project has no experiment yet." : "");
    try {
        const auto reason = projects::why_not_runnable(document(), *chosen, registry_, project_->folder());
        if (!reason.empty()) throw Error(reason);
        auto wanted = resolved(*chosen);
        if (!wanted) return set_state(State::rendering);
        load_scene(wanted->composition());
        if (moved_pose_) wanted = with_pose(std::move(*wanted), *moved_pose_);
        const std::string text =
            signature(*wanted) + "\n" + shown_ + " " + std::to_string(level_) + " " + std::to_string(layer_);
        if (text != signature_) send_request(*wanted, text);
    } catch (const std::exception& error) {
        signature_.clear();
        renderer_.cancel(live_tag);
        set_state(State::blocked, error.what());
    }
}

std::optional<engine::Experiment> Session::resolved(const projects::Experiment& chosen) {
    using Kind = projects::Environment::Kind;
    const auto& folder = project_->folder();
    const auto* lights = projects::find_item(document().lights, projects::effective(chosen).lights);
    if (!lights || lights->environment.kind != Kind::map)
        return engine::from_project(document(), chosen, folder);
    const auto map = environments_.get(projects::resolve(lights->environment.source, folder));
    if (!map) return {};
    projects::Project without = document();  // the map is here already and not to be read again
    projects::find_item(without.lights, lights->id)->environment.kind = Kind::scene;
    auto wanted = engine::from_project(without, chosen, folder);
    wanted.environment = scene::Environment{glm::vec3(0), map};
    return wanted;
}

void Session::load_scene(const std::vector<scene::Part>& parts) {
    const auto key = scene::composition_key(parts);
    if (key == scene_key_) return;
    scene_key_ = key;
    scene_.reset();
    emit scene_changed();
    renderer_.load_scene(parts);
}

void Session::send_request(const engine::Experiment& experiment, const std::string& signature) {
    engine::LiveRequest request;
    request.tag = live_tag;
    request.experiment = experiment;
    request.parts = {{shown_, level_, layer_}};
    request.thumbnails = thumbnails_;
    signature_ = signature;
    serial_ = renderer_.request(std::move(request));
    set_state(State::rendering);
}

void Session::set_state(State state, const std::string& text) {
    state_ = state;
    state_text_ = text;
    emit state_changed();
}

void Session::on_result(std::shared_ptr<const engine::LiveResult> result) {
    if (result->tag != live_tag || !project_ || state_ == State::blocked) return;
    result_ = result;
    for (const auto& each : result->report.messages) emit message(each);
    emit picture_arrived(result);
    if (result->serial == serial_ && result->finished) set_state(State::done);
}

void Session::on_failure(const std::string& tag, const std::string& error, bool cancelled) {
    if (tag != live_tag && tag != "scene") return;
    if (!cancelled) emit message({Severity::error, tag == "scene" ? "scene" : "render", error});
    if (tag != live_tag) return;
    set_state(cancelled ? State::cancelled : State::failed, cancelled ? "" : error);
}

}  // namespace ir::gui
