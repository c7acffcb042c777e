#include <QHelpEvent>
#include <QKeyEvent>
#include <QPainter>
#include <QScrollArea>
#include <QToolTip>
#include <cmath>

#include "widgets/compare/compare_view.h"
#include "widgets/compare/difference_worker.h"
#include "widgets/compare/one_size.h"
#include "widgets/compare/stage_bar.h"

/// Rows of stages: what stands under the pictures, and which two of them are compared beside the row.
namespace ir::widgets {

void CompareView::set_stage_pair(StagePair pair) {
    if (pair == pair_) return;
    pair_ = pair;
    refresh();
}

void CompareView::set_reference(bool exists, std::shared_ptr<const Picture> picture) {
    if (exists == has_reference_ && picture == reference_) return;
    has_reference_ = exists;
    reference_ = std::move(picture);
    refresh();
}

void CompareView::choose_pair(StagePair pair) {
    if (pair == pair_) return;
    set_stage_pair(pair);
    if (has_pair()) scroll_->ensureWidgetVisible(panes_[contents().size() - 1]);
    emit stage_pair_chosen(pair);
}

bool CompareView::has_pair() const {
    if (!has_rows() || count() < 2 || pair_.a < 0 || pair_.a >= count()) return false;
    if (pair_.b == StagePair::reference) return reference_ != nullptr;
    return pair_.b >= 0 && pair_.b < count() && pair_.b != pair_.a;
}

const Picture& CompareView::stage(int picture) const {
    return picture == StagePair::reference ? *reference_ : *pictures_[picture];
}

StagePair CompareView::ends_of(int slot) const {
    return slot == pair_slot ? pair_ : StagePair{slot, slot + 1};
}

QString CompareView::stage_name(int picture) const {
    return picture == StagePair::reference ? tr("Reference") : letter_of(picture);
}

int CompareView::caption_height() const {
    return has_rows() && contents().size() > 1 ? fontMetrics().height() + 4 : 0;
}

/// One range for the whole row, so that equal colours mean equal differences: that of the largest values, but
/// of signed and absolute differences no more than a few RMSE, where outliers would leave all others pale.
Display CompareView::stage_display() const {
    constexpr double most_rmse = 4;
    std::optional<Display> common;
    double rmse = 0;
    for (const auto& content : contents()) {
        const auto* result = content.difference ? worker_->result(content.slot) : nullptr;
        if (!result || !result->picture->has_image()) continue;
        if (!common) common = result->automatic;
        common->low = std::min(common->low, result->automatic.low);
        common->high = std::max(common->high, result->automatic.high);
        if (std::isfinite(result->rmse)) rmse = std::max(rmse, result->rmse);
    }
    if (common && rmse > 0 && (kind_ == DifferenceKind::signed_ || kind_ == DifferenceKind::absolute)) {
        common->low = std::max(common->low, -most_rmse * rmse);
        common->high = std::min(common->high, most_rmse * rmse);
    }
    return common.value_or(Display());
}

QString CompareView::number_of(int slot) const {
    const auto* result = worker_->result(slot);
    const auto [a, b] = ends_of(slot);
    if (!result || !std::isfinite(result->rmse) || !refusal().isEmpty() ||
        !have_difference(stage(a), stage(b)))
        return {};
    const QString& unit = result->request.a->unit;
    return tr("RMSE %1").arg(result->rmse, 0, 'g', 4) +
           (unit.isEmpty() ? QString() : QLatin1Char(' ') + unit);
}

QString CompareView::caption_of(const Content& content) const {
    if (content.difference) return number_of(content.slot);
    const QString& label = stage(content.picture).label;
    const QString name = stage_name(content.picture);
    return label.isEmpty() || content.picture == StagePair::reference ? name
                                                                      : name + QStringLiteral("   ") + label;
}

QRect CompareView::caption_rect(int pane) const {
    const QRect above = panes_[pane]->geometry();
    return {above.left(), above.bottom() + 1, above.width(), caption_height()};
}

void CompareView::paint_captions(QPainter& painter) const {
    const auto shown = contents();
    if (!caption_height()) return;
    painter.setFont(font());
    for (int i = 0; i < int(shown.size()); ++i) {
        const QRect place = caption_rect(i);
        const bool chosen =
            !shown[i].difference && (shown[i].picture == pair_.a || shown[i].picture == pair_.b);
        if (chosen) painter.fillRect(place, palette().highlight());
        painter.setPen(palette().color(chosen ? QPalette::HighlightedText : QPalette::WindowText));
        const QString text =
            fontMetrics().elidedText(caption_of(shown[i]), Qt::ElideMiddle, place.width() - 6);
        painter.drawText(place, Qt::AlignCenter, text);
    }
}

int CompareView::stage_at(QPoint point) const {
    const auto shown = contents();
    for (int i = 0; caption_height() && i < int(shown.size()); ++i)
        if (!shown[i].difference && shown[i].picture >= 0 && caption_rect(i).contains(point))
            return shown[i].picture;
    return StagePair::none;
}

QString CompareView::tip_at(QPoint point) const {
    if (stage_at(point) >= 0) return tr("Click two stages to see their difference (1 … 9; 0: none)");
    const auto shown = contents();
    for (int i = 0; caption_height() && i < int(shown.size()); ++i) {
        if (!shown[i].difference || !caption_rect(i).contains(point)) continue;
        const auto [a, b] = ends_of(shown[i].slot);
        if (have_difference(stage(a), stage(b)))
            return tr("Root mean square of the difference over all valid pixels.\n%1")
                .arg(size_rule(stage_name(a), stage(a), stage_name(b), stage(b)))
                .trimmed();
    }
    return {};
}

bool CompareView::on_board_event(QEvent* event) {
    if (event->type() == QEvent::MouseButtonPress) {
        const auto& press = *static_cast<QMouseEvent*>(event);
        const int stage =
            press.button() == Qt::LeftButton ? stage_at(press.position().toPoint()) : StagePair::none;
        if (stage < 0) return false;
        choose_pair(with_chosen(pair_, stage));
        return true;
    }
    if (event->type() == QEvent::ToolTip) {
        const auto& help = *static_cast<QHelpEvent*>(event);
        const QString text = tip_at(help.pos());
        if (text.isEmpty()) return false;
        QToolTip::showText(help.globalPos(), text, board_);
        return true;
    }
    return false;
}

bool CompareView::choose_by_key(const QKeyEvent& event) {
    const bool plain = !(event.modifiers() & ~Qt::KeyboardModifiers(Qt::KeypadModifier));
    const int digit = event.key() - Qt::Key_0;
    if (!has_rows() || count() < 2 || !plain || digit < 0 || digit > 9 || digit > count()) return false;
    if (event.type() == QEvent::KeyPress && !event.isAutoRepeat())
        choose_pair(digit == 0 ? StagePair() : with_chosen(pair_, digit - 1));
    return true;
}

QStringList CompareView::captions() const {
    QStringList all;
    for (const auto& content : contents()) all << caption_of(content);
    return all;
}

void CompareView::update_bar() {
    const bool row = has_rows() && count() >= 2;
    bar_->setVisible(row);
    if (!row) return;
    QStringList labels;
    for (int i = 0; i < count(); ++i) labels << caption_of({i, false, 0});
    bar_->set_stages(labels, has_reference_);
    bar_->set_pair(pair_);
    bar_->set_number(has_pair() ? number_of(pair_slot) : QString());
}

}  // namespace ir::widgets
