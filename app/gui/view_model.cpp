#include "app/gui/view_model.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "app/gui/json_fields.h"
#include "app/gui/view_memory.h"

namespace ir::gui {

using widgets::Display;
using widgets::ViewArea;
using widgets::ViewMode;
using widgets::ViewPane;
using widgets::ViewSource;
using widgets::ViewState;

ViewModel::ViewModel(Session& session, LivePictures& live, ImageLoader& images, KeptResults& kept,
                     const ViewArea& area)
    : session_(session),
      live_(live),
      area_(area),
      pictures_(session, live, images, kept),
      rules_(session, live, pictures_) {
    connect(&area_, &ViewArea::active_changed, this, &ViewModel::on_active_changed);
    connect(&area_, &ViewArea::views_changed, this, &ViewModel::refresh);
    connect(&live_, &LivePictures::picture_arrived, this, &ViewModel::on_picture);
    connect(&live_, &LivePictures::state_changed, this, [this](const std::string& id) {
        for (const int view : area_.open_views())
            if (rules_.shows(state(view), id)) emit shown_changed(view);
    });
    connect(&images, &ImageLoader::arrived, this, &ViewModel::refresh);
    connect(&images, &ImageLoader::failed, this, &ViewModel::refresh);
    connect(&kept, &KeptResults::changed, this, &ViewModel::refresh);
    connect(&session_, &Session::document_changed, this, &ViewModel::refresh);
    connect(&session_, &Session::experiment_selected, this, [this] {
        if (const auto* chosen = session_.experiment()) show_owner(chosen->id);
    });
}

std::string ViewModel::shown_key() const {
    return pictures_.key_of(active_state().a);
}

std::vector<std::string> ViewModel::shown_experiments() const {
    std::vector<std::string> ids;
    for (const int view : area_.open_views())
        for (const auto& source : rules_.sources(state(view)))
            if (session_.experiment(source.owner) &&
                std::find(ids.begin(), ids.end(), source.owner) == ids.end())
                ids.push_back(source.owner);
    return ids;
}

void ViewModel::set_state(int view, ViewState state) {
    state = rules_.completed(std::move(state));
    auto& present = states_[std::size_t(view)];
    if (state == present) return;
    const bool is_other = state.a.owner != present.a.owner;
    present = std::move(state);
    if (view == area_.active() && session_.experiment(present.a.owner))
        session_.select_experiment(present.a.owner);
    send_wants();
    emit shown_changed(view);
    if (is_other) emit explained_changed(view);
    if (view == area_.active()) emit active_changed();
}

void ViewModel::show_owner(const std::string& owner) {
    auto state = active_state();
    if (state.a.owner == owner) return;
    before_[std::size_t(area_.active())] = state;
    state.a.owner = owner;
    set_active_state(std::move(state));
}

void ViewModel::show_output(const std::string& key, int level, int layer) {
    auto state = active_state();
    state.a = {state.a.owner, key, level, layer};
    state.as_table = false;
    state.chain = false;
    // The same buffer of both experiments is what one wants to compare.
    if (state.b.owner != state.a.owner) state.b = {state.b.owner, key, level, layer};
    set_active_state(std::move(state));
}

void ViewModel::compare_with(const std::string& owner) {
    auto state = active_state();
    if (rules_.content_of(state) != ViewPane::Content::picture) state.a = {state.a.owner, {}};
    const auto outputs = pictures_.outputs(owner);
    const bool has_it = !state.a.output.empty() && pictures_.find(outputs, state.a.output);
    state.b = {owner, has_it ? state.a.output : std::string()};
    state.as_table = false;
    if (!widgets::compares(state.mode) || state.mode == ViewMode::stages) state.mode = ViewMode::side_by_side;
    set_active_state(std::move(state));
}

void ViewModel::set_mode(ViewMode mode) {
    auto state = active_state();
    state.mode = mode;
    set_active_state(std::move(state));
}

void ViewModel::set_linked(bool linked) {
    if (linked == linked_) return;
    linked_ = linked;
    emit linked_changed(linked);
}

const Display* ViewModel::chosen_display(const std::string& key, int view) const {
    return displays_.chosen(key, display_view(view));
}

void ViewModel::choose_display(const std::optional<Display>& display, const Display* before) {
    const auto key = rules_.display_key(active_state());
    const int view = display_view(area_.active());
    const bool is_shared = linked_ && rules_.shows_light(active_state());
    if (is_shared && !display) displays_.forget(DisplayMemory::light);
    const bool exposes = display && display->mode == Display::Mode::colour &&
                         (!before || !is_exposed_alike(*display, *before));
    if (is_shared && exposes) displays_.choose(DisplayMemory::light, *display);
    const bool is_own = !is_shared || !before || !display || *display != exposed_like(*before, *display);
    if (!display)
        displays_.forget(key, view);
    else if (is_own)
        displays_.choose(key, *display, view);
    emit displays_changed();
}

void ViewModel::set_panel_wants(std::map<std::string, Want> wants, const std::string& panel) {
    panel_wants_[panel] = std::move(wants);
    send_wants();
}

void ViewModel::send_wants() {
    std::map<std::string, Want> wants;
    const auto add = [](Want& want, const Want& more) {
        want.thumbnails |= more.thumbnails;
        want.parts.insert(more.parts.begin(), more.parts.end());
        want.kept.insert(more.kept.begin(), more.kept.end());
        want.buffers.insert(more.buffers.begin(), more.buffers.end());
    };
    const auto views = area_.open_views();
    for (const auto& id : shown_experiments()) {
        Want& want = wants[id];
        for (const int view : views) add(want, rules_.want_of(state(view), id));
        want.inspection = inspection(id);
        if (const auto found = steps_.find(id); found != steps_.end()) want.step = found->second;
        for (const auto& [panel, wanted] : panel_wants_)
            if (const auto found = wanted.find(id); found != wanted.end()) add(want, found->second);
    }
    live_.set_wants(std::move(wants));
    std::vector<ViewSource> shown;
    for (const int view : views)
        for (const auto& source : rules_.sources(state(view))) shown.push_back(source);
    pictures_.keep_only(shown);
}

void ViewModel::set_inspection(const std::string& experiment, const Inspection& inspection) {
    const auto before = std::exchange(inspections_[experiment], inspection);
    send_wants();
    refresh();
    if (before.x == inspection.x && before.y == inspection.y) return;
    for (const int view : area_.open_views())
        if (state(view).a.owner == experiment) emit explained_changed(view);
}

const Inspection& ViewModel::inspection(const std::string& experiment) const {
    static const Inspection none;
    const auto found = inspections_.find(experiment);
    return found == inspections_.end() ? none : found->second;
}

void ViewModel::set_step(const std::string& experiment, const FrameStep& step) {
    if (std::exchange(steps_[experiment], step) == step) return;
    send_wants();
    for (const int view : area_.open_views())
        if (rules_.shows(state(view), experiment)) emit shown_changed(view);
    emit active_changed();
}

std::vector<widgets::SpaceSelector> ViewModel::selectors(const std::string& owner) const {
    std::vector<widgets::SpaceSelector> list;
    const auto* experiment = session_.experiment(owner);
    const auto* method = experiment ? session_.registry().find(experiment->method) : nullptr;
    if (!method) return list;
    auto values = defaults(method->parameters);
    for (const auto& [key, value] : projects::effective(*experiment).values) values[key] = value;
    for (const auto& each : method->selectors) {
        const auto count = static_cast<int>(count_of(each, values));
        list.push_back({each.key, each.label, each.doc, count, inspection(owner).item(each.key)});
    }
    return list;
}

/// Where an experiment is gone, as after undoing what added it, the view shows what it did before it came,
/// and what it was compared with is not replaced by something that nobody asked for. Where it comes back, as
/// after redoing that, so does what the view showed of it, unless somebody looks at something else by then.
ViewState ViewModel::without_lost(int view) const {
    auto state = states_[std::size_t(view)];
    if (!session_.has_project()) return state;
    const auto& gone = gone_[std::size_t(view)];
    if (session_.experiment(gone.state.a.owner) && state.a == gone.instead.a &&
        state.mode == gone.instead.mode)
        return gone.state;
    const auto is_lost = [this](const ViewSource& source) {
        return !source.owner.empty() && !source.is_file() && !session_.experiment(source.owner);
    };
    if (is_lost(state.a) && session_.experiment(before_[std::size_t(view)].a.owner))
        state = before_[std::size_t(view)];
    if (widgets::compares(state.mode) && state.mode != ViewMode::stages && is_lost(state.b))
        state.mode = ViewMode::single;
    return state;
}

void ViewModel::refresh() {
    if (loading_) return;
    const auto owner = active_state().a.owner;
    for (std::size_t view = 0; view < states_.size(); ++view) {
        auto state = rules_.completed(without_lost(int(view)));
        const auto before = std::exchange(states_[view], std::move(state));
        const auto& lost = before.a;
        if (!lost.owner.empty() && !lost.is_file() && !session_.experiment(lost.owner))
            gone_[view] = {before, states_[view]};
    }
    // What is worked on is what is shown.
    if (active_state().a.owner != owner) session_.select_experiment(active_state().a.owner);
    send_wants();
    for (const int view : area_.open_views()) emit shown_changed(view);
}

/// Sizes and fields of buffers are known now, and with them what was left open.
void ViewModel::on_picture(const std::string& id) {
    bool completed_some = false;
    for (const int view : area_.open_views()) {
        if (!rules_.shows(state(view), id)) continue;
        auto state = rules_.completed(without_lost(view));
        if (state != states_[std::size_t(view)]) {
            states_[std::size_t(view)] = std::move(state);
            completed_some = true;
        }
        emit shown_changed(view);
    }
    if (completed_some) send_wants();
}

void ViewModel::on_active_changed() {
    const auto& owner = active_state().a.owner;
    if (session_.experiment(owner)) session_.select_experiment(owner);
    emit active_changed();
}

void ViewModel::save(projects::Json& memory) const {
    auto& views = memory["views"];
    views["linked"] = linked_;
    views["states"] = projects::Json::array();
    for (const auto& state : states_) views["states"].push_back(to_json(state));
    memory["displays"] = displays_.save();
    auto& inspections = memory["inspections"] = projects::Json::object();
    for (const auto& [id, inspection] : inspections_)
        if (session_.experiment(id)) inspections[id] = to_json(inspection);
}

int ViewModel::load(const projects::Json& memory) {
    loading_ = true;
    pictures_.clear();
    panel_wants_.clear();
    inspections_.clear();
    steps_.clear();
    if (const auto& kept = member_or_null(memory, "inspections"); kept.is_object())
        for (const auto& [id, inspection] : kept.items()) inspections_[id] = inspection_from_json(inspection);
    displays_.clear();
    displays_.load(member_or_null(memory, "displays"));
    const auto& views = member_or_null(memory, "views");
    states_ = before_ = {};
    gone_ = {};
    std::size_t view = 0;
    for (const auto& state : member_or_null(views, "states"))
        if (view < states_.size()) states_[view++] = view_state_from_json(state);
    linked_ = field_or(views, "linked", true);
    return int(view);
}

void ViewModel::finish_loading() {
    loading_ = false;
    emit linked_changed(linked_);
    refresh();
    for (const int view : area_.open_views()) emit explained_changed(view);
    on_active_changed();  // what is worked on is what the active view was left with
}

}  // namespace ir::gui
