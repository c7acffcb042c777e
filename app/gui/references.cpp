#include "app/gui/references.h"

#include <algorithm>

#include "app/gui/text_of.h"

namespace ir::gui {
namespace {

constexpr const char* banner_name = "reference";

}  // namespace

References::References(Session& session, LivePictures& live, ViewModel& views, widgets::BannerStack& banners)
    : session_(session), live_(live), views_(views), banners_(banners) {
    connect(&session_, &Session::document_changed, this, &References::update_banner);
    connect(&session_.files(), &ProjectFiles::files_changed, this, &References::update_banner);
    connect(&session_, &Session::project_replaced, this, &References::update_banner);
    connect(&session_, &Session::experiment_selected, this, &References::update_banner);
    connect(&live_, &LivePictures::state_changed, this, &References::update_banner);
}

std::string References::shown() const {
    const auto* chosen = session_.experiment(views_.active_state().a.owner);
    if (!chosen) chosen = session_.experiment();
    return chosen ? chosen->id : std::string();
}

QString References::why_not(const std::string& experiment) const {
    const auto* chosen = session_.experiment(experiment);
    if (!chosen) return tr("No experiment is shown.");
    const auto& open = session_.open_project();
    if (open.is_read_only()) return read_only_text(open);
    if (!session_.registry().reference()) return tr("This build has no reference method.");
    const auto* method = session_.registry().find(chosen->method);
    if (!method) return tr("The experiment's method is unknown to this build.");
    if (method->is_reference) return tr("The experiment is a reference itself.");
    return {};
}

projects::SceneFacts References::scene_facts() const {
    projects::SceneFacts facts;
    facts.is_animated = [this](const std::string& scene) { return live_.scene_end(scene) > 0; };
    facts.light_sources = [this](const projects::Experiment& experiment) {
        std::vector<LightSource> sources;
        if (const auto result = live_.result(experiment.id))
            for (const auto& light : result->report.lights) sources.push_back(light.source);
        return sources;
    };
    return facts;
}

void References::match(const std::string& experiment) {
    bool is_refused = false;
    session_.edit([&](const projects::Project& project) {
        is_refused = true;  // until match() returns
        auto edit = projects::match(project, experiment, session_.registry(), scene_facts().is_animated);
        is_refused = false;
        return edit;
    });
    session_.end_gesture();
    const auto* judged = session_.experiment(experiment);
    if (is_refused || !judged || !session_.experiment(judged->reference)) return;
    const std::string reference = judged->reference;
    views_.show_owner(experiment);
    views_.compare_with(reference);
}

/// Of the experiment that is worked on, else of the first one.
void References::update_banner() {
    const auto mismatched =
        session_.has_project()
            ? projects::mismatched_references(session_.document(), session_.registry(), scene_facts())
            : std::vector<std::pair<std::string, std::string>>();
    if (mismatched.empty()) {
        shown_text_.clear();
        return banners_.hide_banner(QLatin1String(banner_name));
    }
    const auto* chosen = session_.experiment();
    auto found = std::find_if(mismatched.begin(), mismatched.end(),
                              [&](const auto& each) { return chosen && each.first == chosen->id; });
    if (found == mismatched.end()) found = mismatched.begin();
    const auto& [id, reason] = *found;
    const auto* experiment = session_.experiment(id);
    const auto name = experiment && !experiment->name.empty() ? experiment->name : id;
    const QString text = tr("%1 %2: it no longer tells what is right.").arg(text_of(name), text_of(reason));
    if (text == shown_text_) return;  // a banner that was closed stays closed
    shown_text_ = text;
    std::vector<widgets::BannerStack::Action> actions;
    if (!session_.open_project().is_read_only())
        actions.push_back({tr("Match again"), [this, id = id] { match(id); }});
    banners_.show_banner(QLatin1String(banner_name), widgets::BannerStack::Kind::warning, text, actions);
}

}  // namespace ir::gui
