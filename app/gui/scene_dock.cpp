#include "app/gui/scene_dock.h"

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

}  // namespace

SceneDock::SceneDock(Session& session, SceneShelf& scenes)
    : RowsPanel(widgets::scene_headings(), tr("No scene is open.")), session_(session), scenes_(scenes) {
    connect(this, &RowsPanel::row_activated, this, [this](const QString& key) {
        if (key.startsWith(QStringLiteral("camera:"))) emit camera_chosen(key.mid(7));
    });
    connect(&scenes_, &SceneShelf::changed, this, &SceneDock::update_rows);
    follow(session_, this, &SceneDock::update_rows);
}

void SceneDock::update_rows() {
    const auto* scene = scenes_.current();
    if (!scene) return set_rows({});
    auto listing = listing_of(*scene);
    if (const auto* experiment = session_.experiment()) {
        const auto* camera = projects::find_item(session_.document().cameras, experiment->camera);
        if (camera)
            listing.used_camera = camera->scene_camera;
        else if (!scene->cameras.empty())
            listing.used_camera = scene->cameras.front();
    }
    set_rows(widgets::scene_rows(listing));
}

}  // namespace ir::gui
