#pragma once

namespace ir::widgets {

/// Two pictures of a row of stages that are compared beside the row, by their place in it.
struct StagePair {
    static constexpr int none = -1;
    static constexpr int reference = -2;  ///< as `b`: the picture that is known to be right
    int a = none, b = none;
    bool operator==(const StagePair&) const = default;
};

/// After a person chose a picture of the row: the first one becomes A, the second B, a third one takes B's
/// place and B that of A; one that is chosen already is chosen no longer.
StagePair with_chosen(StagePair pair, int picture);

}  // namespace ir::widgets
