#include "app/gui/parameter_dock.h"

#include <QLineEdit>
#include <QVBoxLayout>

#include "app/gui/text_of.h"
#include "renderers/core/resources_path.h"
#include "widgets/panels/manual_window.h"

namespace ir::gui {
namespace {

namespace edits = projects::edits;
using projects::Project;

const QString scene_prefix = QStringLiteral("scene:");  ///< of cameras of the scene's file

template <class List>
std::vector<widgets::Option> options_of(const List& list) {
    std::vector<widgets::Option> result;
    for (const auto& item : list) result.push_back({text_of(item.id), name_text(item), text_of(item.id)});
    return result;
}

}  // namespace

ParameterDock::ParameterDock(Session& session, SceneShelf& scenes, Notices& notices)
    : session_(session),
      scenes_(scenes),
      notices_(notices),
      experiment_(new widgets::ExperimentPanel),
      parameters_(new widgets::ParameterPanel(nullptr, explain_key())),
      filter_(new QLineEdit) {
    filter_->setObjectName(QStringLiteral("parameter-filter"));
    filter_->setPlaceholderText(tr("Filter parameters"));
    filter_->setClearButtonEnabled(true);
    connect(filter_, &QLineEdit::textChanged, parameters_, &widgets::ParameterPanel::set_filter);
    auto* content = new QWidget;
    auto* layout = new QVBoxLayout(content);
    layout->setContentsMargins(4, 4, 4, 4);
    layout->setSpacing(4);
    layout->addWidget(experiment_);
    layout->addWidget(filter_);
    layout->addWidget(parameters_);
    layout->addStretch(1);
    setWidget(content);
    setWidgetResizable(true);
    setMinimumWidth(350);
    connect_experiment();
    connect_parameters();
    follow(session_, this, &ParameterDock::update_panels);
    connect(&scenes_, &SceneShelf::changed, this, &ParameterDock::update_panels);
    update_panels();
}

void ParameterDock::connect_experiment() {
    using Panel = widgets::ExperimentPanel;
    using Id = const std::string&;
    connect(experiment_, &Panel::experiment_chosen, this,
            [this](const QString& chosen) { session_.select_experiment(chosen.toStdString()); });
    connect(experiment_, &Panel::method_chosen, this, &ParameterDock::choose_method);
    connect(experiment_, &Panel::camera_chosen, this, &ParameterDock::choose_camera);
    connect(experiment_, &Panel::scene_chosen, this, [this](const QString& scene) {
        edit([&](const Project& p, Id id) { return edits::set_scene_of(p, id, scene.toStdString()); });
    });
    connect(experiment_, &Panel::lights_chosen, this, [this](const QString& lights) {
        edit([&](const Project& p, Id id) { return edits::set_lights_of(p, id, lights.toStdString()); });
    });
    connect(experiment_, &Panel::preset_chosen, this, [this](const QString& preset) {
        edit([&](const Project& p, Id id) { return edits::set_active_preset(p, id, preset.toStdString()); });
    });
    connect(experiment_, &Panel::size_chosen, this, [this](QSize size) {
        edit([&](const Project& p, Id id) { return edits::set_size(p, id, {size.width(), size.height()}); });
    });
    connect(experiment_, &Panel::seed_chosen, this, [this](std::uint64_t seed) {
        edit([&](const Project& p, Id id) { return edits::set_seed(p, id, seed); });
        session_.end_gesture();
    });
    connect(experiment_, &Panel::frames_chosen, this, [this](int frames) {
        edit([&](const Project& p, Id id) { return edits::set_frames(p, id, frames); });
    });
    connect(experiment_, &Panel::time_chosen, this, [this](double time) {
        edit([&](const Project& p, Id id) { return edits::set_time(p, id, time); });
    });
}

void ParameterDock::connect_parameters() {
    using Panel = widgets::ParameterPanel;
    using Id = const std::string&;
    connect(parameters_, &Panel::value_chosen, this, [this](const std::string& key, const Value& value) {
        const bool done = edit([&](const Project& p, Id id) {
            return edits::set_values(p, session_.registry(), id, {{key, value}});
        });
        if (!done) update_panels();  // a refused value leaves the editor again
    });
    connect(parameters_, &Panel::explanation_wanted, this, &ParameterDock::explain_parameter);
    connect(parameters_, &Panel::sweep_wanted, this, &ParameterDock::sweep_wanted);
    connect(parameters_, &Panel::gesture_finished, this, [this] { session_.end_gesture(); });
    connect(parameters_, &Panel::reset_chosen, this, [this](const std::string& key) {
        edit([&](const Project& p, Id id) { return edits::reset_value(p, session_.registry(), id, key); });
        session_.end_gesture();
    });
}

void ParameterDock::explain() {
    const auto key = parameters_->focused_key();
    if (!key.empty()) return explain_parameter(key);
    emit page_wanted(text_of((data_directory() / "README.md").string()), {});
}

/// The method's page, or that of parameters which methods share.
void ParameterDock::explain_parameter(const std::string& key) {
    const auto* method = session_.method();
    if (!method) return;
    const auto docs = data_directory() / "docs";
    const auto page = widgets::page_with({text_of((docs / "methods" / (method->id + ".md")).string()),
                                          text_of((docs / "parameters.md").string())},
                                         text_of(key));
    if (page.isEmpty())
        notices_.say(tr("The manual does not name %1").arg(text_of(key)));
    else
        emit page_wanted(page, text_of(key));
}

void ParameterDock::choose_method(const QString& method) {
    std::vector<std::string> lost;
    const bool is_changed = edit([&](const Project& project, const std::string& id) {
        lost = edits::lost_by_method(project, session_.registry(), id, method.toStdString());
        return edits::set_method(project, session_.registry(), id, method.toStdString());
    });
    if (!is_changed) return;
    for (const auto& line : lost) notices_.add({Severity::note, "project", line});
    if (!lost.empty()) notices_.say(text_of(lost.front()));
}

void ParameterDock::choose_camera(const QString& chosen) {
    if (chosen.startsWith(scene_prefix)) return use_scene_camera(chosen.mid(scene_prefix.size()));
    edit([&](const Project& project, const std::string& id) {
        return edits::set_camera_of(project, id, chosen.toStdString());
    });
}

void ParameterDock::use_scene_camera(const QString& name) {
    if (!session_.experiment()) return;
    const std::string wanted = name.toStdString();
    edit([&](const Project& project, const std::string& id) {
        for (const auto& camera : project.cameras)
            if (camera.scene_camera == wanted) return edits::set_camera_of(project, id, camera.id);
        projects::Camera camera;
        camera.name = wanted;
        camera.scene_camera = wanted;
        camera.id = projects::free_id_in(project.cameras, wanted);
        std::vector<projects::EditPtr> steps;
        steps.push_back(edits::add(project, camera));
        Project after = project;
        steps.back()->apply(after);
        steps.push_back(edits::set_camera_of(after, id, camera.id));
        return edits::group("Use camera " + wanted, std::move(steps));
    });
}

void ParameterDock::show_parameter(const std::string& key) {
    filter_->clear();
    auto* row = parameters_->show_row(key);
    if (!row) return;
    widget()->layout()->activate();  // rows that were hidden have no place yet
    ensureWidgetVisible(row, 0, height() / 3);
}

widgets::ExperimentFields ParameterDock::fields() const {
    const auto& experiment = *session_.experiment();
    const auto shown = projects::effective(experiment);
    const auto& document = session_.document();
    widgets::ExperimentFields fields;
    fields.experiments = options_of(document.experiments);
    fields.scenes = options_of(document.scenes);
    fields.cameras = options_of(document.cameras);
    fields.cameras.insert(fields.cameras.begin(),
                          {"", tr("Scene's first camera"), tr("The first camera of the scene file")});
    if (const auto* scene = scenes_.current())
        for (const auto& name : scene->cameras)
            fields.cameras.push_back({scene_prefix + text_of(name), tr("%1 (in scene)").arg(text_of(name)),
                                      tr("A camera of the scene file")});
    fields.lights = options_of(document.lights);
    fields.lights.insert(fields.lights.begin(), {projects::scene_lights, tr("Scene's own lights"), {}});
    fields.presets = {{"", tr("None"), tr("The experiment's own values")}};
    for (const auto& [name, preset] : experiment.presets)
        fields.presets.push_back({text_of(name), text_of(name), {}});
    for (const auto* method : session_.registry().methods())
        fields.methods.push_back(
            {text_of(method->id), text_of(method->title), text_of(method->id + ": " + method->summary)});
    fields.experiment = text_of(experiment.id);
    fields.method = text_of(shown.method);
    fields.scene = text_of(shown.scene);
    fields.camera = text_of(shown.camera);
    fields.light = text_of(shown.lights);
    fields.preset = text_of(experiment.active_preset);
    fields.size = {shown.size.x, shown.size.y};
    fields.seed = shown.seed;
    fields.frames = shown.frames;
    fields.time = shown.time;
    return fields;
}

void ParameterDock::update_panels() {
    const auto* experiment = session_.experiment();
    experiment_->setEnabled(session_.has_project());
    if (!experiment) {
        experiment_->set_fields({});
        return parameters_->set_parameters("", {});
    }
    experiment_->set_fields(fields());
    const auto* method = session_.method();
    parameters_->set_parameters(method ? method->id : "",
                                method ? method->parameters : std::vector<ParameterDescription>());
    Settings values = method ? defaults(method->parameters) : Settings();
    for (const auto& [key, value] : projects::effective(*experiment).values) values[key] = value;
    parameters_->set_values(values);
    const auto& open = session_.open_project();
    const QString why = read_only_text(open);
    parameters_->set_read_only(open.is_read_only(), why);
    experiment_->set_read_only(open.is_read_only(), why);
}

}  // namespace ir::gui
