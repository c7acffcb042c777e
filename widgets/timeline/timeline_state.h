#pragma once

#include <QString>
#include <vector>

namespace ir::widgets {

/// What moves, and when its keys are.
struct TimelineTrack {
    QString name, what;        ///< "Walk", "camera 'Nave'"
    std::vector<double> keys;  ///< seconds; empty: not known one by one
    double end = 0;            ///< seconds, of what has no keys
    bool loop = false;
};

/// Everything that the timeline shows.
struct TimelineState {
    QString empty;  ///< not empty: nothing moves, and what could be done about it
    std::vector<TimelineTrack> tracks;
    double end = 1;             ///< seconds; it begins at 0
    double time = 0;            ///< shown now
    double own_time = 0;        ///< of the experiment's last frame
    bool is_elsewhere = false;  ///< `time` is the timeline's, not the experiment's
    bool playing = false, loop = false;
    double frames_per_second = 0;  ///< while playing; 0: not known yet
    int history = 0;               ///< frames since the history was empty; 0: not known
    QString read_only;             ///< not empty: the experiment's time cannot be set, and why
};

inline constexpr double timeline_frames_per_second = 30;

}  // namespace ir::widgets
