#include "app/gui/light_offer.h"

#include <algorithm>

#include "app/gui/text_of.h"
#include "renderers/core/light_use.h"

namespace ir::gui {
namespace {

using Kinds = std::set<LightKind>;

bool is_lamp(const projects::LightSpec& light) {
    using Type = projects::LightSpec::Type;
    return light.type == Type::rect || light.type == Type::disk;
}

/// What a set has in place of the scene's environment.
bool shines(const projects::Environment& environment) {
    return environment.kind == projects::Environment::Kind::map || environment.constant != glm::dvec3(0);
}

void add_lights(Kinds& kinds, const std::vector<projects::LightSpec>& lights) {
    for (const auto& light : lights)
        if (light.amount > 0 && light.color != glm::dvec3(0))
            kinds.insert(is_lamp(light) ? LightKind::lamp : LightKind::punctual);
}

std::string listed(const Kinds& kinds) {
    std::string list;
    for (const auto kind : kinds) list += (list.empty() ? "" : ", ") + text_of(kind);
    return list;
}

}  // namespace

Kinds kinds_of_light(const std::vector<LightSource>& scene, const projects::LightSet* set) {
    Kinds kinds;
    for (const auto& [kind, name] : scene) kinds.insert(kind);
    if (!set) return kinds;
    if (!set->use_scene_lights) kinds.erase(LightKind::punctual), kinds.erase(LightKind::lamp);
    add_lights(kinds, set->lights);
    if (set->environment.kind == projects::Environment::Kind::scene) return kinds;
    kinds.erase(LightKind::environment);
    if (shines(set->environment)) kinds.insert(LightKind::environment);
    return kinds;
}

QString why_dark(const MethodDescription& method, const Settings& settings, const Kinds& kinds) {
    const auto* main = main_output(method, settings);
    if (!main || (main->semantic != Semantic::radiance && main->semantic != Semantic::irradiance)) return {};
    if (kinds.empty()) return QObject::tr("The scene has no light: its pictures stay black.");
    if (!find(method.parameters, "paths")) return {};
    const auto use = light_use(method, settings);
    const bool is_lit = std::ranges::any_of(kinds, [&](LightKind kind) {
        return use.has(LightPart::direct, kind) || use.has(LightPart::indirect, kind);
    });
    if (is_lit) return {};
    return QObject::tr("Nothing lights the picture: with these settings it has no light of %1.")
        .arg(text_of(listed(kinds)));
}

LightOffer::LightOffer(Session& session, SceneShelf& scenes, LightController& lights,
                       widgets::BannerStack& banners)
    : session_(session), scenes_(scenes), lights_(lights), banners_(banners) {
    follow(session_, this, &LightOffer::update);
    connect(&scenes_, &SceneShelf::changed, this, &LightOffer::update);
}

QString LightOffer::text() const {
    const auto* chosen = session_.experiment();
    const auto* method = session_.method();
    const auto* scene = scenes_.current();
    if (!chosen || !method || !scene || scene->triangles == 0) return {};
    const auto& sets = session_.document().lights;
    return why_dark(*method, projects::runnable_settings(*chosen, *method),
                    kinds_of_light(scene->sources, projects::find_item(sets, chosen->lights)));
}

void LightOffer::update() {
    const auto text = this->text();
    if (text.isEmpty() || session_.open_project().is_read_only())
        return banners_.hide_banner(QStringLiteral("light"));
    banners_.show_banner(QStringLiteral("light"), widgets::BannerStack::Kind::note, text,
                         {{tr("Add a light"), [this] { lights_.add_for_view(); }}});
}

}  // namespace ir::gui
