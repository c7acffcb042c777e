#pragma once

#include <QScrollArea>

#include "app/gui/notices.h"
#include "app/gui/scene_shelf.h"
#include "widgets/document/experiment_panel.h"
#include "widgets/parameters/parameter_panel.h"

class QLineEdit;

namespace ir::gui {

/// The experiment that is worked on: what it is made of and its method's parameters, joined to the session.
class ParameterDock : public QScrollArea {
    Q_OBJECT
  public:
    ParameterDock(Session& session, SceneShelf& scenes, Notices& notices);
    /// Of the button beside the experiment's name.
    void set_menu(QMenu* menu) { experiment_->set_menu(menu); }
    /// A camera of the scene's file, by way of a camera of the document that stands for it.
    void use_scene_camera(const QString& name);
    /// Scrolls to a parameter of the method and gives it the keyboard.
    void show_parameter(const std::string& key);
    /// Asks for the manual's page of the parameter that has the keyboard, for its first page where none has.
    void explain();
    static QKeySequence explain_key() { return Qt::SHIFT | Qt::Key_F1; }

  signals:
    /// A page of the manual, and the parameter that it is opened for.
    void page_wanted(const QString& file, const QString& key);
    /// The parameter is to vary in a sweep.
    void sweep_wanted(const std::string& key);

  private:
    void explain_parameter(const std::string& key);
    void connect_experiment();
    void connect_parameters();
    void choose_method(const QString& method);
    void choose_camera(const QString& id);
    void update_panels();
    widgets::ExperimentFields fields() const;
    /// An edit of the experiment: `make` gets the document and the experiment's id.
    template <class Make>
    bool edit(Make make) {
        const auto* chosen = session_.experiment();
        const std::string id = chosen ? chosen->id : std::string();
        return session_.edit([&](const projects::Project& project) { return make(project, id); });
    }

    Session& session_;
    SceneShelf& scenes_;
    Notices& notices_;
    widgets::ExperimentPanel* experiment_;
    widgets::ParameterPanel* parameters_;
    QLineEdit* filter_;
};

}  // namespace ir::gui
