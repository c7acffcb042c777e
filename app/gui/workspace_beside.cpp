#include <algorithm>

#include "app/gui/workspace.h"

/// Showing something in another view than the one that is worked with.
namespace ir::gui {

using widgets::ViewPane;
using widgets::ViewState;

bool Workspace::shows_explanation(const ViewState& state, const std::string& owner) const {
    const auto result = state.a.owner == owner ? live_.result(owner) : nullptr;
    const auto* resource = result ? find_resource(result->report, pictures_.key_of(state.a)) : nullptr;
    return resource && resource->explains;
}

/// One that is fit already, else a new one, else one that shows neither what is worked with nor a picture of
/// the owner, else any but the active one; none of those that were filled just now.
int Workspace::view_beside(const std::string& owner, const std::set<int>& filled,
                           const std::function<bool(const ViewState&)>& is_fit) {
    const int active = area_->active();
    const auto open = area_->open_views();
    const auto last = [&](const auto& test) {
        const auto found = std::find_if(open.rbegin(), open.rend(),
                                        [&](int each) { return filled.count(each) == 0 && test(each); });
        return found == open.rend() ? -1 : *found;
    };
    if (const int view = last([&](int each) { return is_fit(state(each)); }); view >= 0) return view;
    if (const int view = area_->open_another(); view >= 0) return view;
    const int dispensable = last([&](int each) {
        const auto& shown = state(each);
        return each != active && (shown.a.owner != owner || shows_explanation(shown, owner) ||
                                  content_of(shown) != ViewPane::Content::picture);
    });
    if (dispensable >= 0) return dispensable;
    const int other = last([&](int each) { return each != active; });
    return other < 0 ? active : other;
}

void Workspace::show_beside(const std::string& owner, const std::string& key) {
    const auto outputs = pictures_.outputs(owner);
    const auto* output = pictures_.find(outputs, key);
    if (!output) return;
    if (widgets::is_spatial(output->kind)) return show_in_space(owner, {key});
    const int before = area_->active();
    const int view = view_beside(owner, {}, [&](const ViewState& state) {
        return shows_explanation(state, owner) && content_of(state) != ViewPane::Content::space;
    });
    ViewState state;
    state.a = {owner, key};
    set_state(view, state);
    area_->set_active(before);
}

void Workspace::show_in_space(const std::string& owner, const std::vector<std::string>& keys) {
    std::map<widgets::Space, std::vector<widgets::AvailableBuffer>> spaces;
    const auto buffers = spatial_buffers(owner);
    const auto find = [&](const std::string& key) {
        return std::find_if(buffers.begin(), buffers.end(),
                            [&](const auto& each) { return each.key == key; });
    };
    const auto space_of = [](const auto& buffer) { return widgets::space_of(buffer.kind, buffer.fields); };
    for (const auto& key : keys)
        if (const auto found = find(key); found != buffers.end()) spaces[space_of(*found)].push_back(*found);
    const int before = area_->active();
    std::set<int> filled;
    for (const auto& [space, shown] : spaces) {
        const int view = view_beside(owner, filled, [&, space = space](const ViewState& state) {
            const auto now = find(pictures_.key_of(state.a));
            return content_of(state) == ViewPane::Content::space && state.a.owner == owner &&
                   now != buffers.end() && space_of(*now) == space;
        });
        filled.insert(view);
        auto state = states_[std::size_t(view)];
        const auto last = find(pictures_.key_of(state.a));
        if (last == buffers.end() || space_of(*last) != space) state.space.camera.reset();
        state.a = {owner, shown.front().key};
        state.as_table = false;
        state.space.layers.clear();
        for (const auto& buffer : shown) state.space.layers.push_back(widgets::default_layer(buffer));
        set_state(view, state);
    }
    area_->set_active(before);
}

}  // namespace ir::gui
