#include "widgets/document/camera_editor.h"

#include <QApplication>
#include <QClipboard>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "renderers/core/error.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/fields.h"
#include "widgets/document/makers.h"
#include "widgets/document/pose_text.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::Camera;

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

VectorField* CameraEditor::vector_row(QGridLayout* grid, const std::string& key) {
    const auto& camera_field = projects::field_of(projects::camera_fields(), key);
    auto* field = new VectorField(q(key), xyz, this);
    pose_rows_.insert(pose_rows_.end(), {row(grid, camera_field.text, field), field});
    connect(field, &VectorField::chosen, this, [this, &camera_field](int index, double value) {
        emit edit_wanted(
            field_edit<Camera>(id_, camera_field.text.key, [&camera_field, index, value](Camera& camera) {
                projects::set_number(camera_field.slot(camera), index, value);
            }));
    });
    return field;
}

CameraEditor::NumberRow CameraEditor::number_row(QGridLayout* grid, const std::string& key) {
    const auto& camera_field = projects::field_of(projects::camera_fields(), key);
    auto* field = make_number(q(key), camera_field.text, this);
    auto* label = row(grid, camera_field.text, field);
    const std::string name = q(camera_field.text.label).toLower().toStdString();
    connect(field, &NumberField::chosen, this, [this, name, &camera_field](double value) {
        emit edit_wanted(field_edit<Camera>(id_, name, [&camera_field, value](Camera& camera) {
            projects::set_number(camera_field.slot(camera), 0, value);
        }));
    });
    return {label, field, &camera_field};
}

void CameraEditor::make_pose_rows(QGridLayout* grid) {
    eye_ = vector_row(grid, "eye");
    target_ = vector_row(grid, "target");
    up_ = vector_row(grid, "up");
    projection_ = new ChoiceField("projection", this);
    auto* projection_label = row(grid, tr("Projection"), projection_, tr("Perspective, or parallel rays"));
    pose_rows_.insert(pose_rows_.end(), {projection_label, projection_});
    connect(projection_, &ChoiceField::chosen, this, [this](const QString& id) {
        const bool orthographic = id == QLatin1String("orthographic");
        emit edit_wanted(field_edit<Camera>(
            id_, "projection", [=](Camera& camera) { camera.orthographic = orthographic; }, false));
    });
    numbers_ = {number_row(grid, "fov_y_degrees"), number_row(grid, "height")};
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
    pose_ = camera;
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
    for (QWidget* widget : std::initializer_list<QWidget*>{eye_, target_, up_, projection_})
        set_usable(widget, from_file);
    for (const auto& each : numbers_) set_usable(each.control, from_file);
}

void CameraEditor::show_pose(bool is_known) {
    eye_->show_values(numbers(pose_.eye));
    target_->show_values(numbers(pose_.target));
    up_->show_values(numbers(pose_.up));
    projection_->show_options(
        {{QStringLiteral("perspective"), tr("Perspective"), {}},
         {QStringLiteral("orthographic"), tr("Parallel (orthographic)"), {}}},
        pose_.orthographic ? QStringLiteral("orthographic") : QStringLiteral("perspective"));
    Camera camera;
    camera.set_pose(pose_);
    for (auto* widget : pose_rows_) widget->setVisible(is_known);
    for (const auto& each : numbers_) {
        each.control->show_value(projects::numbers_of(each.field->slot(camera)).front());
        const bool shown = is_known && each.field->counts_in(camera);
        each.label->setVisible(shown);
        each.control->setVisible(shown);
    }
    hint_->setVisible(!is_known);
    text_->show_text(is_known ? QString::fromStdString(pose_text(pose_)) : QString());
    set_usable(copy_, is_known ? QString() : tr("The pose is not known yet."));
}

}  // namespace ir::widgets
