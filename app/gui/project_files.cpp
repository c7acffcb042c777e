#include "app/gui/project_files.h"

#include <exception>

#include "app/gui/known_projects.h"
#include "app/gui/patient_files.h"
#include "app/gui/session.h"
#include "projects/gltf_references.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "renderers/core/error.h"

namespace ir::gui {
namespace {

using projects::OpenProject;

constexpr int autosave_ms = 20000;

/// "sponza" of "/scenes/sponza.glb", "cornell" of "builtin:cornell@1".
std::string scene_title(const std::string& scene) {
    if (projects::is_builtin(scene)) {
        const auto name = scene.substr(scene.find(':') + 1);
        return name.substr(0, name.find_first_of("@?"));
    }
    return std::filesystem::path(scene).stem().string();
}

void wait_for_autosave(OpenProject& open) {
    patient_files().wait_for([&open] { open.wait_for_autosave(); });
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

ProjectFiles::ProjectFiles(Session& session) : session_(session), unsaved_folder_(unsaved_projects_folder()) {
    autosave_timer_.setInterval(autosave_ms);
    connect(&autosave_timer_, &QTimer::timeout, this, [this] {
        if (!patient_files().is_waiting()) autosave();
    });
    autosave_timer_.start();
}

void ProjectFiles::open(const std::filesystem::path& given) {
    // Whatever folder the program is in later.
    auto path = std::filesystem::absolute(given).lexically_normal();
    if (path.filename().empty()) path = path.parent_path();
    const auto& registry = session_.registry();
    const bool was_saved = !projects::is_unsaved(path);
    if (was_saved && is_open(projects::project_folder(path))) {
        projects::load_project(projects::project_folder(path), registry,
                               patient_files());  // throws while nothing is lost yet
        close();                                  // its lock is our own
    }
    std::unique_ptr<OpenProject> opened;
    patient_files().wait_for([&] {
        opened = was_saved ? std::make_unique<OpenProject>(path, registry, patient_files())
                           : OpenProject::recover_unsaved(path, registry, patient_files());
    });
    adopt(std::move(opened));
}

bool ProjectFiles::is_open(const std::filesystem::path& folder) const {
    std::error_code ignored;
    return session_.has_project() &&
           std::filesystem::equivalent(folder, session_.open_project().folder(), ignored);
}

std::filesystem::path ProjectFiles::put_aside(const projects::SampleCopy& copy) {
    if (!is_open(copy.folder)) return projects::put_aside(copy);
    const auto aside = projects::place_aside(copy);
    session_.open_project().rename_folder(aside);
    session_.change([](OpenProject&) { return true; });
    return aside;
}

void ProjectFiles::create_from_scene(const std::string& source) {
    const auto& registry = session_.registry();
    const auto* first = session_.first_method();
    if (!first) throw Error("this build has no methods");
    patient_files().wait_for([&] {
        if (!projects::is_builtin(source) && projects::is_no_gltf(source))
            throw Error(source + ": is no glTF scene: neither a GLB file nor JSON; choose another file");
    });
    projects::Project start;
    const auto scene = scene_item(start, source, {});
    start.name = scene.name;
    projects::edits::add(start, scene)->apply(start);
    const auto experiment = projects::edits::new_experiment(start, registry, first->id, "", scene.id, "");
    projects::edits::add(start, experiment)->apply(start);
    adopt(std::make_unique<OpenProject>(std::move(start), registry, patient_files()));
}

void ProjectFiles::adopt(std::unique_ptr<OpenProject> project) {
    close();
    if (!unsaved_folder_.empty()) project->autosave_unsaved_in(unsaved_folder_);
    // The word comes from another thread; the project may be gone when it arrives.
    project->set_on_files_read(
        [this] { QMetaObject::invokeMethod(this, &ProjectFiles::poll_files, Qt::QueuedConnection); });
    memory_ = project->folder().empty() ? projects::Json::object()
                                        : projects::load_session(project->folder(), patient_files());
    saved_memory_ = memory_;
    const auto remembered = memory_.find("experiment");
    const bool is_known = remembered != memory_.end() && remembered->is_string();
    session_.replace(std::move(project), is_known ? remembered->get<std::string>() : std::string());
}

void ProjectFiles::add_scene(const std::string& source) {
    session_.edit([&](const projects::Project& project) {
        return projects::edits::add(project, scene_item(project, source, session_.open_project().folder()));
    });
}

bool ProjectFiles::add_image(const std::string& file) {
    return session_.edit([&](const projects::Project& project) {
        projects::ForeignImage image;
        image.name = std::filesystem::path(file).stem().string();
        image.id = projects::free_id_in(project.images, image.name);
        image.source = projects::relative_source(file, session_.open_project().folder());
        return projects::edits::add(project, image);
    });
}

void ProjectFiles::poll_files() {
    if (session_.has_project() && session_.open_project().poll_files()) emit files_changed();
}

void ProjectFiles::look_at_files() {
    if (session_.has_project()) session_.open_project().look_at_files();
}

void ProjectFiles::close() {
    if (!session_.has_project()) return;
    save_memory();
    session_.open_project().close();  // an autosave that is no longer wanted goes
    memory_ = projects::Json::object();
    session_.replace(nullptr);
}

void ProjectFiles::leave() {
    if (!session_.has_project()) return;
    is_left_ = true;
    session_.camera().finish_move();
    autosave();
    wait_for_autosave(session_.open_project());
    if (const auto error = session_.open_project().take_autosave_error(); !error.empty())
        emit message({Severity::error, "autosave", error});
    save_memory();
}

void ProjectFiles::drop_unsaved() {
    const PatientFiles::Silence silence;  // the window goes
    // Neither told to end nor by an error that unwinds everything.
    if (session_.has_project() && session_.open_project().folder().empty() && !is_left_ &&
        std::uncaught_exceptions() == 0)
        session_.open_project().close();
}

void ProjectFiles::save(bool overwrite) {
    session_.camera().finish_move();
    wait_for_autosave(session_.open_project());
    session_.open_project().save(overwrite);
    save_memory();
    session_.change([](OpenProject&) { return true; });
    if (is_left_) leave();  // the program was told to end meanwhile
}

void ProjectFiles::save_as(const std::filesystem::path& path) {
    session_.camera().finish_move();
    wait_for_autosave(session_.open_project());
    session_.open_project().save_as(path);
    save_memory();
    session_.change([](OpenProject&) { return true; });
    if (is_left_) leave();  // the program was told to end meanwhile
}

void ProjectFiles::save_memory() {
    if (!session_.has_project()) return;
    emit memory_wanted();
    write_memory();
}

void ProjectFiles::write_memory() {
    const auto& project = session_.open_project();
    if (project.folder().empty() || project.is_read_only()) return;
    if (const auto* chosen = session_.experiment()) memory_["experiment"] = chosen->id;
    try {
        projects::save_session(project.folder(), memory_, patient_files());
        saved_memory_ = memory_;
    } catch (const std::exception& error) {  // nothing of value is in it
        emit message({Severity::warning, "project", error.what()});
    }
}

void ProjectFiles::take_recovery() {
    session_.camera().finish_move();  // it belongs to what undo comes back to
    session_.change([](OpenProject& open) { return open.take_recovery(), true; });
}

void ProjectFiles::discard_recovery() {
    session_.change([](OpenProject& open) { return open.discard_recovery(), false; });
}

void ProjectFiles::break_lock() {
    session_.change([](OpenProject& open) { return open.break_lock(), true; });
}

void ProjectFiles::autosave() {
    if (!session_.has_project() || session_.open_project().is_read_only()) return;
    session_.change([this](OpenProject& open) {
        open.autosave();
        const auto error = open.take_autosave_error();
        if (!error.empty()) emit message({Severity::warning, "autosave", error});
        return false;
    });
    emit memory_wanted();
    if (memory_ != saved_memory_) write_memory();
}

}  // namespace ir::gui
