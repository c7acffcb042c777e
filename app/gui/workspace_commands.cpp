#include "app/gui/workspace.h"

/// What is done to the active view.
namespace ir::gui {

using widgets::ViewPane;

void Workspace::show_output(const std::string& key, int level, int layer) {
    auto state = active_state();
    state.a.output = key;
    state.a.level = level;
    state.a.layer = layer;
    state.as_table = false;
    state.chain = false;
    // The same buffer of both experiments is what one wants to compare.
    if (state.b.owner != state.a.owner) {
        state.b.output = key;
        state.b.level = level;
        state.b.layer = layer;
    }
    set_state(area_->active(), state);
}

void Workspace::step_output(int step) {
    const auto outputs = pictures_.outputs(active_state().a.owner);
    if (outputs.empty()) return;
    const auto* now = pictures_.find(outputs, shown_key());
    const int count = int(outputs.size()), at = now ? int(now - outputs.data()) : 0;
    show_output(outputs[std::size_t((at + step + count) % count)].key);
}

void Workspace::show_owner(const std::string& owner) {
    auto state = active_state();
    if (state.a.owner == owner) return;
    before_[std::size_t(area_->active())] = state;
    state.a.owner = owner;
    set_state(area_->active(), state);
}

void Workspace::compare_with(const std::string& owner) {
    auto state = active_state();
    if (content_of(state) != ViewPane::Content::picture) state.a = {state.a.owner, {}};
    const auto outputs = pictures_.outputs(owner);
    const bool has_it = !state.a.output.empty() && pictures_.find(outputs, state.a.output);
    state.b = {owner, has_it ? state.a.output : std::string()};
    state.as_table = false;
    if (!widgets::compares(state.mode) || state.mode == widgets::ViewMode::stages)
        state.mode = widgets::ViewMode::side_by_side;
    set_state(area_->active(), state);
}

void Workspace::set_mode(widgets::ViewMode mode) {
    auto state = active_state();
    state.mode = mode;
    set_state(area_->active(), state);
}

void Workspace::show_stages() {
    auto state = active_state();
    state.mode = widgets::ViewMode::stages;
    state.as_table = false;
    state.chain = true;
    set_state(area_->active(), state);
}

void Workspace::swap() {
    active_pane().compare().swap();
}

std::string Workspace::shown_key() const {
    return pictures_.key_of(active_state().a);
}

}  // namespace ir::gui
