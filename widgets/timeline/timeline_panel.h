#pragma once

#include <QWidget>

#include "widgets/timeline/timeline_state.h"

class QLabel;
class QStackedWidget;
class QToolButton;

namespace ir::widgets {

class NumberField;
class TimeBar;

/// Plays, steps and scrubs through time. Changes nothing itself: whoever owns the time answers with a state.
class TimelinePanel : public QWidget {
    Q_OBJECT
  public:
    explicit TimelinePanel(QWidget* parent = nullptr);
    /// Emits nothing.
    void show_state(const TimelineState& state);
    const TimelineState& state() const { return state_; }
    TimeBar& bar() { return *bar_; }
    QSize sizeHint() const override { return {600, 110}; }

  signals:
    void play_wanted(bool play);
    void step_wanted(int frames);
    void time_chosen(double time);
    void loop_chosen(bool loop);
    /// Seconds; 0: as long as something moves.
    void end_chosen(double end);
    /// The experiment is to have the time that is shown.
    void set_time_wanted();
    /// The experiment's own time is to be shown again.
    void return_wanted();

  private:
    QWidget* make_bar();
    QWidget* make_empty();
    QToolButton* button(const char* name, const char* drawing, const QString& tip);
    void show_times();

    TimelineState state_;
    QStackedWidget* pages_;
    TimeBar* bar_;
    QLabel *empty_ = nullptr, *speed_ = nullptr;
    QToolButton *play_ = nullptr, *loop_ = nullptr, *set_ = nullptr, *return_ = nullptr;
    NumberField *time_ = nullptr, *frame_ = nullptr, *end_ = nullptr;
};

}  // namespace ir::widgets
