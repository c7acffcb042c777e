#pragma once

#include <QString>
#include <optional>

namespace ir::gui {

/// How long work still takes, for people. What it says never rises: where work is slower than it seemed, it
/// stands still until it is true again, and where it is far from the truth it says nothing. Seconds are those
/// of any clock that does not go back.
class RemainingTime {
  public:
    /// The work begins, of which a part is done already; nothing is known of how long it takes.
    void start(double now, double done = 0);
    /// The fraction of the work that is done, 0 … 1, with what was done before.
    void report(double now, double fraction);
    /// Seconds, as of the last report; absent while they are not known.
    std::optional<double> seconds() const { return is_true_ ? seconds_ : std::nullopt; }

  private:
    double began_ = 0, done_before_ = 0;
    std::optional<double> seconds_;
    bool is_true_ = false;
};

/// In few steps, the coarser the longer: "4 s", "about 25 s", "about 3 min", "about 1 h 10 min".
QString duration_text(double seconds);

}  // namespace ir::gui
