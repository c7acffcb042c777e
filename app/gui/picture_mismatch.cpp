#include "app/gui/picture_mismatch.h"

#include <cmath>

#include "app/gui/text_of.h"
#include "projects/document.h"
#include "projects/samples.h"
#include "renderers/core/light_use.h"
#include "renderers/core/transport.h"

namespace ir::gui {
namespace {

using widgets::ViewSource;

bool shine_alike(const projects::LightSet& a, const projects::LightSet& b) {
    return a.use_scene_lights == b.use_scene_lights && a.lights == b.lights && a.environment == b.environment;
}

}  // namespace

QString PictureMismatch::of(const ViewSource& a, const ViewSource& b) const {
    auto different =
        a.is_kept() || b.is_kept() ? kept_.different_inputs(a.owner, b.owner) : settings(a.owner, b.owner);
    if (!different) return {};
    if (const auto time = moments(a.owner, b.owner); !time.isEmpty()) *different << time;
    return different->isEmpty() ? QString()
                                : QObject::tr("A and B do not compute the same: %1")
                                      .arg(different->join(QStringLiteral(", ")));
}

QString PictureMismatch::moments(const std::string& a, const std::string& b) const {
    bool moves = false;
    const auto moment_of = [&](const std::string& owner) {
        const auto* result = kept_.find(owner);
        const auto* experiment = session_.experiment(result ? result->experiment : owner);
        const bool is_moving = experiment && live_.is_moving(experiment->id);
        moves |= is_moving;
        if (result) return kept_.moment(*result);
        if (is_moving && live_.moment()) return live_.moment()->time();
        return experiment ? projects::last_time(*experiment, session_.registry()) : 0;
    };
    constexpr double same_moment = 1e-6;
    const double time_a = moment_of(a), time_b = moment_of(b);
    return moves && std::abs(time_a - time_b) > same_moment
               ? QObject::tr("time %1 s / %2 s").arg(time_a).arg(time_b)
               : QString();
}

std::optional<QStringList> PictureMismatch::settings(const std::string& a, const std::string& b) const {
    const auto* first = session_.experiment(a);
    const auto* second = session_.experiment(b);
    if (!first || !second || first == second) return {};
    const auto* method_a = session_.registry().find(first->method);
    const auto* method_b = session_.registry().find(second->method);
    if (!method_a || !method_b) return {};
    const auto values_a = projects::runnable_settings(*first, *method_a);
    const auto values_b = projects::runnable_settings(*second, *method_b);
    QStringList different = sources(*first, *second, parts_in_both(values_a, values_b));
    const bool tells_sources = !different.isEmpty();
    for (const auto& [key, value] : values_a) {
        if (!is_transport_key(key) || (tells_sources && chooses_sources(key))) continue;
        const auto other = values_b.find(key);
        if (other != values_b.end() && other->second != value)
            different << QStringLiteral("%1 %2 / %3")
                             .arg(text_of(key), text_of(to_string(value)), text_of(to_string(other->second)));
    }
    if (first->scene != second->scene) different << QObject::tr("scene");
    return different;
}

/// Light that only one of two pictures has, as far as they have told, and sets of lights that differ.
QStringList PictureMismatch::sources(const projects::Experiment& a, const projects::Experiment& b,
                                     const std::vector<LightPart>& parts) const {
    if (parts.empty()) return {};  // occlusion is the same under any light
    QStringList different;
    const auto told_a = live_.result(a.id), told_b = live_.result(b.id);
    if (told_a && told_b)
        for (const auto& each :
             light_differences(told_a->report.lights, told_b->report.lights, parts, "A", "B"))
            different << text_of(each);
    const auto& sets = session_.document().lights;
    const auto* set_a = projects::find_item(sets, a.lights);
    const auto* set_b = projects::find_item(sets, b.lights);
    if (set_a == set_b || (set_a && set_b && shine_alike(*set_a, *set_b))) return different;
    const auto name = [](const projects::LightSet* set) {
        return set ? name_text(*set) : QObject::tr("the scene's");
    };
    return different << QObject::tr("lights: %1 / %2").arg(name(set_a), name(set_b));
}

}  // namespace ir::gui
