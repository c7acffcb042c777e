#include "app/gui/light_offer.h"

#include <numbers>

namespace ir::gui {
namespace {

using projects::Environment;

/// Whether a set gives no light of its own; one that takes the scene's gives what that has.
bool is_dark_set(const projects::Project& project, const std::string& id) {
    const auto* set = projects::find_item(project.lights, id);
    if (!set) return true;  // the scene's own
    const auto& environment = set->environment;
    const bool lit_by_environment =
        environment.kind == Environment::Kind::map ||
        (environment.kind == Environment::Kind::constant && environment.constant != glm::dvec3(0));
    return set->lights.empty() && !lit_by_environment;
}

/// Seen from a camera: in a room in front of it, where the way is free; of things from before them, on the
/// left and above. As bright as makes what the camera looks at about white.
projects::LightSpec light_for(const widgets::CameraPose& camera, const scene::Bounds& bounds) {
    const auto forward = camera.target - camera.eye;
    const double distance = glm::length(forward);
    const auto up = glm::normalize(camera.up);
    const auto right = glm::normalize(glm::cross(forward, up));
    const glm::vec3 eye(camera.eye);
    const bool is_inside =
        glm::all(glm::greaterThan(eye, bounds.min)) && glm::all(glm::lessThan(eye, bounds.max));
    projects::LightSpec light;
    light.type = projects::LightSpec::Type::point;
    light.position = is_inside ? camera.eye + 0.35 * forward + 0.1 * distance * up
                               : camera.eye + 0.4 * distance * up - 0.5 * distance * right;
    light.amount = std::numbers::pi * distance * distance;
    return light;
}

}  // namespace

LightOffer::LightOffer(Session& session, SceneShelf& scenes, widgets::BannerStack& banners)
    : session_(session), scenes_(scenes), banners_(banners) {
    follow(session_, this, &LightOffer::update);
    connect(&scenes_, &SceneShelf::changed, this, &LightOffer::update);
}

bool LightOffer::is_dark() const {
    const auto* chosen = session_.experiment();
    const auto* method = session_.method();
    const auto* scene = scenes_.current();
    if (!chosen || !method || !scene || scene->is_lit || scene->triangles == 0) return false;
    const auto* main = main_output(*method, projects::effective(*chosen).values);
    const bool shows_light =
        main && (main->semantic == Semantic::radiance || main->semantic == Semantic::irradiance);
    return shows_light && is_dark_set(session_.document(), chosen->lights);
}

void LightOffer::update() {
    if (!is_dark() || session_.open_project().is_read_only())
        return banners_.hide_banner(QStringLiteral("light"));
    banners_.show_banner(QStringLiteral("light"), widgets::BannerStack::Kind::note,
                         tr("The scene has no light: its pictures stay black."),
                         {{tr("Add a light"), [this] { add_light(); }}});
}

void LightOffer::add_light() {
    const auto pose = session_.camera().pose();
    const auto* scene = scenes_.current();
    const auto* chosen = session_.experiment();
    if (!pose || !scene || !chosen) return;
    session_.edit([&](const projects::Project& project) {
        projects::Project after = project;
        std::vector<projects::EditPtr> steps;
        const auto add = [&](projects::EditPtr step) {
            step->apply(after);
            steps.push_back(std::move(step));
        };
        projects::LightSet set;
        set.name = "Light";
        set.id = projects::free_id_in(project.lights, set.name);
        set.lights = {light_for(*pose, scene->bounds)};
        add(projects::edits::add(after, set));
        for (const auto& each : project.experiments)
            if (each.scene == chosen->scene && is_dark_set(project, each.lights))
                add(projects::edits::set_lights_of(after, each.id, set.id));
        return projects::edits::group("Add a light", std::move(steps));
    });
}

}  // namespace ir::gui
