#include "widgets/timeline/frames_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPainter>
#include <QSlider>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "widgets/parameters/number_field.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

constexpr double max_limit_mib = 1 << 20;

/// With a mark at each frame before which something was edited.
class FrameSlider : public QSlider {
  public:
    FrameSlider() : QSlider(Qt::Horizontal) { setPageStep(10); }
    void set_marks(std::vector<bool> marks) {
        marks_ = std::move(marks);
        update();
    }

  protected:
    void paintEvent(QPaintEvent* event) override {
        QStyleOptionSlider option;
        initStyleOption(&option);
        const auto part = [&](QStyle::SubControl control) {
            return style()->subControlRect(QStyle::CC_Slider, &option, control, this);
        };
        const QRect groove = part(QStyle::SC_SliderGroove);
        const int handle = part(QStyle::SC_SliderHandle).width();
        {
            QPainter painter(this);
            painter.setPen(QPen(palette().color(QPalette::Link), 1));
            for (int i = 0; i <= maximum() && i < int(marks_.size()); ++i) {
                if (!marks_[std::size_t(i)]) continue;
                const int x = groove.left() + handle / 2 +
                              QStyle::sliderPositionFromValue(0, maximum(), i, groove.width() - handle);
                painter.drawLine(x, 0, x, height() - 1);
            }
        }
        QSlider::paintEvent(event);
    }

  private:
    std::vector<bool> marks_;
};

}  // namespace

FramesPanel::FramesPanel(QWidget* parent) : QWidget(parent) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(4, 4, 4, 4);
    column->setSpacing(4);
    column->addLayout(make_slider_row());
    column->addLayout(make_caption_row());
    column->addStretch(1);
    show_state({});
}

QToolButton* FramesPanel::make_button(const char* name, const char* drawing, const QString& tip) {
    auto* button = new QToolButton;
    button->setObjectName(QLatin1String(name));
    button->setIcon(icon(drawing));
    button->setAutoRaise(true);
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    return button;
}

QLayout* FramesPanel::make_slider_row() {
    auto* row = new QHBoxLayout;
    older_ = make_button("older", "step-back", tr("One frame older (Alt+,)"));
    newer_ = make_button("newer", "step-forward", tr("One frame newer (Alt+.)"));
    for (auto* each : {older_, newer_}) each->setAutoRepeat(true);
    auto* slider = new FrameSlider;
    slider_ = slider;
    slider_->setObjectName(QStringLiteral("frames"));
    slider_->setAccessibleName(tr("Frames that are kept"));
    slider_->setToolTip(
        tr("The last frames, oldest at the left. A line marks a frame before which something was edited"));
    now_ = make_button("now", "redo", tr("Show the newest frame again (Alt+N)"));
    now_->setText(tr("Now"));
    now_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    row->addWidget(older_);
    row->addWidget(slider_, 1);
    row->addWidget(newer_);
    row->addWidget(now_);
    connect(older_, &QToolButton::clicked, this, [this] { emit frame_chosen(state_.shown - 1); });
    connect(newer_, &QToolButton::clicked, this, [this] { emit frame_chosen(state_.shown + 1); });
    connect(slider_, &QSlider::valueChanged, this, &FramesPanel::frame_chosen);
    connect(now_, &QToolButton::clicked, this, &FramesPanel::now_wanted);
    return row;
}

QLayout* FramesPanel::make_caption_row() {
    auto* row = new QHBoxLayout;
    caption_ = new QLabel;
    caption_->setObjectName(QStringLiteral("caption"));
    caption_->setMinimumWidth(1);
    caption_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    used_ = new QLabel;
    used_->setObjectName(QStringLiteral("used"));
    limit_ = new NumberField;
    limit_->setObjectName(QStringLiteral("limit"));
    limit_->set_whole(true);
    limit_->setRange(0, max_limit_mib);
    limit_->setSuffix(tr(" MiB"));
    limit_->setToolTip(tr("Memory for kept frames. The oldest go first; 0 keeps none"));
    limit_->setAccessibleName(limit_->toolTip());
    experiment_ = make_button("frame-experiment", "experiment", {});
    experiment_->setText(tr("As experiment"));
    experiment_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    keep_ = make_button("frame-keep", "keep", {});
    keep_->setText(tr("Keep"));
    keep_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    row->addWidget(caption_, 1);
    row->addWidget(used_);
    row->addWidget(limit_);
    row->addWidget(experiment_);
    row->addWidget(keep_);
    row->addWidget(make_film());
    connect(limit_, &NumberField::chosen, this, &FramesPanel::limit_chosen);
    connect(experiment_, &QToolButton::clicked, this, &FramesPanel::experiment_wanted);
    connect(keep_, &QToolButton::clicked, this, &FramesPanel::keep_wanted);
    return row;
}

QToolButton* FramesPanel::make_film() {
    film_ = make_button("frame-film", "export", {});
    film_->setText(tr("Save"));
    film_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    film_->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(film_);
    const auto add = [&](const char* name, const QString& text, Film film) {
        auto* action = menu->addAction(text, this, [this, film] { emit film_wanted(film); });
        action->setObjectName(QLatin1String(name));
    };
    add("film-pictures", tr("&Pictures as shown (PNG) …"), Film::pictures);
    add("film-values", tr("&Values (EXR) …"), Film::values);
    add("film-video", tr("V&ideo of the pictures …"), Film::video);
    film_->setMenu(menu);
    return film_;
}

void FramesPanel::show_state(const FramesState& state) {
    state_ = state;
    const int last = std::max(0, int(state.edited.size()) - 1);
    {
        const QSignalBlocker quiet(slider_);
        slider_->setRange(0, last);
        slider_->setValue(std::clamp(state.shown, 0, last));
    }
    static_cast<FrameSlider*>(slider_)->set_marks(state.edited);
    older_->setEnabled(state.shown > 0);
    newer_->setEnabled(state.is_past);
    now_->setEnabled(state.is_past);
    caption_->setText(state.caption);
    caption_->setToolTip(state.caption);
    used_->setText(tr("%1 MiB of").arg(std::ceil(state.used_mib)));
    used_->setToolTip(tr("Memory of the pictures and buffers that are kept"));
    if (!limit_->hasFocus()) limit_->show_value(state.limit_mib);
    const auto set = [](QToolButton* button, const QString& help, const QString& why_not) {
        button->setEnabled(why_not.isEmpty());
        button->setToolTip(why_not.isEmpty() ? help : help + QLatin1Char('\n') + why_not);
        button->setAccessibleName(help);
    };
    set(film_, tr("The kept frames of what the active view shows, as files"), state.why_no_film);
    set(experiment_, tr("A new experiment with the settings and the camera of this frame. Can be undone"),
        state.why_no_experiment);
    set(keep_,
        tr("An analysis of the project that renders as many frames of what the active view shows, and keeps "
           "their pictures (Alt+K). Can be undone"),
        state.why_not_kept);
}

}  // namespace ir::widgets
