#include <QAction>
#include <QDesktopServices>
#include <QDockWidget>
#include <QFileInfo>
#include <QUrl>
#include <algorithm>
#include <cstring>

#include "app/gui/main_window.h"
#include "app/gui/text_of.h"
#include "widgets/models/report_rows.h"

namespace ir::gui {
namespace {

widgets::SceneListing listing_of(const engine::SceneSummary& scene) {
    widgets::SceneListing listing;
    listing.name = scene.name;
    listing.cameras = scene.cameras;
    listing.lights = scene.lights;
    listing.materials = scene.materials;
    listing.warnings = scene.warnings;
    listing.triangles = scene.triangles;
    listing.textures = scene.textures;
    for (const auto& node : scene.nodes) listing.nodes.push_back({node.name, node.parent, node.triangles});
    const auto extent = scene.bounds.max - scene.bounds.min;
    listing.extent = QStringLiteral("%1 × %2 × %3 m")
                         .arg(extent.x, 0, 'g', 3)
                         .arg(extent.y, 0, 'g', 3)
                         .arg(extent.z, 0, 'g', 3)
                         .toStdString();
    return listing;
}

/// The value of an integer field of one element; nothing where there is no such field.
std::optional<int> integer_of(const engine::BufferContents& buffer, const std::string& name, qint64 element) {
    std::size_t offset = 0, stride = 0;
    const Field* found = nullptr;
    for (const auto& field : buffer.fields) {
        if (field.name == name && field.type != FieldType::f32) found = &field, offset = stride;
        stride += 4 * std::size_t(field.count);
    }
    const auto at = std::size_t(element) * stride + offset;
    if (!found || element < 0 || at + 4 > buffer.bytes.size()) return {};
    std::int32_t value;
    std::memcpy(&value, buffer.bytes.data() + at, 4);
    return value;
}

}  // namespace

void MainWindow::connect_views() {
    connect(&workspace_, &Workspace::active_changed, this, [this] {
        update_display_panel();
        update_lists();
        update_camera();
    });
    connect(&workspace_, &Workspace::picture_shown, this, &MainWindow::update_display_panel);
    connect(&live_, &LivePictures::picture_arrived, this, [this](const std::string& id) {
        if (session_.experiment() && session_.experiment()->id == id) update_lists();
    });
    connect(&workspace_, &Workspace::export_values_wanted, action("export-values"), &QAction::trigger);
    connect(&workspace_, &Workspace::element_clicked, this, &MainWindow::choose_item_of_element);
    connect(display_, &widgets::DisplayPanel::display_chosen, this,
            [this](const widgets::Display& display) { workspace_.choose_display(display); });
    connect(display_, &widgets::DisplayPanel::automatic_chosen, this,
            [this] { workspace_.choose_automatic(); });
    connect(buffers_, &widgets::RowsPanel::row_clicked, this, [this](const QString& key) {
        if (!key.startsWith(QStringLiteral("pass:"))) workspace_.show_output(key.toStdString());
    });
    connect(messages_, &widgets::MessagesPanel::go_to, this, &MainWindow::go_to);
    connect(welcome_, &widgets::WelcomePage::new_chosen, this, [this] { new_project(); });
    connect(welcome_, &widgets::WelcomePage::scene_chosen, this, [this] { new_project(); });
    connect(welcome_, &widgets::WelcomePage::recent_removed, this, [this](const QString& path) {
        recent_.remove(path);
        update_recent();
    });
    connect(welcome_, &widgets::WelcomePage::open_chosen, this, [this] { choose_project(); });
    connect(welcome_, &widgets::WelcomePage::project_chosen, this,
            [this](const QString& path) { open_path(path); });
}

void MainWindow::update_display_panel() {
    if (!session_.has_project() || !workspace_.pane(workspace_.area().active())) return;
    const bool picture = workspace_.active_pane().content() == widgets::ViewPane::Content::picture;
    const auto shown = picture ? workspace_.display_picture() : nullptr;
    display_->set_picture(shown);
    if (shown && shown->has_image()) display_->set_display(workspace_.display(), workspace_.is_automatic());
}

void MainWindow::step_exposure(double stops) {
    auto display = workspace_.display();
    display.exposure = std::clamp(display.exposure + stops, -40.0, 40.0);
    workspace_.choose_display(display);
}

void MainWindow::update_lists() {
    const auto* chosen = session_.experiment();
    const auto result = chosen ? live_.result(chosen->id) : nullptr;
    if (!result) {
        for (auto* panel : {buffers_, timings_, counters_}) panel->set_rows({});
        return;
    }
    for (const auto& [key, image] : result->thumbnails) {
        const auto* resource = find_resource(result->report, key);
        const auto display = widgets::display_for(resource ? resource->semantic : Semantic::generic,
                                                  resource ? resource->colour_map : "", image);
        thumbnails_[key] = widgets::to_qimage(image, display);
    }
    buffers_->set_rows(widgets::buffer_rows(result->report, thumbnails_, workspace_.shown_key()));
    timings_->set_rows(widgets::timing_rows(result->report));
    counters_->set_rows(widgets::counter_rows(result->report));
}

void MainWindow::update_scene_tree() {
    const auto* scene = scenes_.current();
    if (!scene) return scene_tree_->set_rows({});
    auto listing = listing_of(*scene);
    if (const auto* experiment = session_.experiment()) {
        const auto* camera = projects::find_item(session_.document().cameras, experiment->camera);
        if (camera)
            listing.used_camera = camera->scene_camera;
        else if (!scene->cameras.empty())
            listing.used_camera = scene->cameras.front();
    }
    scene_tree_->set_rows(widgets::scene_rows(listing));
}

void MainWindow::update_camera() {
    const auto pose = session_.camera_pose();
    const auto* scene = scenes_.current();
    for (const int number : workspace_.area().open_views()) {
        auto* pane = workspace_.pane(number);
        if (!pane) continue;
        const bool worked_on =
            session_.experiment() && workspace_.state(number).a.owner == session_.experiment()->id;
        if (pose && worked_on) pane->compare().set_camera(*pose);
        if (!scene) continue;
        // Crossing the scene takes about six seconds.
        pane->compare().set_fly_speed(std::max(0.05, double(scene->bounds.radius()) / 3));
        if (pane->content() == widgets::ViewPane::Content::space)
            pane->space().view().set_bounds({glm::dvec3(scene->bounds.min), glm::dvec3(scene->bounds.max)});
    }
}

/// A click on a direction of the sphere, on a photon, chooses the item that it stands for.
void MainWindow::choose_item_of_element(const std::string& owner, const std::string& buffer, qint64 element) {
    const auto result = live_.result(owner);
    if (!result) return;
    const auto found = result->buffers.find(buffer);
    if (found == result->buffers.end()) return;
    auto now = workspace_.inspection(owner);
    for (const auto& selector : workspace_.selectors(owner))
        if (const auto item = integer_of(found->second, selector.key, element))
            now.chosen[selector.key] = *item;
    workspace_.set_inspection(owner, now);
}

/// From a message to where it can be mended: a file's line, an item of the project, a buffer.
void MainWindow::go_to(const Message& message) {
    const QString place = text_of(message.place);
    const QString file = place.section(QLatin1Char(':'), 0, 0);
    if (QFileInfo::exists(file)) {
        QDesktopServices::openUrl(QUrl::fromLocalFile(QFileInfo(file).absoluteFilePath()));
        return;
    }
    const auto raise = [this](const char* name) {
        auto* dock = findChild<QDockWidget*>(QLatin1String(name));
        dock->show();
        dock->raise();
    };
    if (const auto item = widgets::ItemRef::from_key(place); item.is_valid()) {
        raise("project");
        if (item.kind == widgets::ItemKind::experiment) session_.select_experiment(item.id.toStdString());
        return document_->select(item);
    }
    const auto* chosen = session_.experiment();
    const auto result = chosen ? live_.result(chosen->id) : nullptr;
    if (result && find_resource(result->report, message.place)) return workspace_.show_output(message.place);
    raise("timings");
}

}  // namespace ir::gui
