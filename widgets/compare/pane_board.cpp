#include "widgets/compare/pane_board.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <utility>

#include "renderers/image/enlarge.h"
#include "widgets/compare/one_size.h"

namespace ir::widgets {
namespace {

constexpr int gap = 3;
constexpr QSize min_pane{170, 130};
constexpr int snapshot_gap = 8;

QPoint scaled(QPointF place, QSize step) {
    return {int(place.x() * step.width()), int(place.y() * step.height())};
}

/// The pixel of this picture that is marked for a picked one of pictures of the size `of`; negative: none.
QPoint picked_in(const Picture& picture, QPoint picked, QSize of) {
    const QSize size = picture.size();
    if (picked.x() < 0 || of.isEmpty() || size.isEmpty() || size == of) return picked;
    const bool alike =
        picture.atlas.tiles.empty() && (is_reduced(size.width(), size.height(), of.width(), of.height()) ||
                                        is_reduced(of.width(), of.height(), size.width(), size.height()));
    return alike ? pixel_at_size(picked, of, size) : QPoint(-1, -1);
}

}  // namespace

PaneBoard::PaneBoard(QWidget* parent, ImageView::Surface surface)
    : QScrollArea(parent), surface_(surface), sheet_(new QWidget) {
    setFrameShape(QFrame::NoFrame);
    setFocusPolicy(Qt::NoFocus);
    setWidgetResizable(true);
    setWidget(sheet_);
    sheet_->installEventFilter(this);
}

ImageView& PaneBoard::pane(int index) {
    while (pane_count() <= index) {
        auto* view = new ImageView(sheet_, surface_);
        const int made = pane_count();
        view->set_tool(tool_);
        view->set_pixel_grid(pixel_grid_);
        view->camera().set_fly_speed(fly_speed_);
        view->set_mark(&Marks::pins, pins_);
        connect(view, &ImageView::cursor_moved, this, [this, made] {
            if (std::exchange(pointed_, made) != made) update_hints();
        });
        connect(view, &ImageView::camera_gesture_finished, this, &PaneBoard::tool_used);
        connect(view, &ImageView::shape_drawn, this, &PaneBoard::tool_used);
        connect(view, &ImageView::picked_changed, this, [this, view, made](QPoint pixel) {
            set_picked(pixel, view->transform().image_size().toSize());
            emit picked_changed(made, pixel);
        });
        connect(view, &ImageView::region_changed, this, [this, view](QRect region) {
            set_region(view->transform().image_size().toSize(), region);
            emit region_changed(region_size_, region);
        });
        connect(view, &ImageView::line_changed, this, [this, view](QLine line) {
            set_line(view->transform().image_size().toSize(), line);
            emit line_changed(line_size_, line);
        });
        connect(view, &ImageView::shape_drawn, this, &PaneBoard::shape_drawn);
        connect(view, &ImageView::tool_changed, this, [this](ImageView::Tool tool) {
            if (tool == tool_) return;
            set_tool(tool);
            emit tool_changed(tool);
        });
        connect(view, &ImageView::light_moved, this, &PaneBoard::light_moved);
        connect(view, &ImageView::light_turned, this, &PaneBoard::light_turned);
        connect(view, &ImageView::light_gesture_finished, this, &PaneBoard::light_gesture_finished);
        connect(view, &ImageView::activated, this, [this, made] {
            active_ = made;
            sheet_->update();
            emit activated(made);
        });
        panes_.push_back(view);
        update_hints();
        emit pane_made(view, made);
    }
    return *panes_[std::size_t(index)];
}

void PaneBoard::arrange(std::vector<Cell> cells, QSize grid, bool captions) {
    cells_ = std::move(cells);
    grid_ = grid;
    captions_ = captions;
    for (std::size_t i = cells_.size(); i < panes_.size(); ++i) {
        panes_[i]->hide();
        panes_[i]->set_picture(nullptr);
    }
    if (active_ >= int(cells_.size())) active_ = 0;
    if (pointed_ >= int(cells_.size())) pointed_ = 0, update_hints();
    place_panes();
    update_marks();
    update_legends();
}

void PaneBoard::set_tool(ImageView::Tool tool) {
    tool_ = tool;
    for (auto* view : panes_) view->set_tool(tool);
}

void PaneBoard::set_hinted(bool on) {
    is_hinted_ = on;
    update_hints();
}

void PaneBoard::update_hints() {
    for (int i = 0; i < pane_count(); ++i) panes_[std::size_t(i)]->set_mark(&Marks::hinted, is_hinted_ && i == pointed_);
}

void PaneBoard::set_pixel_grid(bool on) {
    pixel_grid_ = on;
    for (auto* view : panes_) view->set_pixel_grid(on);
}

void PaneBoard::set_legend(bool on) {
    legend_ = on;
    update_legends();
}

void PaneBoard::set_fly_speed(double metres_per_second) {
    fly_speed_ = metres_per_second;
    for (auto* view : panes_) view->camera().set_fly_speed(metres_per_second);
}

void PaneBoard::set_pins(std::vector<PinMark> pins) {
    pins_ = std::move(pins);
    for (auto* view : panes_) view->set_mark(&Marks::pins, pins_);
}

void PaneBoard::set_picked(QPoint pixel, QSize size) {
    picked_ = pixel;
    picked_size_ = size;
    update_marks();
}

void PaneBoard::set_region(QSize size, const QRect& region) {
    region_size_ = size;
    region_ = region;
    update_marks();
}

void PaneBoard::set_line(QSize size, const QLine& line) {
    line_size_ = size;
    line_ = line;
    update_marks();
}

void PaneBoard::update_marks() {
    for (auto* view : panes_) {
        const auto& picture = view->picture();
        view->set_mark(&Marks::picked, picture ? picked_in(*picture, picked_, picked_size_) : picked_);
        const auto fits = [&](QSize size) { return picture && picture->size() == size; };
        view->set_mark(&Marks::region, fits(region_size_) ? region_ : QRect());
        view->set_mark(&Marks::line, fits(line_size_) ? line_ : QLine());
    }
}

/// In a row the last one speaks for those that are shown alike, which keep its room free, so that all stand
/// alike; a difference alone always says its range.
void PaneBoard::update_legends() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        bool last = true;
        for (std::size_t j = i + 1; j < cells_.size(); ++j)
            last &=
                cells_[i].difference != cells_[j].difference || panes_[i]->display() != panes_[j]->display();
        const bool alone = cells_.size() == 1 && cells_[i].difference;
        panes_[i]->set_legend(alone || (legend_ && last), legend_ && cells_.size() > 1);
    }
}

