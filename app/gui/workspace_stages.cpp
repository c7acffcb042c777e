#include <algorithm>

#include "app/gui/stage_chain.h"
#include "app/gui/workspace.h"

/// Rows of stages: the chain that a method names, and the reference beside it.
namespace ir::gui {

using widgets::Picture;
using widgets::StagePair;
using widgets::ViewMode;
using widgets::ViewState;

/// A chain follows the settings of its experiment: stages come and go with them. Without one, a person's row
/// stays.
void Workspace::complete_stages(ViewState& state) const {
    const auto chain = stages_of(session_, state.a.owner);
    state.chain |= state.more.empty() && chain.size() > 1;
    if (state.chain) {
        state.more.clear();
        for (std::size_t i = 0; i < chain.size(); ++i) {
            if (i == 0) state.a = chain[i].source;
            if (i > 0) state.more.push_back(chain[i].source);
        }
    }
    const int count = int(state.more.size()) + 1;
    auto& [a, b] = state.pair;
    if (a >= count) a = StagePair::none;
    if (b >= count || b == a) b = StagePair::none;
    if (b == StagePair::reference && reference_of(session_, state.a.owner).owner.empty()) b = StagePair::none;
}

bool Workspace::compares_reference(const ViewState& state) const {
    return state.mode == ViewMode::stages && state.pair.b == StagePair::reference && state.pair.a >= 0 &&
           !reference_of(session_, state.a.owner).owner.empty();
}

/// Pictures of a chain are called as the method calls its stages.
void Workspace::name_stages(int view, std::vector<std::shared_ptr<const Picture>>& pictures) const {
    const auto& shown = state(view);
    if (shown.mode != ViewMode::stages || !shown.chain) return;
    const auto chain = stages_of(session_, shown.a.owner);
    for (std::size_t i = 0; i < std::min(chain.size(), pictures.size()); ++i) {
        auto named = *pictures[i];
        named.label = chain[i].label;
        pictures[i] = std::make_shared<const Picture>(std::move(named));
    }
}

void Workspace::update_reference(int view) {
    const auto source = reference_of(session_, state(view).a.owner);
    auto picture = compares_reference(state(view)) ? pictures_.picture(source) : nullptr;
    // Of the experiment's size it is compared like its own pictures, with stages of smaller sizes, too.
    if (picture && picture->size() == main_size(state(view).a.owner)) {
        auto named = *picture;
        named.origin = state(view).a.owner;
        picture = std::make_shared<const Picture>(std::move(named));
    }
    auto& compare = pane(view)->compare();
    compare.set_reference(!source.owner.empty(), unless_equal(compare.reference(), picture));
}

QString Workspace::missing_stages(const ViewState& state) const {
    if (!state.chain || !state.more.empty()) return {};
    if (!has_stages(session_, state.a.owner))
        return tr("The method of %1 names no stages. Choose pictures for the row in the list beside.")
            .arg(QString::fromStdString(pictures_.owner_name(state.a.owner)));
    return tr("Under these settings there is one stage alone.");
}

}  // namespace ir::gui
