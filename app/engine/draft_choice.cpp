#include "app/engine/draft_choice.h"

#include <algorithm>

namespace ir::engine {
namespace {

/// A coarser picture that takes more of the finer one's time than this comes too late to be looked at, unless
/// it lets a hand follow and the finer one does not.
constexpr double worth_of_finer = 0.6;

/// About so much of an execution's first frame is what later ones take.
constexpr double first_frame_share = 1.0 / 3;

bool is_quick(std::optional<double> ms) {
    return ms && *ms <= DraftChoice::hand_ms;
}

Fineness finer(Fineness fineness) {
    return static_cast<Fineness>(static_cast<int>(fineness) + 1);
}

}  // namespace

void DraftChoice::note_first(Fineness fineness, double ms) {
    if (!at(fineness)) note(fineness, first_frame_share * ms);
}

void DraftChoice::note_given_up(Fineness fineness, double ms) {
    if (ms > hand_ms) note(fineness, std::max(ms, at(fineness).value_or(0)));
}

bool DraftChoice::is_worth(Fineness fineness) const {
    const auto ms = at(fineness);
    if (!ms) return true;
    for (auto other = fineness; other < Fineness::full;) {
        other = finer(other);
        const auto others = at(other);
        if (others && *ms > worth_of_finer * *others && (!is_quick(ms) || is_quick(others))) return false;
    }
    return true;
}

Fineness DraftChoice::first(bool is_seen_already) const {
    for (const auto fineness : {Fineness::full, Fineness::half, Fineness::quarter})
        if (is_quick(at(fineness))) return fineness;
    if (!is_seen_already && is_worth(Fineness::preview)) return Fineness::preview;
    return after(Fineness::preview);
}

Fineness DraftChoice::after(Fineness fineness) const {
    do fineness = finer(fineness);
    while (fineness < Fineness::full && !is_worth(fineness));
    return fineness;
}

}  // namespace ir::engine
