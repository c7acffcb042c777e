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
    if (has_rows()) return {count(), 2};
    const int columns = panes <= 3 ? std::max(1, panes) : int(std::ceil(std::sqrt(double(panes))));
    return {columns, (panes + columns - 1) / columns};
}

QSize CompareView::least_board() const {
    const int panes = int(contents().size());
    if (panes == 1) return {0, 0};
    const auto [columns, rows] = grid(panes);
    return {columns * (least_pane.width() + gap) + gap, rows * (least_pane.height() + gap) + gap};
}

QRect CompareView::cell(int index, QSize board) const {
    const auto shown = contents();
    if (shown.size() == 1) return QRect(QPoint(0, 0), board);
    const auto [columns, rows] = grid(int(shown.size()));
    // Equal sizes, so that linked views show equal regions; a gap on each side for the active one's frame.
    const QSize step((board.width() - gap) / columns, (board.height() - gap) / rows);
    const bool below = has_rows() && shown[index].difference;  // under the two that it is the difference of
    const QPoint at = below ? QPoint(shown[index].picture * step.width() + step.width() / 2, step.height())
                            : QPoint(index % columns * step.width(), index / columns * step.height());
    return QRect(at + QPoint(gap, gap), step - QSize(gap, gap));
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
}

QImage CompareView::snapshot(bool overlays, bool legend, ImageView::SnapshotScale scale) const {
    const auto shown = contents();
    const bool whole = scale == ImageView::SnapshotScale::picture_pixels;
    const auto shot = [&](int i) {
        const bool wanted = legend && (panes_[i]->legend() || shown.size() == 1 || whole);
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
        const bool below = has_rows() && shown[i].difference;
        const int column = below ? shown[i].picture : i % columns, row = below ? 1 : i / columns;
        const QPoint whole_at(column * step.width() + (below ? step.width() / 2 : 0), row * step.height());
        painter.drawImage(whole ? whole_at : (QPointF(panes_[i]->pos()) * ratio).toPoint(), shots[i]);
    }
    return result;
}

}  // namespace ir::widgets
