#include <QLabel>
#include <QStackedWidget>

#include "app/gui/main_window.h"
#include "app/gui/text_of.h"

namespace ir::gui {
namespace {

namespace edits = projects::edits;
using projects::Project;

template <class List>
std::vector<widgets::Option> options_of(const List& list) {
    std::vector<widgets::Option> result;
    for (const auto& item : list)
        result.push_back(
            {text_of(item.id), text_of(item.name.empty() ? item.id : item.name), text_of(item.id)});
    return result;
}

}  // namespace

void MainWindow::connect_session() {
    connect(&session_, &Session::project_replaced, this, [this] {
        thumbnails_.clear();
        for (auto* panel : {buffers_, timings_, counters_}) panel->set_rows({});
        if (!session_.has_project()) scenes_.clear();
        update_document();  // before the views, which want to be seen and have the focus
        workspace_.load(session_.memory());
        inspector_.load(session_.memory());
        metrics_.load(session_.memory());
        plots_->load(session_.memory());
        benchmarks_->load(session_.memory());
        playback_.load(session_.memory());
        update_project_banners();
    });
    connect(&session_, &Session::document_changed, this, &MainWindow::update_document);
    connect(&session_, &Session::document_changed, this, &MainWindow::update_scene_banner);
    connect(&session_, &Session::memory_wanted, this, &MainWindow::store_memory);
    connect(&session_, &Session::files_changed, this, &MainWindow::update_scene_banner);
    connect(&session_, &Session::experiment_selected, this, [this] {
        thumbnails_.clear();
        update_document();
        update_lists();
        update_state_banner();
    });
    connect(&live_, &LivePictures::composition_resolved, this, [this](const std::vector<scene::Part>& parts) {
        scenes_.set_place("scene:" + session_.experiment()->scene);
        scenes_.choose(parts);
    });
    connect(&live_, &LivePictures::state_changed, this, [this] {
        update_actions();
        update_state_banner();
    });
    connect(&scenes_, &SceneShelf::changed, this, [this] {
        session_.set_scene_cameras(scenes_.current() ? scenes_.current()->camera_values
                                                     : std::vector<scene::Camera>());
        update_scene_tree();
        update_camera();
        update_experiment_panel();
    });
    connect(&session_, &Session::message, messages_, &widgets::MessagesPanel::add);
    connect(&live_, &LivePictures::message, messages_, &widgets::MessagesPanel::add);
    connect(&scenes_, &SceneShelf::message, messages_, &widgets::MessagesPanel::add);
    connect(&renderer_, &Renderer::messages_arrived, this, [this](const std::vector<Message>& messages) {
        for (const auto& each : messages) messages_->add(each);
    });
    connect(&renderer_, &Renderer::exported, this,
            [this](const std::string&, const std::string& file, const std::string& error) {
                if (error.empty()) return status_->say(tr("Wrote %1").arg(text_of(file)));
                messages_->add({Severity::error, "export", error});
                banners_->show_banner(QStringLiteral("file"), widgets::BannerStack::Kind::error,
                                      text_of(error));
            });
    connect(&renderer_, &Renderer::ready, this,
            [this](const std::string& backend, const std::string& device) {
                device_label_->setText(
                    QStringLiteral("%1 · %2").arg(text_of(backend).toUpper(), text_of(device)));
                banners_->hide_banner(QStringLiteral("device"));
            });
    connect(&renderer_, &Renderer::no_device, this, [this](const std::string& error) {
        device_label_->setText(tr("no device"));
        messages_->add({Severity::error, "gl", error});
        banners_->show_banner(QStringLiteral("device"), widgets::BannerStack::Kind::error, text_of(error));
    });
}

void MainWindow::connect_panels() {
    using widgets::ExperimentPanel;
    auto* panel = experiment_panel_;
    const auto id = [this] { return session_.experiment() ? session_.experiment()->id : std::string(); };
    connect(panel, &ExperimentPanel::experiment_chosen, this,
            [this](const QString& chosen) { session_.select_experiment(chosen.toStdString()); });
    connect(panel, &ExperimentPanel::method_chosen, this, [this, id](const QString& method) {
        std::vector<std::string> lost;
        const bool is_changed = session_.edit([&](const Project& p) {
            lost = edits::lost_by_method(p, session_.registry(), id(), method.toStdString());
            return edits::set_method(p, session_.registry(), id(), method.toStdString());
        });
        if (!is_changed) return;
        for (const auto& line : lost) messages_->add({Severity::note, "project", line});
        if (!lost.empty()) status_->say(text_of(lost.front()));
    });
    connect(panel, &ExperimentPanel::scene_chosen, this, [this, id](const QString& scene) {
        session_.edit([&](const Project& p) { return edits::set_scene_of(p, id(), scene.toStdString()); });
    });
    connect(panel, &ExperimentPanel::camera_chosen, this, &MainWindow::choose_camera);
    connect(panel, &ExperimentPanel::lights_chosen, this, [this, id](const QString& lights) {
        session_.edit([&](const Project& p) { return edits::set_lights_of(p, id(), lights.toStdString()); });
    });
    connect(panel, &ExperimentPanel::preset_chosen, this, [this, id](const QString& preset) {
        session_.edit(
            [&](const Project& p) { return edits::set_active_preset(p, id(), preset.toStdString()); });
    });
    connect(panel, &ExperimentPanel::size_chosen, this, [this, id](QSize size) {
        session_.edit([&](const Project& p) {
            return edits::set_size(p, id(), {size.width(), size.height()});
        });
    });
    connect(panel, &ExperimentPanel::seed_chosen, this, [this, id](std::uint64_t seed) {
        session_.edit([&](const Project& p) { return edits::set_seed(p, id(), seed); });
        session_.end_gesture();
    });
    connect(panel, &ExperimentPanel::frames_chosen, this, [this, id](int frames) {
        session_.edit([&](const Project& p) { return edits::set_frames(p, id(), frames); });
    });
    connect(panel, &ExperimentPanel::time_chosen, this, [this, id](double time) {
        session_.edit([&](const Project& p) { return edits::set_time(p, id(), time); });
    });
    connect(parameter_panel_, &widgets::ParameterPanel::value_chosen, this,
            [this, id](const std::string& key, const Value& value) {
                const bool done = session_.edit([&](const Project& p) {
                    return edits::set_values(p, session_.registry(), id(), {{key, value}});
                });
                if (!done) update_experiment_panel();  // a refused value leaves the editor again
            });
    connect(parameter_panel_, &widgets::ParameterPanel::gesture_finished, this,
            [this] { session_.end_gesture(); });
    connect(parameter_panel_, &widgets::ParameterPanel::reset_chosen, this,
            [this, id](const std::string& key) {
                session_.edit(
                    [&](const Project& p) { return edits::reset_value(p, session_.registry(), id(), key); });
                session_.end_gesture();
            });
    connect(scene_tree_, &widgets::RowsPanel::row_activated, this, [this](const QString& key) {
        if (key.startsWith(QStringLiteral("camera:"))) use_scene_camera(key.mid(7));
    });
}

void MainWindow::update_document() {
    const bool has_project = session_.has_project();
    pages_->setCurrentIndex(has_project ? 1 : 0);
    show_docks(has_project);
    update_title();
    update_actions();
    update_experiment_panel();
    update_camera();
    update_scene_tree();
}

void MainWindow::update_title() {
    if (!session_.has_project()) {
        setWindowModified(false);
        return setWindowTitle(tr("Interreflect"));
    }
    const auto& project = session_.open_project();
    const QString name = text_of(session_.document().name.empty() ? "untitled" : session_.document().name);
    const QString place =
        project.folder().empty() ? tr("not saved yet") : text_of(project.folder().filename().string());
    setWindowTitle(tr("%1[*] (%2)%3 – Interreflect")
                       .arg(name, place, project.is_read_only() ? tr(", read-only") : QString()));
    setWindowModified(project.is_dirty());
}

void MainWindow::update_experiment_panel() {
    const auto* experiment = session_.experiment();
    experiment_panel_->setEnabled(session_.has_project());
    if (!experiment) {
        experiment_panel_->set_fields({});
        parameter_panel_->set_parameters("", {});
        return;
    }
    const auto shown = projects::effective(*experiment);
    const auto& document = session_.document();
    widgets::ExperimentFields fields;
    fields.experiments = options_of(document.experiments);
    fields.scenes = options_of(document.scenes);
    fields.cameras = options_of(document.cameras);
    fields.cameras.insert(fields.cameras.begin(),
                          {"", tr("Scene's first camera"), tr("The first camera of the scene file")});
    if (const auto* scene = scenes_.current())
        for (const auto& name : scene->cameras)
            fields.cameras.push_back({"scene:" + text_of(name), tr("%1 (in scene)").arg(text_of(name)),
                                      tr("A camera of the scene file")});
    fields.lights = options_of(document.lights);
    fields.lights.insert(fields.lights.begin(), {projects::scene_lights, tr("Scene's own lights"), {}});
    fields.presets = {{"", tr("None"), tr("The experiment's own values")}};
    for (const auto& [name, preset] : experiment->presets)
        fields.presets.push_back({text_of(name), text_of(name), {}});
    for (const auto* method : session_.registry().methods())
        fields.methods.push_back(
            {text_of(method->id), text_of(method->title), text_of(method->id + ": " + method->summary)});
    fields.experiment = text_of(experiment->id);
    fields.method = text_of(shown.method);
    fields.scene = text_of(shown.scene);
    fields.camera = text_of(shown.camera);
    fields.light = text_of(shown.lights);
    fields.preset = text_of(experiment->active_preset);
    fields.size = {shown.size.x, shown.size.y};
    fields.seed = shown.seed;
    fields.frames = shown.frames;
    fields.time = shown.time;
    experiment_panel_->set_fields(fields);
    const auto* method = session_.method();
    parameter_panel_->set_parameters(method ? method->id : "",
                                     method ? method->parameters : std::vector<ParameterDescription>());
    Settings values = method ? defaults(method->parameters) : Settings();
    for (const auto& [key, value] : shown.values) values[key] = value;
    parameter_panel_->set_values(values);
    const bool read_only = session_.open_project().is_read_only();
    const QString why =
        tr("The project is open read-only: %1").arg(text_of(session_.open_project().read_only_reason()));
    parameter_panel_->set_read_only(read_only, why);
    experiment_panel_->set_read_only(read_only, why);
}

void MainWindow::choose_camera(const QString& chosen) {
    if (chosen.startsWith(QStringLiteral("scene:"))) return use_scene_camera(chosen.mid(6));
    const std::string id = session_.experiment()->id;
    session_.edit([&](const Project& p) { return edits::set_camera_of(p, id, chosen.toStdString()); });
}

void MainWindow::use_scene_camera(const QString& name) {
    const auto* experiment = session_.experiment();
    if (!experiment) return;
    const std::string id = experiment->id, wanted = name.toStdString();
    for (const auto& camera : session_.document().cameras)
        if (camera.scene_camera == wanted) {
            session_.edit([&](const Project& p) { return edits::set_camera_of(p, id, camera.id); });
            return;
        }
    session_.edit([&](const Project& p) {
        projects::Camera camera;
        camera.name = wanted;
        camera.scene_camera = wanted;
        camera.id = projects::free_id_in(p.cameras, wanted);
        std::vector<projects::EditPtr> steps;
        steps.push_back(edits::add(p, camera));
        Project after = p;
        steps.back()->apply(after);
        steps.push_back(edits::set_camera_of(after, id, camera.id));
        return edits::group("Use camera " + wanted, std::move(steps));
    });
}

}  // namespace ir::gui
