#include "app/gui/remaining_time.h"

#include <QObject>
#include <algorithm>
#include <cmath>

namespace ir::gui {
namespace {

/// Before so much of the work and of its time an estimate of the rest is a guess.
constexpr double min_fraction = 0.03, min_seconds = 1;
/// What is said is false where the rest is estimated longer by this factor and so many seconds.
constexpr double false_factor = 1.5, false_seconds = 5;
/// The fraction by which one report comes nearer to a shorter rest: one quick step is no quick work.
constexpr double smoothing = 0.5;

}  // namespace

void RemainingTime::start(double now, double done) {
    *this = {};
    began_ = now;
    done_before_ = done;
}

void RemainingTime::report(double now, double fraction) {
    const double elapsed = now - began_, missing = 1 - done_before_;
    const double part = missing > 0 ? (std::min(fraction, 1.0) - done_before_) / missing : 1;
    if (!(part >= min_fraction) || elapsed < min_seconds) return;
    const double rest = elapsed * (1 - part) / part;
    if (!seconds_) seconds_ = rest;
    *seconds_ += smoothing * std::min(0.0, rest - *seconds_);
    is_true_ = rest <= false_factor * *seconds_ + false_seconds;
}

QString duration_text(double seconds) {
    const auto whole = std::llround(std::max(0.0, seconds));
    const auto in = [&](long long step) { return (whole + step / 2) / step; };
    if (whole < 10) return QObject::tr("%1 s").arg(whole);
    if (whole < 58) return QObject::tr("about %1 s").arg(5 * in(5));
    if (whole < 3570) return QObject::tr("about %1 min").arg(in(60));
    const auto minutes = 10 * in(600);
    if (minutes % 60 == 0) return QObject::tr("about %1 h").arg(minutes / 60);
    return QObject::tr("about %1 h %2 min").arg(minutes / 60).arg(minutes % 60);
}

}  // namespace ir::gui
