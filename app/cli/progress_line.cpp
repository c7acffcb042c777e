#include "app/cli/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "projects/text.h"

namespace ir::cli {
namespace {

constexpr std::size_t longest_text = 120;

/// "45 s", "3 min 5 s", "2 h 10 min", "3 d 4 h".
std::string duration_text(double seconds) {
    struct Unit {
        double seconds;
        const char* name;
    };
    constexpr Unit units[] = {{86400, " d"}, {3600, " h"}, {60, " min"}, {1, " s"}};
    for (int i = 0; i < 3; ++i) {
        const auto &large = units[i], &small = units[i + 1];
        const double rounded = std::round(seconds / small.seconds) * small.seconds;
        if (rounded < large.seconds) continue;
        const double whole = std::floor(rounded / large.seconds);
        const auto rest = static_cast<long>((rounded - whole * large.seconds) / small.seconds);
        return std::to_string(static_cast<long>(whole)) + large.name +
               (rest > 0 ? " " + std::to_string(rest) + small.name : "");
    }
    return std::to_string(std::lround(seconds)) + " s";
}

}  // namespace

ProgressLine::ProgressLine(bool is_shown, double work, std::function<Clock::time_point()> now)
    : is_shown_(is_shown),
      is_terminal_(isatty(STDERR_FILENO) != 0),
      work_(std::max(work, 1e-9)),
      now_(std::move(now)) {}

void ProgressLine::begin(std::string name, double work) {
    clear();
    done_ += part_;
    name_ = std::move(name);
    part_ = work;
    fraction_ = 0;
    is_told_ = false;
}

void ProgressLine::tell(const std::string& what, double fraction) {
    if (!is_shown_) return;
    if (!is_told_) given_ += fraction * part_;
    is_told_ = true;
    fraction_ = std::clamp(fraction, fraction_, 1.0);
    if (is_terminal_)
        std::fprintf(stderr, "\r\033[K%s", text(what).c_str());
    else if (is_due())
        std::fprintf(stderr, "%s\n", text(what).c_str());
}

ProgressCallback ProgressLine::callback() {
    if (!is_shown_) return {};
    return [this](const std::string& what, double fraction) { tell(what, fraction); };
}

void ProgressLine::clear() const {
    if (is_shown_ && is_terminal_) std::fprintf(stderr, "\r\033[K");
}

std::string ProgressLine::text(const std::string& what) const {
    const double now = done_ + fraction_ * part_, own = now - given_;
    const std::chrono::duration<double> spent = now_() - start_;
    char percent[16];
    std::snprintf(percent, sizeof percent, "%3.0f %% ", std::floor(100 * std::min(1.0, now / work_)));
    auto line = name_ + (name_.empty() || what.empty() ? "" : ": ") + what;
    line = percent + projects::printable(line, longest_text);
    if (spent >= enough && own > 0 && now < work_)
        line += ", " + duration_text(spent.count() * (work_ - now) / own) + " left";
    return line;
}

/// Off a terminal.
bool ProgressLine::is_due() {
    if (now_() - last_line_ < (last_line_ == start_ ? enough : pause)) return false;
    last_line_ = now_();
    return true;
}

}  // namespace ir::cli
