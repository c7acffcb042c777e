#pragma once

#include <QObject>
#include <exception>
#include <memory>
#include <string>

#include "app/gui/experiment_camera.h"
#include "app/gui/project_files.h"
#include "projects/edits.h"
#include "projects/open_project.h"
#include "projects/text.h"

namespace ir::gui {

/// Why a project is open read-only, in a sentence.
QString read_only_text(const projects::OpenProject& open);

/// The open project and the experiment that is worked on. Every change of the document goes through here and
/// can be undone. No widgets, no pictures.
class Session : public QObject {
    Q_OBJECT
  public:
    explicit Session(const Registry& registry, QObject* parent = nullptr);
    /// A project that was never saved is dropped; that a crash leaves behind is offered later.
    ~Session() override;
    ProjectFiles& files() { return files_; }
    ExperimentCamera& camera() { return camera_; }

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

    /// Applies an edit made by `make(project)`, null: none; errors become messages. Returns whether the
    /// document changed.
    template <class Make>
    bool edit(Make make) {
        return change([&](projects::OpenProject& open) {
            projects::EditPtr edit = make(open.project());
            return edit && open.edit(std::move(edit));
        });
    }
    /// As edit(), for what is done to the open project otherwise: `work` says whether it changed.
    template <class Work>
    bool change(Work work) {
        try {
            if (!project_ || !work(*project_)) return false;
            emit document_changed();
            return true;
        } catch (const std::exception& error) {
            say_error(error);
            return false;
        }
    }
    void end_gesture();
    void undo();
    void redo();
    /// Another project, or none, and the experiment to begin with.
    void replace(std::unique_ptr<projects::OpenProject> project, const std::string& experiment = {});

  signals:
    void project_replaced();
    void document_changed();
    void experiment_selected();
    void message(const ir::Message& message);

  private:
    void say_error(const std::exception& error);

    const Registry& registry_;
    ProjectFiles files_;
    ExperimentCamera camera_;
    std::unique_ptr<projects::OpenProject> project_;
    std::string experiment_id_;
};

/// Calls a slot of the receiver whenever there may be another project, document or experiment.
template <class Receiver, class Slot>
void follow(const Session& session, Receiver* receiver, Slot slot) {
    for (const auto signal :
         {&Session::project_replaced, &Session::document_changed, &Session::experiment_selected})
        QObject::connect(&session, signal, receiver, slot);
}

}  // namespace ir::gui
