#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <deque>

#include "app/gui/live_pictures.h"

namespace ir::gui {

/// Time as it passes in the window: plays, steps and scrubs the pictures of all experiments in which
/// something moves. A frame is asked for once the one before is there, so that none is missing in any
/// history, and at most 30 times a second. The document's own times stay until set_as_own_time().
class Playback : public QObject {
    Q_OBJECT
  public:
    Playback(Session& session, LivePictures& live, QObject* parent = nullptr);

    bool is_playing() const { return playing_; }
    bool loops() const { return loop_; }
    /// Seconds that the experiment that is worked on is shown at, and those of its own last frame.
    double time() const;
    double own_time() const;
    bool is_elsewhere() const { return live_.moment().has_value(); }
    /// Seconds: where playing ends. What was chosen, or as long as something moves.
    double end() const;
    double frames_per_second() const;  ///< as measured; 0: not known
    /// Whether something moves in the experiment that is worked on.
    bool can_play() const;

    void play(bool on);
    /// On: the history goes on. Back: it begins anew.
    void step(int frames);
    void seek(double time);  ///< with an empty history
    void set_loop(bool loop);
    void set_end(double end);  ///< 0: as long as something moves
    void return_to_own_time();
    void set_as_own_time();  ///< an edit

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    void changed();

  private:
    void go_on();
    void advance();
    void show(Moment moment);
    void pass_to(Moment moment);  ///< by itself, so past frames stay shown
    void stop();                  ///< likewise
    bool is_drawn() const;

    Session& session_;
    LivePictures& live_;
    QTimer timer_{this};
    QElapsedTimer clock_;           ///< since the program began to play
    std::deque<qint64> frames_ms_;  ///< when the last frames were asked for
    bool playing_ = false, loop_ = false;
    double end_ = 0;  ///< chosen; 0: none
};

}  // namespace ir::gui
