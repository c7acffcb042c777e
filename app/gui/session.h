#pragma once

#include <QObject>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/gui/environment_loader.h"
#include "app/gui/renderer.h"
#include "projects/edits.h"
#include "projects/open_project.h"
#include "projects/session.h"
#include "widgets/image/camera_motion.h"

namespace ir::gui {

/// The open project and the experiment that is looked at, joined to the renderer: a change of the document is
/// a new request, and the newest wins. No widgets.
class Session : public QObject {
    Q_OBJECT
  public:
    enum class State { empty, blocked, rendering, done, cancelled, failed };

    Session(Renderer& renderer, const Registry& registry, QObject* parent = nullptr);

    // Files. All throw Error with one line; the project that was open stays open then.
    void open(const std::filesystem::path& path);
    void create_from_scene(const std::string& scene);
    void add_scene(const std::string& scene);  ///< an edit
    void save(bool overwrite = false);
    void save_as(const std::filesystem::path& path);
    void close();
    void take_recovery();
    void discard_recovery();
    void break_lock();

    bool has_project() const { return project_ != nullptr; }
    const projects::OpenProject& open_project() const { return *project_; }
    const projects::Project& document() const { return project_->project(); }
    const Registry& registry() const { return registry_; }
    /// The experiment that is looked at; null without a project or without experiments.
    const projects::Experiment* experiment() const;
    const MethodDescription* method() const;  ///< of the experiment; null when unknown
    void select_experiment(const std::string& id);

    /// Applies an edit made by `make(project)`; errors become messages. Returns whether the document changed.
    template <class Make>
    bool edit(Make make) {
        return guarded([&] { return project_ && changed(project_->edit(make(project_->project()))); });
    }
    void end_gesture();
    void undo();
    void redo();

    // What is shown.
    void show_buffer(const std::string& key);  ///< empty: the main result
    const std::string& shown_buffer() const { return shown_; }
    /// The key of the resource that a result shows, the main result's included.
    std::string shown_key(const engine::LiveResult& result) const;
    void show_part(int level, int layer);
    void set_thumbnails_wanted(bool wanted);
    State state() const { return state_; }
    const std::string& state_text() const { return state_text_; }
    const engine::SceneSummary* scene() const { return scene_ ? &*scene_ : nullptr; }
    const engine::LiveResult* result() const { return result_.get(); }
    /// Frames of the newest request that are done.
    int committed_frames() const { return result_ && result_->serial == serial_ ? result_->frame : 0; }

    // Camera. Moves are shown at once and become one edit when the gesture ends.
    std::optional<widgets::CameraPose> camera_pose() const;
    void move_camera(const widgets::CameraPose& pose);
    void finish_camera_move();

    void cancel();
    void render_again();
    void reload_shaders() { renderer_.reload_shaders(); }

    /// session.json: neither undone nor dirty.
    projects::Json& memory() { return memory_; }
    void save_memory();

  signals:
    void project_replaced();
    void document_changed();
    void experiment_selected();
    void picture_arrived(std::shared_ptr<const ir::engine::LiveResult> result);
    void scene_changed();
    void state_changed();
    void progressed(const std::string& what, double fraction);
    void message(const ir::Message& message);

  private:
    template <class Work>
    bool guarded(Work work) {
        try {
            return work();
        } catch (const std::exception& error) {
            emit message({Severity::error, "project", error.what()});
            return false;
        }
    }
    void adopt(std::unique_ptr<projects::OpenProject> project);
    bool changed(bool really);
    void update_request();
    /// The experiment as it runs; nothing while its environment map is still being read.
    std::optional<engine::Experiment> resolved(const projects::Experiment& chosen);
    void load_scene(const std::vector<scene::Part>& parts);
    void send_request(const engine::Experiment& experiment, const std::string& signature);
    void set_state(State state, const std::string& text = {});
    void on_result(std::shared_ptr<const engine::LiveResult> result);
    void on_failure(const std::string& tag, const std::string& error, bool cancelled);
    void report_project_messages();
    void autosave();

    Renderer& renderer_;
    const Registry& registry_;
    std::unique_ptr<projects::OpenProject> project_;
    std::string experiment_id_, shown_, scene_key_, signature_, state_text_;
    int level_ = 0, layer_ = 0;
    bool thumbnails_ = true;
    State state_ = State::empty;
    std::uint64_t serial_ = 0;
    std::optional<engine::SceneSummary> scene_;
    std::shared_ptr<const engine::LiveResult> result_;
    std::optional<widgets::CameraPose> moved_pose_;
    projects::Json memory_ = projects::Json::object();
    EnvironmentLoader environments_;
    QTimer autosave_timer_;
};

}  // namespace ir::gui
