#include "app/gui/session.h"

#include <algorithm>
#include <utility>

#include "app/gui/text_of.h"

namespace ir::gui {

QString read_only_text(const projects::OpenProject& open) {
    return QObject::tr("The project is open read-only: %1").arg(text_of(open.read_only_reason()));
}

Session::Session(const Registry& registry, QObject* parent)
    : QObject(parent), registry_(registry), files_(*this), camera_(*this) {
    connect(&files_, &ProjectFiles::message, this, &Session::message);
}

Session::~Session() {
    files_.drop_unsaved();
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

const MethodDescription* Session::first_method() const {
    const auto& methods = registry_.methods();
    const auto first = std::min_element(methods.begin(), methods.end(),
                                        [](const auto* a, const auto* b) { return a->title < b->title; });
    return first == methods.end() ? nullptr : *first;
}

void Session::select_experiment(const std::string& id) {
    if (!experiment(id) || (experiment() && experiment()->id == id)) return;
    camera_.finish_move();
    camera_.forget_move();
    experiment_id_ = id;
    emit experiment_selected();
}

void Session::replace(std::unique_ptr<projects::OpenProject> project, const std::string& experiment) {
    camera_.forget_move();
    camera_.set_scene_cameras({});
    project_ = std::move(project);
    experiment_id_ = experiment;
    emit project_replaced();
    if (!project_) return;
    for (const auto& each : project_->messages()) emit message(each);
    emit document_changed();
    emit experiment_selected();
}

void Session::end_gesture() {
    if (project_) project_->end_gesture();
}

void Session::undo() {
    camera_.finish_move();
    change([](projects::OpenProject& open) {
        const bool can = open.undo_stack().can_undo();
        if (can) open.undo();
        return can;
    });
}

void Session::redo() {
    camera_.finish_move();
    change([](projects::OpenProject& open) {
        const bool can = open.undo_stack().can_redo();
        if (can) open.redo();
        return can;
    });
}

void Session::say_error(const std::exception& error) {
    constexpr std::size_t longest_line = 4096;  // paths may be long and hold line breaks
    emit message({Severity::error, "project", projects::printable(error.what(), longest_line)});
}

}  // namespace ir::gui
