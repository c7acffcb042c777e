#include "widgets/timeline/timeline_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "renderers/core/limits.h"
#include "widgets/parameters/number_field.h"
#include "widgets/style/icons.h"
#include "widgets/timeline/time_bar.h"

namespace ir::widgets {
namespace {

NumberField* number(const char* name, const QString& tip, int width) {
    auto* field = new NumberField;
    field->setObjectName(QLatin1String(name));
    field->setToolTip(tip);
    field->setAccessibleName(tip);
    field->setFixedWidth(width);
    return field;
}

}  // namespace

TimelinePanel::TimelinePanel(QWidget* parent)
    : QWidget(parent), pages_(new QStackedWidget), bar_(new TimeBar) {
    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(4, 4, 4, 4);
    column->setSpacing(4);
    column->addWidget(make_bar());
    column->addWidget(bar_);
    column->addStretch(1);
    pages_->addWidget(content);
    pages_->addWidget(make_empty());
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(pages_);
    connect(bar_, &TimeBar::time_chosen, this, &TimelinePanel::time_chosen);
    connect(bar_, &TimeBar::step_wanted, this, &TimelinePanel::step_wanted);
    connect(bar_, &TimeBar::play_toggled, this, [this] { emit play_wanted(!state_.playing); });
    show_state({});
}

QToolButton* TimelinePanel::button(const char* name, const char* drawing, const QString& tip) {
    auto* result = new QToolButton;
    result->setObjectName(QLatin1String(name));
    result->setIcon(icon(drawing));
    result->setAutoRaise(true);
    result->setToolTip(tip);
    result->setAccessibleName(tip);
    return result;
}

QWidget* TimelinePanel::make_bar() {
    auto* bar = new QWidget;
    auto* row = new QHBoxLayout(bar);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(2);
    auto* start = button("to-start", "to-start", tr("Go to the beginning (Home)"));
    auto* back = button("step-back", "step-back", tr("One frame back (,): it is rendered without a history"));
    play_ = button("play", "play", tr("Play (K, or Space in the timeline)"));
    auto* forward = button("step-forward", "step-forward", tr("One frame on (.): the history goes on"));
    loop_ = button("loop", "loop", tr("Begin again at the end"));
    loop_->setCheckable(true);
    for (auto* each : {start, back, play_, forward, loop_}) row->addWidget(each);
    time_ = number("time", tr("Time that is shown, seconds"), 92);
    time_->setRange(0, max_seconds);
    time_->setSuffix(tr(" s"));
    frame_ = number("frame", tr("Number of the frame, 30 a second"), 76);
    frame_->set_whole(true);
    frame_->setRange(0, max_frames);
    end_ = number("end", tr("Where the timeline ends, seconds; 0 is as long as something moves"), 92);
    end_->setRange(0, max_seconds);
    end_->setSuffix(tr(" s"));
    speed_ = new QLabel;
    speed_->setObjectName(QStringLiteral("speed"));
    speed_->setMinimumWidth(1);
    set_ = button("set-time", "keep", tr("Set as the experiment's time"));
    set_->setText(tr("Set as the experiment's time"));
    set_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    return_ = button("return", "undo", tr("Show the experiment's own time again"));
    row->addSpacing(8);
    row->addWidget(time_);
    row->addSpacing(4);
    row->addWidget(new QLabel(tr("frame")));
    row->addWidget(frame_);
    row->addSpacing(8);
    row->addWidget(speed_, 1);
    row->addWidget(return_);
    row->addWidget(set_);
    row->addSpacing(8);
    row->addWidget(new QLabel(tr("to")));
    row->addWidget(end_);
    connect(start, &QToolButton::clicked, this, [this] { emit time_chosen(0); });
    connect(back, &QToolButton::clicked, this, [this] { emit step_wanted(-1); });
    connect(forward, &QToolButton::clicked, this, [this] { emit step_wanted(1); });
    connect(play_, &QToolButton::clicked, this, [this] { emit play_wanted(!state_.playing); });
    connect(loop_, &QToolButton::clicked, this, &TimelinePanel::loop_chosen);
    connect(time_, &NumberField::chosen, this, &TimelinePanel::time_chosen);
    connect(frame_, &NumberField::chosen, this,
            [this](double frame) { emit time_chosen(frame / timeline_frames_per_second); });
    connect(end_, &NumberField::chosen, this, &TimelinePanel::end_chosen);
    connect(set_, &QToolButton::clicked, this, &TimelinePanel::set_time_wanted);
    connect(return_, &QToolButton::clicked, this, &TimelinePanel::return_wanted);
    return bar;
}

QWidget* TimelinePanel::make_empty() {
    empty_ = new QLabel;
    empty_->setObjectName(QStringLiteral("empty"));
    empty_->setAlignment(Qt::AlignCenter);
    empty_->setWordWrap(true);
    empty_->setMargin(12);
    empty_->setForegroundRole(QPalette::PlaceholderText);
    return empty_;
}

void TimelinePanel::show_state(const TimelineState& state) {
    const bool plays = state_.playing;
    state_ = state;
    pages_->setCurrentIndex(state.empty.isEmpty() ? 0 : 1);
    empty_->setText(state.empty);
    if (plays != state.playing) {
        play_->setIcon(icon(state.playing ? "pause" : "play"));
        const QString tip = state.playing ? tr("Pause (K, or Space in the timeline)")
                                          : tr("Play (K, or Space in the timeline)");
        play_->setToolTip(tip);
        play_->setAccessibleName(tip);
    }
    loop_->setChecked(state.loop);
    set_->setEnabled(state.is_elsewhere && state.read_only.isEmpty());
    set_->setToolTip(state.read_only.isEmpty()
                         ? tr("Set as the experiment's time: its last frame is then this one. Can be undone")
                         : state.read_only);
    return_->setEnabled(state.is_elsewhere);
    show_times();
    bar_->show_state(state);
}

void TimelinePanel::show_times() {
    // What is being typed is not overwritten, except by time that passes.
    if (!time_->hasFocus() || state_.playing) time_->show_value(std::round(state_.time * 1000) / 1000);
    if (!frame_->hasFocus() || state_.playing)
        frame_->show_value(std::round(state_.time * timeline_frames_per_second));
    if (!end_->hasFocus()) end_->show_value(std::round(state_.end * 1000) / 1000);
    QString text;
    if (state_.playing && state_.frames_per_second > 0)
        text = tr("%1 frames/s").arg(state_.frames_per_second, 0, 'f', state_.frames_per_second < 10 ? 1 : 0);
    if (state_.is_elsewhere && state_.history > 0)
        text += (text.isEmpty() ? QString() : QStringLiteral(" · ")) +
                (state_.history == 1 ? tr("no history") : tr("history: %1 frames").arg(state_.history));
    speed_->setText(text);
    speed_->setToolTip(
        tr("How many frames a second are rendered (at most 30), and how many have followed each "
           "other since the history was empty"));
}

}  // namespace ir::widgets
