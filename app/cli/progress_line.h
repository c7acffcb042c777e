#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "renderers/core/progress.h"

namespace ir::cli {

/// How far a command has come with all that it was asked for, and how long the rest will take, on standard
/// error. On a terminal one line that follows the work; elsewhere a plain line once the rest can be told, and
/// then every ten seconds, as far as the work tells of itself.
class ProgressLine {
  public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds enough{2};  ///< of work, to estimate the rest from
    static constexpr std::chrono::seconds pause{10};  ///< off a terminal
    /// `work`: of all parts, in any unit. Tests have a time of their own.
    ProgressLine(bool is_shown, double work, std::function<Clock::time_point()> now = Clock::now);
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
    std::string text(const std::string& what) const;
    bool is_due();
    const bool is_shown_, is_terminal_;
    const double work_;
    const std::function<Clock::time_point()> now_;
    const Clock::time_point start_ = now_();
    Clock::time_point last_line_ = start_;
    std::string name_;
    double done_ = 0, part_ = 0, fraction_ = 0;
    double given_ = 0;  ///< work that was done before
    bool is_told_ = false;
};

}  // namespace ir::cli
