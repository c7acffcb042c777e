#include "widgets/document/camera_editor.h"

#include <QApplication>
#include <QClipboard>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "renderers/core/error.h"
#include "widgets/document/field_edit.h"
#include "widgets/document/fields.h"
#include "widgets/document/makers.h"
#include "widgets/document/pose_text.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::Camera;

CameraPose pose_of(const Camera& camera) {
    return {camera.eye, camera.target, camera.up, camera.fov_y_degrees, camera.orthographic, camera.height};
}

}  // namespace

CameraEditor::CameraEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Camera"), this);
    name_ = name_row(grid, ItemKind::camera, tr("What the camera is called"));
    source_ = new ChoiceField("source", this);
    row(grid, tr("Pose"), source_, tr("A pose of its own, or that of a camera in the scene's file"));
    connect(source_, &ChoiceField::chosen, this, &CameraEditor::choose_source);
    auto* position = make_form_section(tr("Position"), this);
    hint_ = new QLabel(tr("It stands in the scene's file and is known once that is loaded."), this);
    hint_->setWordWrap(true);
    hint_->setForegroundRole(QPalette::PlaceholderText);
    add_wide(position, hint_);
    make_pose_rows(position);
    make_text_rows(make_form_section(tr("As text"), this));
}

VectorField* CameraEditor::vector_row(QGridLayout* grid, const char* name, const QString& label,
                                      const QString& tip, glm::dvec3 Camera::*member) {
    auto* field =
        new VectorField(name, {QStringLiteral("x"), QStringLiteral("y"), QStringLiteral("z")}, this);
    pose_rows_.insert(pose_rows_.end(), {row(grid, label, field, tip), field});
    connect(field, &VectorField::chosen, this, [this, name, member](int index, double value) {
        emit edit_wanted(
            field_edit<Camera>(id_, name, [=](Camera& camera) { (camera.*member)[index] = value; }));
    });
    return field;
}

void CameraEditor::make_pose_rows(QGridLayout* grid) {
    eye_ = vector_row(grid, "eye", tr("Eye"), tr("Where the camera is: x, y, z in metres, world space"),
                      &Camera::eye);
    target_ =
        vector_row(grid, "target", tr("Target"),
                   tr("What it looks at: x, y, z in metres; orbits turn about this point"), &Camera::target);
    up_ = vector_row(grid, "up", tr("Up"), tr("Direction that is up in the picture: x, y, z, any length"),
                     &Camera::up);
    projection_ = new ChoiceField("projection", this);
    auto* projection_label = row(grid, tr("Projection"), projection_, tr("Perspective, or parallel rays"));
    pose_rows_.insert(pose_rows_.end(), {projection_label, projection_});
    connect(projection_, &ChoiceField::chosen, this, [this](const QString& id) {
        const bool orthographic = id == QLatin1String("orthographic");
        emit edit_wanted(field_edit<Camera>(
            id_, "projection", [=](Camera& camera) { camera.orthographic = orthographic; }, false));
    });
    fov_ = make_number("fov", 0.001, 179.999, QStringLiteral("°"), this);
    fov_label_ = row(grid, tr("View angle"), fov_, tr("Vertical field of view in degrees"));
    connect(fov_, &NumberField::chosen, this, [this](double value) {
        emit edit_wanted(
            field_edit<Camera>(id_, "field of view", [=](Camera& camera) { camera.fov_y_degrees = value; }));
    });
    height_ = make_number("height", 1e-9, 1e9, QStringLiteral("m"), this);
    height_label_ = row(grid, tr("Height"), height_, tr("Metres from the picture's lower to its upper edge"));
    connect(height_, &NumberField::chosen, this, [this](double value) {
        emit edit_wanted(field_edit<Camera>(id_, "height", [=](Camera& camera) { camera.height = value; }));
    });
}

