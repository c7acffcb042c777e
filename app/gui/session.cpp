#include "app/gui/session.h"

#include <exception>

#include "app/gui/known_projects.h"
#include "renderers/core/error.h"

namespace ir::gui {
namespace {

constexpr int autosave_ms = 20000;

}  // namespace

Session::Session(const Registry& registry, QObject* parent)
    : QObject(parent), registry_(registry), unsaved_folder_(unsaved_projects_folder()) {
    autosave_timer_.setInterval(autosave_ms);
    connect(&autosave_timer_, &QTimer::timeout, this, &Session::autosave);
    autosave_timer_.start();
}

Session::~Session() {
    // The program ends in order, neither told to nor by an error that unwinds everything.
    if (project_ && project_->folder().empty() && !is_left_ && std::uncaught_exceptions() == 0)
        project_->close();
}

const projects::Experiment* Session::experiment(const std::string& id) const {
    return project_ ? projects::find_item(document().experiments, id) : nullptr;
}

const projects::Experiment* Session::experiment() const {
    if (!project_ || document().experiments.empty()) return nullptr;
    const auto* found = experiment(experiment_id_);
    return found ? found : &document().experiments.front();
}

const MethodDescription* Session::method() const {
    const auto* chosen = experiment();
    return chosen ? registry_.find(chosen->method) : nullptr;
}

void Session::select_experiment(const std::string& id) {
    if (!experiment(id) || (experiment() && experiment()->id == id)) return;
    finish_camera_move();
    experiment_id_ = id;
    moved_pose_.reset();
    moved_.clear();
    emit experiment_selected();
}

bool Session::changed(bool really) {
    if (really) emit document_changed();
    return really;
}

void Session::end_gesture() {
    if (project_) project_->end_gesture();
}

void Session::set_last_kept(const projects::LastKept& keys) {
    if (project_) changed(project_->set_last_kept(keys));
}

void Session::undo() {
    finish_camera_move();
    if (!project_ || !project_->undo_stack().can_undo()) return;
    guarded([&] { return project_->undo(), changed(true); });
}

void Session::redo() {
    finish_camera_move();
    if (!project_ || !project_->undo_stack().can_redo()) return;
    guarded([&] { return project_->redo(), changed(true); });
}

}  // namespace ir::gui
