#include "widgets/document/plain_editors.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "widgets/document/edit_maker.h"
#include "widgets/document/fields.h"
#include "widgets/document/makers.h"
#include "widgets/document/options.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

QString why_not(const ShownProject& shown) {
    return shown.read_only ? shown.why_read_only : QString();
}

}  // namespace

ProjectEditor::ProjectEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Project"), this);
    name_ = name_row(grid, ItemKind::project, tr("What the project is called"));
    notes_ = new NotesField("notes", this);
    row(grid, tr("Notes"), notes_,
        tr("Whatever is worth knowing years later, as Markdown.\nLinks lead to places in the window:\n"
           "[words](view:2), [words](pin:3), [words](parameter:KEY),\n"
           "[words](buffer:KEY), [words](experiment:ID), [words](experiment:ID/KEY)"));
    connect(notes_, &NotesField::chosen, this, [this](const QString& text) {
        emit edit_wanted([notes = text.toStdString()](const projects::Project& project) {
            return projects::edits::set_notes(project, notes);
        });
    });
}

void ProjectEditor::show_item(const ShownProject& shown, const ItemRef&) {
    set_controls_usable(why_not(shown));
    name_->show_text(q(shown.project.name));
    notes_->show_text(q(shown.project.notes));
}

ExperimentEditor::ExperimentEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Experiment"), this);
    name_ = name_row(grid, ItemKind::experiment,
                     tr("What the experiment is called; its results are named after its id"));
    method_ = new QLabel(this);
    method_->setWordWrap(true);
    add_row(grid, tr("Method"), method_, tr("Its parameters are edited in the Experiment panel"));
    scene_ =
        choice_row(grid, "scene", tr("Scene"), tr("Scene that is rendered"), projects::edits::set_scene_of);
    camera_ =
        choice_row(grid, "camera", tr("Camera"), tr("Camera of the picture"), projects::edits::set_camera_of);
    lights_ = choice_row(grid, "lights", tr("Lights"), tr("Lights and environment"),
                         projects::edits::set_lights_of);
    reference_ = choice_row(grid, "reference", tr("Reference"), tr("Experiment that this one is judged by"),
                            projects::edits::set_reference);
    notes_ = new NotesField("notes", this);
    row(grid, tr("Notes"), notes_, tr("What it shows, and why"));
    connect(notes_, &NotesField::chosen, this, [this](const QString& text) {
        emit edit_wanted([id = id_, notes = text.toStdString()](const projects::Project& project) {
            return projects::edits::set_experiment_notes(project, id, notes);
        });
    });
}

ChoiceField* ExperimentEditor::choice_row(QGridLayout* grid, const char* name, const QString& label,
                                          const QString& tip, Maker make) {
    auto* field = new ChoiceField(name, this);
    row(grid, label, field, tip);
    connect(field, &ChoiceField::chosen, this, [this, make](const QString& chosen) {
        emit edit_wanted([make, id = id_, other = chosen.toStdString()](const projects::Project& project) {
            return make(project, id, other);
        });
    });
    return field;
}

void ExperimentEditor::show_item(const ShownProject& shown, const ItemRef& item) {
    id_ = item.id.toStdString();
    const auto& experiment = *projects::find_item(shown.project.experiments, id_);
    set_controls_usable(why_not(shown));
    name_->show_text(q(experiment.name));
    const auto* method = shown.registry.find(experiment.method);
    method_->setText(method ? q(method->title) : tr("%1 (not in this build)").arg(q(experiment.method)));
    scene_->show_options(named_options(shown.project.scenes), q(experiment.scene));
    camera_->show_options(
        with_first({QString(), tr("The scene's first camera"), {}}, named_options(shown.project.cameras)),
        q(experiment.camera));
    lights_->show_options(with_first({QString::fromLatin1(projects::scene_lights), tr("The scene's own"), {}},
                                     named_options(shown.project.lights)),
                          q(experiment.lights));
    auto others = named_options(shown.project.experiments);
    std::erase_if(others, [&](const Option& option) { return option.id == item.id; });
    reference_->show_options(with_first({QString(), tr("None"), {}}, others), q(experiment.reference));
    notes_->show_text(q(experiment.notes));
}

ImageEditor::ImageEditor(QWidget* parent) : ItemForm(parent) {
    using projects::ForeignImage;
    auto* grid = make_form_section(tr("Foreign image"), this);
    name_ = name_row(grid, ItemKind::image, tr("What the picture is called"));
    auto* box = new QWidget(this);
    auto* layout = new QHBoxLayout(box);
    layout->setContentsMargins(0, 0, 0, 0);
    file_ = new TextField("file", box);
    browse_ = make_button("open", tr("Choose another file …"), box);
    browse_->setObjectName(QStringLiteral("browse"));
    layout->addWidget(file_, 1);
    layout->addWidget(browse_);
    row(grid, projects::field_of(projects::image_fields(), "source").text, box);
    box->setFocusProxy(file_);
    connect(file_, &TextField::chosen, this, [this](const QString& source) {
        emit edit_wanted(makers::set_image_source(id_, source.toStdString()));
    });
    connect(browse_, &QToolButton::clicked, this, [this] { emit browse_wanted({ItemKind::image, q(id_)}); });
    notes_ = new NotesField("notes", this);
    row(grid, projects::field_of(projects::image_fields(), "notes").text, notes_);
    connect(notes_, &NotesField::chosen, this, [this](const QString& text) {
        emit edit_wanted(field_edit<ForeignImage>(
            id_, "notes", [notes = text.toStdString()](ForeignImage& image) { image.notes = notes; }));
    });
}

void ImageEditor::show_item(const ShownProject& shown, const ItemRef& item) {
    id_ = item.id.toStdString();
    const auto& image = *projects::find_item(shown.project.images, id_);
    set_controls_usable(why_not(shown));
    name_->show_text(q(image.name));
    file_->show_text(q(image.source));
    notes_->show_text(q(image.notes));
}

}  // namespace ir::widgets