void CameraEditor::make_text_rows(QGridLayout* grid) {
    text_ = new TextField("pose-text", this);
    text_->setAccessibleName(tr("Pose as text"));
    set_tip(text_,
            tr("<p>Eye, target, up and vertical field of view: <tt>x,y,z x,y,z x,y,z FOV</tt>; parallel "
               "projections end in their height, <tt>2m</tt>. Up and the last may be missing. The "
               "options of the command line are taken as well.</p>"));
    add_wide(grid, text_);
    add_control(text_);
    connect(text_, &TextField::chosen, this, &CameraEditor::take_text);
    copy_ = make_button("copy", tr("Copy the pose as text"), this);
    copy_->setObjectName(QStringLiteral("copy-pose"));
    paste_ = make_button("paste", tr("Paste a pose from the clipboard"), this);
    paste_->setObjectName(QStringLiteral("paste-pose"));
    from_view_ = make_button("camera", tr("Take the pose from the view"), this);
    from_view_->setObjectName(QStringLiteral("pose-from-view"));
    auto* buttons = new QHBoxLayout;
    const auto add = [&](QToolButton* button, const QString& text) {
        button->setText(text);
        button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
        buttons->addWidget(button);
    };
    add(copy_, tr("Copy"));
    add(paste_, tr("Paste"));
    add(from_view_, tr("From the view"));
    buttons->addStretch();
    grid->addLayout(buttons, grid->rowCount(), 0, 1, 3);
    add_control(paste_);
    add_control(from_view_);
    connect(copy_, &QToolButton::clicked, this,
            [this] { QApplication::clipboard()->setText(QString::fromStdString(pose_text(pose_))); });
    connect(paste_, &QToolButton::clicked, this,
            [this] { take_text(QApplication::clipboard()->text().trimmed()); });
    connect(from_view_, &QToolButton::clicked, this, [this] {
        if (const auto pose = view_pose_ ? view_pose_() : std::nullopt)
            emit edit_wanted(makers::set_pose(id_, *pose));
        else
            emit edit_wanted([](const projects::Project&) -> projects::EditPtr {
                throw UsageError("there is no picture yet to take a pose from");
            });
    });
}

void CameraEditor::set_view_pose(std::function<std::optional<CameraPose>()> pose) {
    view_pose_ = std::move(pose);
}

void CameraEditor::take_text(const QString& text) {
    const auto make = [id = id_, typed = text.toStdString(),
                       present = pose_](const projects::Project& project) {
        return makers::set_pose(id, parse_pose(typed, present))(project);
    };
    emit edit_wanted(make);
}

void CameraEditor::choose_source(const QString& name) {
    // Its own pose begins where the file's camera stands.
    if (name.isEmpty() && file_poses_.count(source_name_) != 0)
        return emit edit_wanted(makers::set_pose(id_, pose_));
    emit edit_wanted(field_edit<Camera>(
        id_, "source", [name = name.toStdString()](Camera& camera) { camera.scene_camera = name; }, false));
}

void CameraEditor::show_sources(const ShownProject& shown, const Camera& camera) {
    std::vector<Option> options{{QString(), tr("Its own"), {}}};
    for (const QString& name : shown.facts.cameras)
        options.push_back({name, tr("From the file: %1").arg(name), {}});
    source_->show_options(options, QString::fromStdString(camera.scene_camera));
}

void CameraEditor::show_item(const ShownProject& shown, const ItemRef& item) {
    id_ = item.id.toStdString();
    const Camera& camera = *projects::find_item(shown.project.cameras, id_);
    const QString why_not = shown.read_only ? shown.why_read_only : QString();
    set_controls_usable(why_not);
    pose_ = pose_of(camera);
    file_poses_ = shown.facts.poses;
    source_name_ = QString::fromStdString(camera.scene_camera);
    const auto found = file_poses_.find(source_name_);
    if (found != file_poses_.end()) pose_ = found->second;
    name_->show_text(QString::fromStdString(camera.name));
    show_sources(shown, camera);
    show_pose(source_name_.isEmpty() || found != file_poses_.end());
    if (source_name_.isEmpty() || shown.read_only) return;
    const QString from_file =
        tr("The pose comes from the file's camera “%1”; choose “Its own” above to edit it.")
            .arg(source_name_);
    for (QWidget* widget : std::initializer_list<QWidget*>{eye_, target_, up_, projection_, fov_, height_})
        set_usable(widget, from_file);
}

void CameraEditor::show_pose(bool is_known) {
    eye_->show_values(numbers(pose_.eye));
    target_->show_values(numbers(pose_.target));
    up_->show_values(numbers(pose_.up));
    projection_->show_options(
        {{QStringLiteral("perspective"), tr("Perspective"), {}},
         {QStringLiteral("orthographic"), tr("Parallel (orthographic)"), {}}},
        pose_.orthographic ? QStringLiteral("orthographic") : QStringLiteral("perspective"));
    fov_->show_value(pose_.fov_y_degrees);
    height_->show_value(pose_.height);
    for (auto* widget : pose_rows_) widget->setVisible(is_known);
    for (QWidget* widget : std::initializer_list<QWidget*>{fov_, fov_label_})
        widget->setVisible(is_known && !pose_.orthographic);
    for (QWidget* widget : std::initializer_list<QWidget*>{height_, height_label_})
        widget->setVisible(is_known && pose_.orthographic);
    hint_->setVisible(!is_known);
    text_->show_text(is_known ? QString::fromStdString(pose_text(pose_)) : QString());
    set_usable(copy_, is_known ? QString() : tr("The pose is not known yet."));
}

}  // namespace ir::widgets
