#include "app/gui/session.h"

#include <algorithm>

#include "projects/scene_files.h"
#include "projects/store.h"
#include "renderers/core/error.h"

namespace ir::gui {
namespace {

/// "sponza" of "/scenes/sponza.glb", "cornell" of "builtin:cornell@1".
std::string scene_title(const std::string& scene) {
    if (projects::is_builtin(scene)) {
        const auto name = scene.substr(scene.find(':') + 1);
        return name.substr(0, name.find_first_of("@?"));
    }
    return std::filesystem::path(scene).stem().string();
}

projects::Scene scene_item(const projects::Project& project, const std::string& source,
                           const std::filesystem::path& folder) {
    projects::Scene scene;
    scene.name = scene_title(source);
    scene.id = projects::free_id_in(project.scenes, scene.name);
    projects::ScenePart part;
    part.source = projects::is_builtin(source) ? source : projects::relative_source(source, folder);
    scene.parts.push_back(part);
    return scene;
}

}  // namespace

void Session::open(const std::filesystem::path& given) {
    // Whatever folder the program is in later.
    auto path = std::filesystem::absolute(given).lexically_normal();
    if (path.filename().empty()) path = path.parent_path();
    const bool was_saved = !projects::is_unsaved(path);
    if (was_saved && is_open(projects::project_folder(path))) {
        projects::load_project(path, registry_);  // throws while nothing is lost yet
        close();                                  // its lock is our own
    }
    adopt(!was_saved ? projects::OpenProject::recover_unsaved(path, registry_)
                     : std::make_unique<projects::OpenProject>(path, registry_));
}

bool Session::is_open(const std::filesystem::path& folder) const {
    std::error_code ignored;
    return project_ && std::filesystem::equivalent(folder, project_->folder(), ignored);
}

std::filesystem::path Session::put_aside(const projects::SampleCopy& copy) {
    if (!is_open(copy.folder)) return projects::put_aside(copy);
    const auto aside = projects::place_aside(copy);
    project_->rename_folder(aside);
    emit document_changed();
    return aside;
}

const MethodDescription* Session::first_method() const {
    const auto& methods = registry_.methods();
    const auto first = std::min_element(methods.begin(), methods.end(),
                                        [](const auto* a, const auto* b) { return a->title < b->title; });
    return first == methods.end() ? nullptr : *first;
}

void Session::create_from_scene(const std::string& source) {
    const auto* first = first_method();
    if (!first) throw Error("this build has no methods");
    projects::Project start;
    const auto scene = scene_item(start, source, {});
    start.name = scene.name;
    projects::edits::add(start, scene)->apply(start);
    const auto experiment = projects::edits::new_experiment(start, registry_, first->id, "", scene.id, "");
    projects::edits::add(start, experiment)->apply(start);
    adopt(std::make_unique<projects::OpenProject>(std::move(start), registry_));
}

void Session::add_scene(const std::string& source) {
    edit([&](const projects::Project& project) {
        return projects::edits::add(project, scene_item(project, source, project_->folder()));
    });
}

bool Session::add_image(const std::string& file) {
    return edit([&](const projects::Project& project) {
        projects::ForeignImage image;
        image.name = std::filesystem::path(file).stem().string();
        image.id = projects::free_id_in(project.images, image.name);
        image.source = projects::relative_source(file, project_->folder());
        return projects::edits::add(project, image);
    });
}

void Session::adopt(std::unique_ptr<projects::OpenProject> project) {
    close();
    project_ = std::move(project);
    if (!unsaved_folder_.empty()) project_->autosave_unsaved_in(unsaved_folder_);
    // The word comes from another thread; the project may be gone when it arrives.
    project_->set_on_files_read(
        [this] { QMetaObject::invokeMethod(this, &Session::poll_files, Qt::QueuedConnection); });
    memory_ =
        project_->folder().empty() ? projects::Json::object() : projects::load_session(project_->folder());
    saved_memory_ = memory_;
    const auto remembered = memory_.find("experiment");
    experiment_id_ =
        remembered != memory_.end() && remembered->is_string() ? remembered->get<std::string>() : "";
    emit project_replaced();
    report_project_messages();
    emit document_changed();
    emit experiment_selected();
}

void Session::poll_files() {
    if (project_ && project_->poll_files()) emit files_changed();
}

void Session::look_at_files() {
    if (project_) project_->look_at_files();
}

void Session::report_project_messages() {
    for (const auto& each : project_->messages()) emit message(each);
}

void Session::close() {
    if (!project_) return;
    save_memory();
    project_->close();  // an autosave that is no longer wanted goes
    project_.reset();
    moved_pose_.reset();
    moved_.clear();
    scene_cameras_.clear();
    memory_ = projects::Json::object();
    experiment_id_.clear();
    emit project_replaced();
}

void Session::leave() {
    if (!project_) return;
    is_left_ = true;
    finish_camera_move();
    autosave();
    project_->wait_for_autosave();
    if (const auto error = project_->take_autosave_error(); !error.empty())
        emit message({Severity::error, "autosave", error});
    save_memory();
}

void Session::save(bool overwrite) {
    finish_camera_move();
    project_->save(overwrite);
    save_memory();
    emit document_changed();
}

void Session::save_as(const std::filesystem::path& path) {
    finish_camera_move();
    project_->save_as(path);
    save_memory();
    emit document_changed();
}

void Session::save_memory() {
    if (!project_) return;
    emit memory_wanted();
    write_memory();
}

void Session::write_memory() {
    if (!project_ || project_->folder().empty() || project_->is_read_only()) return;
    if (const auto* chosen = experiment()) memory_["experiment"] = chosen->id;
    try {
        projects::save_session(project_->folder(), memory_);
        saved_memory_ = memory_;
    } catch (const std::exception& error) {  // nothing of value is in it
        emit message({Severity::warning, "project", error.what()});
    }
}

void Session::take_recovery() {
    finish_camera_move();  // it belongs to what undo comes back to
    guarded([&] { return project_->take_recovery(), changed(true); });
}

void Session::discard_recovery() {
    guarded([&] { return project_->discard_recovery(), true; });
}

void Session::break_lock() {
    guarded([&] { return project_->break_lock(), changed(true); });
}

void Session::autosave() {
    if (!project_ || project_->is_read_only()) return;
    guarded([&] {
        project_->autosave();
        const auto error = project_->take_autosave_error();
        if (!error.empty()) emit message({Severity::warning, "autosave", error});
        return true;
    });
    emit memory_wanted();
    if (memory_ != saved_memory_) write_memory();
}

}  // namespace ir::gui
