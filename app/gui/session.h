#pragma once

#include <QObject>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "projects/edits.h"
#include "projects/open_project.h"
#include "projects/sample_copy.h"
#include "projects/session.h"
#include "projects/text.h"
#include "renderers/scene/scene.h"
#include "widgets/image/camera_motion.h"

namespace ir::gui {

/// The open project and the experiment that is worked on. Every change goes through here and can be undone.
/// No widgets, no pictures.
class Session : public QObject {
    Q_OBJECT
  public:
    explicit Session(const Registry& registry, QObject* parent = nullptr);
    /// A project that was never saved is dropped; that a crash leaves behind is offered later.
    ~Session() override;
    /// Where projects that were never saved are autosaved, from the next one on; at first
    /// unsaved_projects_folder().
    void set_unsaved_folder(const std::filesystem::path& folder) { unsaved_folder_ = folder; }

    // Files. All throw Error with one line; the project that was open stays open then.
    /// A project's folder, also one that a crash left before the project was ever saved. The one that is open
    /// is closed and read again, if it can be read.
    void open(const std::filesystem::path& path);
    /// projects::put_aside(), also of the copy that is open, which stays open under its other name.
    std::filesystem::path put_aside(const projects::SampleCopy& copy);
    /// Not saved yet, with nothing to undo.
    void create_from_scene(const std::string& scene);
    void add_scene(const std::string& scene);  ///< an edit
    /// An edit: a picture of another renderer. Returns whether it was added.
    bool add_image(const std::string& file);
    void save(bool overwrite = false);
    void save_as(const std::filesystem::path& path);
    void close();
    /// The program is told to end and asks nobody: what is not saved is written down, and offered when the
    /// project is opened again. Nothing should be changed afterwards.
    void leave();
    void take_recovery();  ///< can be undone
    void discard_recovery();
    void break_lock();
    /// Looks again whether scenes and images on disk are those of the project; files_changed() follows.
    void look_at_files();

    bool has_project() const { return project_ != nullptr; }
    const projects::OpenProject& open_project() const { return *project_; }
    projects::OpenProject& open_project() { return *project_; }
    const projects::Project& document() const { return project_->project(); }
    const Registry& registry() const { return registry_; }
    /// The experiment that is worked on; null without a project or without experiments.
    const projects::Experiment* experiment() const;
    const projects::Experiment* experiment(const std::string& id) const;
    const MethodDescription* method() const;  ///< of the experiment; null when unknown
    /// That experiments begin with where nothing else is known: the first by title. Null where there is none.
    const MethodDescription* first_method() const;
    void select_experiment(const std::string& id);

    /// Applies an edit made by `make(project)`; errors become messages. Returns whether the document changed.
    template <class Make>
    bool edit(Make make) {
        return guarded([&] { return project_ && changed(project_->edit(make(project_->project()))); });
    }
    void end_gesture();
    /// What is kept now, by whomever.
    void set_last_kept(const projects::LastKept& keys);
    void undo();
    void redo();

    // Camera of the experiment. Moves are shown at once and become one edit when the gesture ends.
    /// The scene's cameras in world space, for experiments that use one of them.
    void set_scene_cameras(std::vector<scene::Camera> cameras) { scene_cameras_ = std::move(cameras); }
    std::optional<widgets::CameraPose> camera_pose() const;
    /// Where the timeline stands, seconds; absent: at the experiment's own time.
    void set_shown_time(std::optional<double> time) { shown_time_ = time; }
    /// While a gesture lasts: the pose of an experiment that it moves.
    std::optional<widgets::CameraPose> moved_pose(const std::string& experiment) const;
    /// Moves an experiment, and others together with it.
    void move_camera(const std::string& experiment, const widgets::CameraPose& pose,
                     const std::vector<std::string>& others = {});
    void finish_camera_move();
    /// A camera of the document with the present pose.
    void bookmark_camera();

    /// session.json: neither undone nor dirty.
    projects::Json& memory() { return memory_; }
    /// Writes unsaved changes beside the project, and session.json where it changed. A timer calls it, too.
    void autosave();

  signals:
    void project_replaced();
    void document_changed();
    void experiment_selected();
    void camera_moved();
    /// What is known of the scenes and images on disk.
    void files_changed();
    /// memory() is about to be written: put into it what is to be remembered.
    void memory_wanted();
    void message(const ir::Message& message);

  private:
    static constexpr std::size_t longest_line = 4096;  ///< paths may be long and hold line breaks
    template <class Work>
    bool guarded(Work work) {
        try {
            return work();
        } catch (const std::exception& error) {
            emit message({Severity::error, "project", projects::printable(error.what(), longest_line)});
            return false;
        }
    }
    bool is_open(const std::filesystem::path& folder) const;
    void adopt(std::unique_ptr<projects::OpenProject> project);
    bool changed(bool really);
    void save_memory();
    void write_memory();
    void report_project_messages();
    void poll_files();

    const Registry& registry_;
    std::unique_ptr<projects::OpenProject> project_;
    std::string experiment_id_;
    std::vector<scene::Camera> scene_cameras_;
    std::optional<widgets::CameraPose> moved_pose_;
    std::vector<std::string> moved_;  ///< experiments that the gesture moves
    std::optional<double> shown_time_;
    projects::Json memory_ = projects::Json::object();
    projects::Json saved_memory_;  ///< as it is on disk
    std::filesystem::path unsaved_folder_;
    bool is_left_ = false;
    QTimer autosave_timer_;
};

/// Calls a slot of the receiver whenever there may be another project, document or experiment.
template <class Receiver, class Slot>
void follow(const Session& session, Receiver* receiver, Slot slot) {
    for (const auto signal :
         {&Session::project_replaced, &Session::document_changed, &Session::experiment_selected})
        QObject::connect(&session, signal, receiver, slot);
}

}  // namespace ir::gui
