#include "app/gui/status_line.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <algorithm>

#include "app/gui/text_of.h"
#include "widgets/models/report_rows.h"
#include "widgets/style/icons.h"

namespace ir::gui {
namespace {

constexpr int said_ms = 4000;
/// Progress comes with every pass and slice. Each new text draws the whole window again, since its views are
/// OpenGL; without a GPU that took half of the processor from what is being rendered.
constexpr int between_texts_ms = 250;

}  // namespace

StatusLine::StatusLine(Session& session, LivePictures& live, QWidget* parent)
    : QWidget(parent),
      session_(session),
      live_(live),
      state_(new QLabel(this)),
      progress_(new QProgressBar(this)),
      cancel_(new QToolButton(this)) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(4, 0, 4, 0);
    state_->setObjectName(QStringLiteral("state"));
    state_->setMinimumWidth(1);
    progress_->setRange(0, 1000);
    progress_->setMaximumWidth(180);
    progress_->setMaximumHeight(14);
    progress_->setTextVisible(false);
    cancel_->setIcon(widgets::icon("cancel"));
    cancel_->setAutoRaise(true);
    cancel_->setToolTip(tr("Cancel rendering (Esc)"));
    cancel_->setAccessibleName(tr("Cancel rendering"));
    // The bar is as high while nothing is rendered, so that the docks above do not jump.
    for (QWidget* each : {static_cast<QWidget*>(progress_), static_cast<QWidget*>(cancel_)}) {
        auto policy = each->sizePolicy();
        policy.setRetainSizeWhenHidden(true);
        each->setSizePolicy(policy);
    }
    state_->setTextFormat(Qt::PlainText);
    row->addWidget(state_, 1);
    row->addWidget(progress_);
    row->addWidget(cancel_);
    connect(cancel_, &QToolButton::clicked, this, &StatusLine::cancel_wanted);
    connect(&live_, &LivePictures::state_changed, this, &StatusLine::update_text);
    said_.setSingleShot(true);
    connect(&said_, &QTimer::timeout, this, &StatusLine::forget);
    later_.setSingleShot(true);
    connect(&later_, &QTimer::timeout, this, &StatusLine::update_text);
    connect(&live_, &LivePictures::progressed, this, &StatusLine::update_soon);
    connect(&session_, &Session::experiment_selected, this, &StatusLine::update_text);
    connect(&session_, &Session::project_replaced, this, &StatusLine::update_text);
    update_text();
}

void StatusLine::say(const QString& text) {
    saying_ = text;
    said_.start(said_ms);
    update_text();
}

void StatusLine::forget() {
    said_.stop();
    saying_.clear();
    update_text();
}

QString StatusLine::text_of_rendering(const std::vector<std::string>& ids) const {
    const auto* chosen = session_.experiment();
    const bool shown = chosen && std::find(ids.begin(), ids.end(), chosen->id) != ids.end();
    const auto& id = shown ? chosen->id : ids.front();
    const auto* experiment = session_.experiment(id);
    const QString name = experiment ? text_of(experiment->name) : text_of(id);
    QString text = tr("Rendering %1").arg(name);
    const int frames = experiment ? projects::effective(*experiment).frames : 1;
    const auto result = live_.result(id);
    if (frames > 1 && result)
        text += tr(", frame %1 of %2").arg(std::min(frames, result->frame + 1)).arg(frames);
    const auto progress = live_.progress(id);
    if (!progress.doing.isEmpty()) text += QStringLiteral(": ") + progress.doing;
    if (const auto left = progress.seconds_left; left && *left >= 1)
        text += tr(", %1 left").arg(duration_text(*left));
    if (ids.size() > 1) text += tr(" (and %n more)", nullptr, int(ids.size()) - 1);
    return text;
}

QString StatusLine::text_of_state() const {
    using State = LivePictures::State;
    if (!session_.has_project()) return tr("Ready");
    const auto* chosen = session_.experiment();
    if (!chosen) return tr("The project has no experiment yet.");
    const auto reason = text_of(live_.text(chosen->id));
    const auto result = live_.result(chosen->id);
    switch (live_.state(chosen->id)) {
        case State::blocked:
            return reason;
        case State::cancelled:
            return tr("Cancelled. F5 renders again.");
        case State::failed:
            return tr("Failed: %1").arg(reason);
        case State::done:
            if (!result) return tr("Ready");
            return tr("%1 of %2 frames, %3 ms, %4")
                .arg(result->frame)
                .arg(result->frames)
                .arg(widgets::milliseconds_text(result->report.wall_ms),
                     widgets::bytes_text(result->report.memory_bytes));
        default:
            return tr("Ready");
    }
}

void StatusLine::update_soon() {
    if (!later_.isActive()) later_.start(between_texts_ms);
}

void StatusLine::update_text() {
    later_.stop();
    const auto ids = live_.rendering();
    progress_->setVisible(!ids.empty());
    cancel_->setVisible(!ids.empty());
    if (!ids.empty()) {
        double sum = 0;
        for (const auto& id : ids) sum += live_.progress(id).fraction;
        progress_->setValue(int(1000 * sum / double(ids.size())));
    }
    const QString text = !saying_.isEmpty() ? saying_
                         : ids.empty()      ? text_of_state()
                                            : text_of_rendering(ids);
    if (text == state_->toolTip()) return;
    state_->setText(text.simplified());  // one line, whatever a driver's reason holds
    state_->setToolTip(text);
}

}  // namespace ir::gui
