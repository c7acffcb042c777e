#include <QPainter>
#include <QScrollArea>
#include <QScrollBar>
#include <algorithm>
#include <cmath>

#include "widgets/compare/compare_view.h"

/// Where the panes of a comparison are, on the screen and in a snapshot.
namespace ir::widgets {
namespace {

constexpr int gap = 3;
constexpr QSize least_pane{170, 130};
constexpr int snapshot_gap = 8;

}  // namespace

std::vector<ImageView*> CompareView::views() const {
    std::vector<ImageView*> views;
    const auto shown = contents();
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (!has_rows() || !shown[i].difference) views.push_back(panes_[i]);
    return views;
}

std::vector<ImageView*> CompareView::difference_views() const {
    std::vector<ImageView*> views;
    const auto shown = contents();
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (has_rows() && shown[i].difference) views.push_back(panes_[i]);
    return views;
}

CompareView::Grid CompareView::grid(int panes) const {
    if (has_rows()) return {count() + (has_pair() ? 1 : 0), 2};
    const int columns = panes <= 3 ? std::max(1, panes) : int(std::ceil(std::sqrt(double(panes))));
    return {columns, (panes + columns - 1) / columns};
}

QSize CompareView::least_board() const {
    const int panes = int(contents().size());
    if (panes == 1) return {0, 0};
    const auto [columns, rows] = grid(panes);
    return {columns * (least_pane.width() + gap) + gap,
            rows * (least_pane.height() + caption_height() + gap) + gap};
}

/// Upper left corner of a pane's cell.
QPoint CompareView::corner(int index, QSize step) const {
    const auto shown = contents();
    const int columns = grid(int(shown.size())).columns;
    if (!has_rows()) return {index % columns * step.width(), index / columns * step.height()};
    const Content& content = shown[index];
    const int row = content.difference ? step.height() : 0;
    if (content.slot == pair_slot) return {count() * step.width(), row};
    // Under the two that it is the difference of.
    return {content.picture * step.width() + (content.difference ? step.width() / 2 : 0), row};
}

QRect CompareView::cell(int index, QSize board) const {
    const auto shown = contents();
    if (shown.size() == 1) return QRect(QPoint(0, 0), board);
    const auto [columns, rows] = grid(int(shown.size()));
    // Equal sizes, so that linked views show equal regions; a gap on each side for the active one's frame.
    const QSize step((board.width() - gap) / columns, (board.height() - gap) / rows);
    return QRect(corner(index, step) + QPoint(gap, gap), step - QSize(gap, gap + caption_height()));
}

void CompareView::place() {
    const QSize least = least_board();
    if (board_->minimumSize() != least) board_->setMinimumSize(least);
    const int shown = int(contents().size());
    for (int i = 0; i < shown; ++i) {
        panes_[i]->setGeometry(cell(i, board_->size()));
        panes_[i]->show();
    }
    board_->update();
}

void CompareView::paint_board() {
    QPainter painter(board_);
    painter.fillRect(board_->rect(), palette().window());
    if (contents().size() < 2) return;
    painter.fillRect(panes_[active_pane_]->geometry().adjusted(-2, -2, 2, 2), palette().highlight());
    paint_captions(painter);
}

QImage CompareView::snapshot(bool overlays, bool legend, ImageView::SnapshotScale scale) const {
    const auto shown = contents();
    const bool whole = scale == ImageView::SnapshotScale::picture_pixels;
    const auto shot = [&](int i) {
        const bool wanted = legend && (panes_[i]->state().legend || shown.size() == 1 || whole);
        return panes_[i]->snapshot(overlays, wanted, scale);
    };
    if (shown.size() == 1) return shot(0);
    std::vector<QImage> shots;
    QSize largest;
    for (int i = 0; i < int(shown.size()); ++i) {
        shots.push_back(shot(i));
        largest = largest.expandedTo(shots.back().size());
    }
    const qreal ratio = devicePixelRatioF();
    const auto [columns, rows] = grid(int(shown.size()));
    const QSize board = whole ? QSize(columns * (largest.width() + snapshot_gap) - snapshot_gap,
                                      rows * (largest.height() + snapshot_gap) - snapshot_gap)
                              : board_->size() * ratio;
    QImage result(board, QImage::Format_RGB32);
    result.fill(palette().window().color());
    QPainter painter(&result);
    for (int i = 0; i < int(shown.size()); ++i) {
        const QSize step = largest + QSize(snapshot_gap, snapshot_gap);
        painter.drawImage(whole ? corner(i, step) : (QPointF(panes_[i]->pos()) * ratio).toPoint(), shots[i]);
    }
    if (!whole && overlays) {
        painter.scale(ratio, ratio);
        paint_captions(painter);
    }
    return result;
}

}  // namespace ir::widgets
