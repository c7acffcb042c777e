#include "app/gui/light_offer.h"

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

}  // namespace

LightOffer::LightOffer(Session& session, SceneShelf& scenes, LightController& lights,
                       widgets::BannerStack& banners)
    : session_(session), scenes_(scenes), lights_(lights), banners_(banners) {
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
                         {{tr("Add a light"), [this] { lights_.add_for_view(); }}});
}

}  // namespace ir::gui
