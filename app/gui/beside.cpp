#include "app/gui/beside.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace ir::gui {

using widgets::ViewArea;
using widgets::ViewPane;
using widgets::ViewState;

namespace {

bool shows_explanation(const ViewModel& views, const ViewState& state, const std::string& owner) {
    return state.a.owner == owner && views.rules().is_explanation(state.a);
}

/// One that is fit already, else a new one, else one that shows neither what is worked with nor a picture of
/// the owner, else any but the active one; none of those that were filled just now.
int view_beside(const ViewModel& views, ViewArea& area, const std::string& owner, const std::set<int>& filled,
                const std::function<bool(const ViewState&)>& is_fit) {
    const int active = area.active();
    const auto open = area.open_views();
    const auto last = [&](const auto& test) {
        const auto found = std::find_if(open.rbegin(), open.rend(),
                                        [&](int each) { return filled.count(each) == 0 && test(each); });
        return found == open.rend() ? -1 : *found;
    };
    if (const int view = last([&](int each) { return is_fit(views.state(each)); }); view >= 0) return view;
    if (const int view = area.open_another(); view >= 0) return view;
    const int dispensable = last([&](int each) {
        const auto& shown = views.state(each);
        return each != active && (shown.a.owner != owner || shows_explanation(views, shown, owner) ||
                                  views.rules().content_of(shown) != ViewPane::Content::picture);
    });
    if (dispensable >= 0) return dispensable;
    const int other = last([&](int each) { return each != active; });
    return other < 0 ? active : other;
}

}  // namespace

void show_beside(ViewModel& views, ViewArea& area, const std::string& owner, const std::string& key) {
    const auto outputs = views.pictures().outputs(owner);
    const auto* output = views.pictures().find(outputs, key);
    if (!output) return;
    if (widgets::is_spatial(output->kind)) return show_in_space(views, area, owner, {key});
    const int before = area.active();
    const int view = view_beside(views, area, owner, {}, [&](const ViewState& state) {
        return shows_explanation(views, state, owner) &&
               views.rules().content_of(state) != ViewPane::Content::space;
    });
    ViewState state;
    state.a = {owner, key};
    views.set_state(view, state);
    area.set_active(before);
}

void show_in_space(ViewModel& views, ViewArea& area, const std::string& owner,
                   const std::vector<std::string>& keys) {
    std::map<widgets::Space, std::vector<widgets::AvailableBuffer>> spaces;
    const auto buffers = views.rules().spatial_buffers(owner);
    const auto find = [&](const std::string& key) {
        return std::find_if(buffers.begin(), buffers.end(),
                            [&](const auto& each) { return each.key == key; });
    };
    const auto space_of = [](const auto& buffer) { return widgets::space_of(buffer.kind, buffer.fields); };
    for (const auto& key : keys)
        if (const auto found = find(key); found != buffers.end()) spaces[space_of(*found)].push_back(*found);
    const int before = area.active();
    std::set<int> filled;
    for (const auto& [space, shown] : spaces) {
        const int view = view_beside(views, area, owner, filled, [&, space = space](const ViewState& state) {
            const auto now = find(views.pictures().key_of(state.a));
            return views.rules().content_of(state) == ViewPane::Content::space && state.a.owner == owner &&
                   now != buffers.end() && space_of(*now) == space;
        });
        filled.insert(view);
        auto state = views.state(view);
        const auto last = find(views.pictures().key_of(state.a));
        if (last == buffers.end() || space_of(*last) != space) state.space.camera.reset();
        state.a = {owner, shown.front().key};
        state.as_table = false;
        std::vector<widgets::SpaceLayer> layers;
        for (const auto& buffer : shown) layers.push_back(widgets::default_layer(buffer));
        widgets::begin_with(state.space, std::move(layers));
        views.set_state(view, state);
    }
    area.set_active(before);
}

}  // namespace ir::gui
