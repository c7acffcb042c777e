#include "widgets/space/space_tools.h"

#include <QAction>
#include <QActionGroup>

#include "widgets/style/icons.h"

namespace ir::widgets {

SpaceTools::SpaceTools(QWidget* parent) : QToolBar(parent) {
    setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    setIconSize({16, 16});
    const auto add = [&](const QString& text, const char* name, bool checkable) {
        auto* action = addAction(text);
        action->setObjectName(QLatin1String(name));
        action->setCheckable(checkable);
        return action;
    };
    experiment_camera_ = add(tr("Experiment's camera"), "experiment_camera", true);
    free_camera_ = add(tr("Free camera"), "free_camera", true);
    auto* group = new QActionGroup(this);
    group->addAction(experiment_camera_);
    group->addAction(free_camera_);
    addSeparator();
    auto* frame = add(tr("Frame"), "frame", false);
    frame->setIcon(icon("fit"));
    frame->setToolTip(tr("Show everything (F, or a double click)"));
    show_scene_ = add(tr("Scene"), "show_scene", true);
    show_scene_->setToolTip(tr("Draw the scene, flat shaded, behind the layers"));
    show_centres_ = add(tr("Centres"), "show_centres", true);
    show_centres_->setToolTip(tr("Mark the centres of the sphere's regions"));
    connect(experiment_camera_, &QAction::triggered, this, &SpaceTools::experiment_camera_wanted);
    connect(free_camera_, &QAction::triggered, this, &SpaceTools::free_camera_wanted);
    connect(frame, &QAction::triggered, this, &SpaceTools::frame_wanted);
    connect(show_scene_, &QAction::triggered, this, &SpaceTools::scene_toggled);
    connect(show_centres_, &QAction::triggered, this, &SpaceTools::centres_toggled);
}

void SpaceTools::show_state(const SpaceScene& scene, bool own_space) {
    const bool sphere = shows_sphere(scene);
    for (QAction* action : {experiment_camera_, free_camera_}) action->setEnabled(!sphere);
    (scene.camera ? free_camera_ : experiment_camera_)->setChecked(true);
    const QString on_sphere = tr("A sphere of directions is always seen from outside");
    experiment_camera_->setText(own_space ? tr("From the front") : tr("Experiment's camera"));
    experiment_camera_->setToolTip(sphere      ? on_sphere
                                   : own_space ? tr("See all of it from the front (Home)")
                                               : tr("See it as the experiment does (Home)"));
    free_camera_->setToolTip(sphere ? on_sphere
                                    : tr("Drag to orbit, Shift-drag to slide, Ctrl-drag to look around,\n"
                                         "wheel to go nearer, W A S D Q E to fly"));
    show_scene_->setChecked(scene.show_scene);
    show_scene_->setVisible(!sphere && !own_space);
    show_centres_->setChecked(scene.show_centres);
    show_centres_->setVisible(sphere);
}

}  // namespace ir::widgets
