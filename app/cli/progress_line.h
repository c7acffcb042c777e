#pragma once

#include <chrono>
#include <string>

#include "renderers/core/progress.h"

namespace ir::cli {

/// How far a command has come with all that it was asked for, and how long the rest will take, on standard
/// error. On a terminal one line that follows the work; elsewhere plain lines: at each tenth but at most one
/// a second, and after 1, 2, 4, 8 and then every 16 seconds, as far as the work tells of itself.
class ProgressLine {
  public:
    /// `work`: of all parts, in any unit.
    ProgressLine(bool is_shown, double work);
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;

    /// What is told from now on is of a part of that much work; the part before is over, however it ended.
    void begin(std::string name, double work);
    /// A fraction that is not 0 at first was done before and says nothing of the time.
    void tell(const std::string& what, double fraction);
    /// tell(), or nothing where nothing is shown.
    ProgressCallback callback();
    /// Before anything else is written to the terminal.
    void clear() const;

  private:
    using Clock = std::chrono::steady_clock;
    std::string text(const std::string& what) const;
    bool is_due();
    const bool is_shown_, is_terminal_;
    const double work_;
    const Clock::time_point start_ = Clock::now();
    Clock::time_point last_line_ = start_;
    std::string name_;
    double done_ = 0, part_ = 0, fraction_ = 0;
    double given_ = 0;  ///< work that was done before
    bool is_told_ = false;
    int tenths_ = 0;
    Clock::duration pause_;
};

}  // namespace ir::cli