int PaneBoard::caption_line() const {
    return fontMetrics().height() + 4;
}

int PaneBoard::caption_height() const {
    return captions_ ? caption_line() : 0;
}

QString PaneBoard::missing() const {
    for (std::size_t i = 0; i < cells_.size(); ++i)
        if (const QString& note = panes_[i]->state().note; !note.isEmpty()) return note;
    return {};
}

QStringList PaneBoard::captions() const {
    QStringList captions;
    for (const auto& cell : cells_) captions << cell.caption;
    return captions;
}

QRect PaneBoard::caption_rect(int pane) const {
    const QRect above = panes_[std::size_t(pane)]->geometry();
    return {above.left(), above.bottom() + 1, above.width(), caption_height()};
}

int PaneBoard::caption_at(QPoint point) const {
    for (int i = 0; captions_ && i < int(cells_.size()); ++i)
        if (caption_rect(i).contains(point)) return i;
    return -1;
}

QRect PaneBoard::cell_rect(int pane) const {
    if (cells_.size() == 1) return sheet_->rect();
    // Equal sizes, so that linked views show equal regions; a gap on each side for the active one's frame.
    const QSize step((sheet_->width() - gap) / grid_.width(), (sheet_->height() - gap) / grid_.height());
    return QRect(scaled(cells_[std::size_t(pane)].place, step) + QPoint(gap, gap),
                 step - QSize(gap, gap + caption_height()));
}

QSize PaneBoard::size_in(QSize grid, bool captions) const {
    const QSize room = maximumViewportSize() - QSize(gap, gap);
    const QSize pane = QSize(room.width() / grid.width(), room.height() / grid.height()) -
                       QSize(gap, gap + (captions ? caption_line() : 0));
    return pane.expandedTo(min_pane) == pane ? pane : QSize();
}

