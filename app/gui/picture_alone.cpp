#include "app/gui/picture_alone.h"

#include <utility>

namespace ir::gui {

using widgets::StagePair;
using widgets::ViewMode;
using widgets::ViewState;

void PictureAlone::show(int view, StagePair shown) {
    const auto all = views_.state(view);
    const auto places = views_.rules().places(all);
    auto alone = all;
    alone.a = places.at(std::size_t(shown.a));
    alone.mode = ViewMode::single;
    if (shown.b != StagePair::none) {
        alone.b = places.at(std::size_t(shown.b));
        alone.mode = ViewMode::difference;
    }
    views_.set_state(view, alone);
    shown_[std::size_t(view)] = {all, views_.state(view)};
}

bool PictureAlone::is_shown(int view) const {
    const auto& alone = shown_[std::size_t(view)].alone;
    const auto& now = views_.state(view);
    return !alone.a.owner.empty() && now.mode == alone.mode && now.a == alone.a && now.b == alone.b;
}

void PictureAlone::show_all(int view) {
    if (is_shown(view)) views_.set_state(view, std::exchange(shown_[std::size_t(view)], {}).all);
}

ViewState PictureAlone::in_mode(int view, ViewMode mode) const {
    auto state = is_shown(view) && mode != views_.state(view).mode ? shown_[std::size_t(view)].all
                                                                   : views_.state(view);
    state.mode = mode;
    return state;
}

}  // namespace ir::gui
