#include "app/gui/light_controller.h"

#include <QAction>
#include <algorithm>
#include <utility>

#include "app/gui/light_places.h"
#include "app/gui/text_of.h"
#include "widgets/document/makers.h"

namespace ir::gui {

LightController::LightController(Session& session, LivePictures& live, Renderer& renderer, SceneShelf& scenes,
                                 Workspace& workspace, PixelInspector& inspector, Actions& actions)
    : session_(session),
      live_(live),
      renderer_(renderer),
      scenes_(scenes),
      workspace_(workspace),
      inspector_(inspector) {
    using K = QKeySequence;
    const auto add = [&](const char* name, const QString& text, const QKeySequence& key, const QString& help,
                         Place place) {
        auto* action =
            all_.emplace_back(actions.add(name, text, "light", {key}, [this, place] { this->place(place); }));
        action->setData(QStringLiteral("%1 (%2)").arg(help, key.toString(K::NativeText)));
    };
    add("light-here", tr("&Light here"), K(Qt::SHIFT | Qt::Key_L),
        tr("A point light just before the surface under the cursor"), Place::surface);
    add("light-camera", tr("Light from &the camera"), K(Qt::CTRL | Qt::Key_L),
        tr("A spot where the camera stands, aimed at what the cursor points at"), Place::camera);
    add("headlight", tr("Headli&ght"), K(Qt::CTRL | Qt::ALT | Qt::Key_L),
        tr("A point light where the camera stands"), Place::headlight);
    follow(session_, this, &LightController::update_actions);
    update_actions();
    connect(&renderer_, &Renderer::surface_arrived, this, &LightController::on_surface);
}

void LightController::update_actions() {
    const auto why_not = !session_.experiment() ? tr("There is no experiment to light.")
                         : session_.open_project().is_read_only()
                             ? text_of(session_.open_project().read_only_reason())
                             : QString();
    for (auto* action : all_) set_reason(*action, why_not);
}

/// What the place needs to know of the scene only the renderer can say.
void LightController::place(Place place) {
    const auto* chosen = session_.experiment();
    const auto pose = session_.camera().pose();
    auto& views = workspace_.views();
    if (!chosen || !pose || views.active_state().a.owner != chosen->id)
        return emit said(tr("A light belongs to an experiment: choose a view that shows one."));
    if (live_.past().is_elsewhere()) return emit said(live_.past().why_not_now());
    const auto pixel = inspector_.pointed();
    if (place == Place::surface && pixel.x() < 0)
        return emit said(tr("Point at a surface in a picture, or click it: the light stands before it."));
    QSize size = views.rules().main_size(chosen->id);
    if (size.isEmpty()) {
        const auto requested = projects::effective(*chosen).size;
        size = {requested.x, requested.y};
    }
    const double aspect = double(size.width()) / size.height();
    const auto at = pixel.x() < 0
                        ? glm::dvec2(0.5)
                        : glm::dvec2((pixel.x() + 0.5) / size.width(), (pixel.y() + 0.5) / size.height());
    const auto sight = widgets::sight_through(*pose, aspect, at);
    request_ = Request{place, chosen->id, *pose, aspect};
    renderer_.find_surface({chosen->id, sight.origin, sight.direction});
}

void LightController::on_surface(const engine::SurfaceResult& result) {
    if (!request_ || result.tag != request_->experiment || !result.asker.empty()) return;
    const auto requested = *std::exchange(request_, std::nullopt);
    const auto& camera = requested.camera;
    if (requested.place == Place::surface) {
        if (!result.error.empty()) return emit said(tr("No light yet: %1.").arg(text_of(result.error)));
        if (!result.point)
            return emit said(tr("There is no surface under the cursor that a light could stand before."));
        const auto* scene = scenes_.current();
        return add(requested.experiment,
                   light_before(*result.point, camera, scene ? scene->bounds : scene::Bounds(), exposure()));
    }
    const auto aim = result.point ? result.point->position : camera.target;
    add(requested.experiment, requested.place == Place::headlight
                                  ? headlight(camera, aim, exposure())
                                  : light_from_camera(camera, requested.aspect, aim, exposure()));
}

void LightController::add(const std::string& experiment, const projects::LightSpec& light) {
    session_.camera().finish_move();
    if (!session_.edit(widgets::makers::light_experiment(experiment, light))) return;
    const auto* changed = session_.experiment(experiment);
    const auto* set = projects::find_item(session_.document().lights, changed->lights);
    emit added({widgets::ItemKind::light, text_of(set->id), int(set->lights.size()) - 1});
}

void LightController::add_for_view() {
    const auto pose = session_.camera().pose();
    const auto* scene = scenes_.current();
    const auto* chosen = session_.experiment();
    if (pose && scene && chosen) add(chosen->id, light_for_view(*pose, scene->bounds));
}

/// At which the active view shows light; 0 where it shows something else.
double LightController::exposure() const {
    constexpr double max_stops = 20;  // pictures may be black
    const auto shown = workspace_.display_picture();
    const bool is_light =
        shown && (shown->semantic == Semantic::radiance || shown->semantic == Semantic::irradiance);
    return is_light ? std::clamp(workspace_.display().exposure, -max_stops, max_stops) : 0;
}

}  // namespace ir::gui