void PaneBoard::resizeEvent(QResizeEvent* event) {
    QScrollArea::resizeEvent(event);
    emit resized();
}

void PaneBoard::place_panes() {
    const QSize min = cells_.size() <= 1
                          ? QSize(0, 0)
                          : QSize(grid_.width() * (min_pane.width() + gap) + gap,
                                  grid_.height() * (min_pane.height() + caption_height() + gap) + gap);
    if (sheet_->minimumSize() != min) sheet_->setMinimumSize(min);
    for (int i = 0; i < int(cells_.size()); ++i) {
        panes_[std::size_t(i)]->setGeometry(cell_rect(i));
        panes_[std::size_t(i)]->show();
    }
    sheet_->update();
}

void PaneBoard::paint() {
    QPainter painter(sheet_);
    painter.fillRect(sheet_->rect(), palette().window());
    if (cells_.size() < 2) return;
    painter.fillRect(panes_[std::size_t(active_)]->geometry().adjusted(-2, -2, 2, 2), palette().highlight());
    paint_captions(painter);
}

void PaneBoard::paint_captions(QPainter& painter) const {
    if (!captions_) return;
    painter.setFont(font());
    for (int i = 0; i < int(cells_.size()); ++i) {
        const Cell& cell = cells_[std::size_t(i)];
        const QRect place = caption_rect(i);
        if (cell.chosen) painter.fillRect(place, palette().highlight());
        painter.setPen(palette().color(cell.chosen ? QPalette::HighlightedText : QPalette::WindowText));
        painter.drawText(place, Qt::AlignCenter,
                         fontMetrics().elidedText(cell.caption, Qt::ElideMiddle, place.width() - 6));
    }
}

QImage PaneBoard::snapshot(bool overlays, bool legend, ImageView::SnapshotScale scale) const {
    const bool whole = scale == ImageView::SnapshotScale::picture_pixels;
    std::vector<QImage> shots;
    QSize step;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const bool wanted = legend && (panes_[i]->state().legend || panes_[i]->state().legend_room ||
                                       cells_.size() == 1 || whole);
        shots.push_back(panes_[i]->snapshot(overlays, wanted, scale));
        step = step.expandedTo(shots.back().size() + QSize(snapshot_gap, snapshot_gap));
    }
    if (shots.size() == 1) return shots.front();
    const qreal ratio = devicePixelRatioF();
    const QSize size = whole ? QSize(grid_.width() * step.width() - snapshot_gap,
                                     grid_.height() * step.height() - snapshot_gap)
                             : sheet_->size() * ratio;
    QImage result(size, QImage::Format_RGB32);
    result.fill(palette().window().color());
    QPainter painter(&result);
    for (std::size_t i = 0; i < shots.size(); ++i)
        painter.drawImage(
            whole ? scaled(cells_[i].place, step) : (QPointF(panes_[i]->pos()) * ratio).toPoint(), shots[i]);
    if (!whole && overlays) {
        painter.scale(ratio, ratio);
        paint_captions(painter);
    }
    return result;
}

bool PaneBoard::eventFilter(QObject* watched, QEvent* event) {
    if (watched != sheet_) return QScrollArea::eventFilter(watched, event);
    switch (event->type()) {
        case QEvent::Resize:
            place_panes();
            break;
        case QEvent::Paint:
            paint();
            return true;
        case QEvent::MouseButtonPress: {
            const auto& press = *static_cast<QMouseEvent*>(event);
            const int pane = press.button() == Qt::LeftButton ? caption_at(press.position().toPoint()) : -1;
            if (pane < 0 || !cells_[std::size_t(pane)].clickable) break;
            emit caption_pressed(pane);
            return true;
        }
        case QEvent::ToolTip: {
            const auto& help = *static_cast<QHelpEvent*>(event);
            const int pane = caption_at(help.pos());
            if (pane < 0 || cells_[std::size_t(pane)].tip.isEmpty()) break;
            QToolTip::showText(help.globalPos(), cells_[std::size_t(pane)].tip, sheet_);
            return true;
        }
        default:
            break;
    }
    return QScrollArea::eventFilter(watched, event);
}

}  // namespace ir::widgets
