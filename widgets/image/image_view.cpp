#include "widgets/image/image_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "renderers/core/error.h"
#include "widgets/image/arrow_keys.h"
#include "widgets/image/legend.h"
#include "widgets/image/raster_painter.h"
#include "widgets/image/tool_hint.h"

namespace ir::widgets {
namespace {

constexpr double zoom_step = 1.25;
/// Logical pixels that a click may wander.
constexpr double click_slack = 4;

/// Room for a legend beside an exported picture: all that it needs.
constexpr qreal whole_legend = 10000;

void check_sizes(QSize a, QSize b) {
    const auto text = [](QSize size) {
        return std::to_string(size.width()) + "x" + std::to_string(size.height());
    };
    if (a != b)
        throw UsageError("sizes differ: A " + text(a) + ", B " + text(b) + "; render both at one size");
}

}  // namespace

ImageView::ImageView(QWidget* parent, Surface surface)
    : QWidget(parent), region_tool_(state_, *this), line_tool_(state_, *this), light_tool_(state_, *this) {
    canvas_ = surface == Surface::raster ? make_raster_canvas(state_, this) : make_canvas(state_, this);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(canvas_->widget());
    overlay_ = make_overlay(state_, this);
    overlay_->raise();
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(64, 48);  // four side-by-side pairs fit a small screen
    setAccessibleName(tr("Picture"));
    connect(&camera_, &CameraController::moved, this, &ImageView::camera_moved);
    connect(&camera_, &CameraController::finished, this, &ImageView::camera_gesture_finished);
    connect(&camera_, &CameraController::posed, this, [this] {
        state_.camera = camera_.pose();
        if (!state_.light) return;
        if (!state_.light->moves()) state_.light->position = state_.camera.target;
        update_hint();
    });
    connect(&light_tool_, &LightTool::moved, this, &ImageView::light_moved);
    connect(&light_tool_, &LightTool::turned, this, &ImageView::light_turned);
    connect(&light_tool_, &LightTool::finished, this, &ImageView::light_gesture_finished);
    connect(&region_tool_, &RegionTool::changed, this, [this](const QRect& region) {
        set_mark(&Marks::region, region);
        emit region_changed(region);
    });
    connect(&line_tool_, &LineTool::changed, this, [this](const QLine& line) {
        set_mark(&Marks::line, line);
        emit line_changed(line);
    });
    for (const auto* tool : {static_cast<ShapeTool*>(&region_tool_), static_cast<ShapeTool*>(&line_tool_)})
        connect(tool, &ShapeTool::finished, this, &ImageView::shape_drawn);
    update_cursor_shape();
}

void ImageView::repaint_all() {
    const double before = state_.transform.zoom();
    state_.transform.set_margins(legend_place(state_, devicePixelRatioF()).margins);
    if (state_.transform.zoom() != before) emit zoom_changed(state_.transform.zoom());
    canvas_->state_changed();
    overlay_->update();
}

void ImageView::set_picture(std::shared_ptr<const Picture> picture) {
    const QSizeF size = picture ? QSizeF(picture->size().expandedTo({0, 0})) : QSizeF(0, 0);
    auto& second = state_.pictures[1];
    if (second.picture && QSizeF(second.picture->size()) != size) {
        const auto kept = second.display;
        second = {};
        second.display = kept;
    }
    state_.pictures[0] = cache_.prepare(std::move(picture), display_);
    const auto& shown = state_.pictures[0].picture;
    state_.note = shown && !shown->has_image() ? shown->note : QString();
    state_.stale = stale_ || (shown && shown->stale);
    if (state_.has_image()) {
        const double before = state_.transform.zoom();
        state_.transform.set_image_size(size);
        if (state_.transform.zoom() != before) emit zoom_changed(state_.transform.zoom());
    }
    update_hint();
}

void ImageView::set_second(std::shared_ptr<const Picture> picture, const Display& display, bool has_lens) {
    if (picture && picture->has_image()) check_sizes(state_.transform.image_size().toSize(), picture->size());
    state_.has_lens = has_lens && picture;
    state_.pictures[1] = cache_.prepare(std::move(picture), display);
    repaint_all();
}

void ImageView::set_display(const Display& display) {
    if (display == display_) return;
    display_ = display;
    state_.pictures[0] = cache_.prepare(state_.pictures[0].picture, display_);
    repaint_all();
}

void ImageView::set_labels(const QString& label, const QString& second) {
    if (label == state_.label && second == state_.second_label) return;
    state_.label = label;
    state_.second_label = second;
    repaint_all();
}

void ImageView::set_wipe(double fraction) {
    state_.wipe = std::clamp(fraction, 0.0, 1.0);
    repaint_all();
}

void ImageView::set_legend(bool on, bool has_room) {
    std::tie(state_.legend, state_.legend_room) = std::pair(on, has_room);
    repaint_all();
}

void ImageView::set_stale(bool stale) {
    stale_ = stale;
    state_.stale = stale_ || (picture() && picture()->stale);
    repaint_all();
}

void ImageView::set_light(std::optional<PlacedLight> light) {
    if (light && !light->moves()) light->position = state_.camera.target;
    if (light == state_.light) return;
    state_.light = light;
    if (!light) state_.light_handle = LightHandle::none;
    setAccessibleDescription(
        light ? tr("%1 has handles here. Arrows move it, Alt and arrows turn it.").arg(light->name)
              : QString());
    update_hint();
    update_cursor_shape();
}

void ImageView::follow(const ViewTransform& transform) {
    if (transform.is_fitted())
        state_.transform.fit();
    else
        state_.transform.look_at(transform.centre(), transform.zoom());
    repaint_all();
}

const Image& ImageView::image() const {
    static const Image none;
    return state_.has_image() ? *picture()->image : none;
}

QImage ImageView::snapshot(bool overlays, bool legend, SnapshotScale scale) const {
    CanvasState drawn = state_;
    drawn.hint.clear();
    drawn.marks.cursor = {-1, -1};
    drawn.region_edited = drawn.line_edited = drawn.stale = false;
    drawn.light.reset();
    drawn.legend = legend && (state_.legend || !state_.legend_room);
    drawn.legend_room &= legend;
    qreal ratio = devicePixelRatioF();
    drawn.transform.set_margins(legend_place(drawn, ratio).margins);
    QSize size = state_.transform.view_size().toSize();
    qreal beside = 0;  // where the legend goes when the whole picture is exported
    if (scale == SnapshotScale::picture_pixels && state_.has_image()) {
        ratio = 1;
        size = state_.transform.image_size().toSize();
        drawn.legend = drawn.legend_room = false;
        drawn.transform.set_margins({0, 0});
        drawn.transform.set_view_size(size);
        drawn.transform.fit();
        if (legend) beside = legend_size(state_.pictures[0], ratio, whole_legend).width() + 16;
    }
    const qreal height = beside > 0 ? legend_size(state_.pictures[0], ratio, whole_legend).height() + 16 : 0;
    QImage image(size.width() + int(beside), std::max(size.height(), int(height)), QImage::Format_RGB32);
    image.fill(surround_colour);
    QPainter painter(&image);
    painter.setFont(font());
    RasterPainter().paint(painter, drawn, ratio);
    if (overlays || legend) {
        if (!overlays) {  // the legend (and a reason for having no picture) alone
            drawn.label = drawn.second_label = QString();
            drawn.marks = {};
            drawn.pixel_grid = false;
        }
        paint_overlay(painter, drawn, ratio);
    }
    if (beside > 0)
        paint_legend(painter, state_.pictures[0], QPointF(size.width() + 8, 8), ratio, whole_legend);
    return image;
}

void ImageView::set_tool(Tool tool) {
    if (tool == tool_) return;
    camera_.finish();
    tool_ = tool;
    update_hint();
    update_cursor_shape();
    emit tool_changed(tool);
}

QString ImageView::hint() const {
    const QString told = tool_hint(tool_, state_, size());
    return told.isEmpty() ? light_tool_.hint() : told;
}

void ImageView::update_hint() {
    state_.hint = hint();
    state_.region_edited = tool_ == Tool::rectangle;
    state_.line_edited = tool_ == Tool::line;
    repaint_all();
}

void ImageView::update_cursor_shape() {
    if (drag_ == Drag::wipe || (drag_ == Drag::none && !space_ && over_divider_))
        setCursor(Qt::SplitHCursor);
    else if (drag_ == Drag::light || (drag_ == Drag::none && !space_ && light_tool_.is_over_handle()))
        setCursor(Qt::SizeAllCursor);
    else if (drag_ == Drag::pan || space_)
        setCursor(drag_ == Drag::pan ? Qt::ClosedHandCursor : Qt::OpenHandCursor);
    else if (auto* shape = shape_tool())
        setCursor(shape->cursor());
    else
        setCursor(tool_ == Tool::inspect ? Qt::CrossCursor : Qt::SizeAllCursor);
}

void ImageView::finish_transform() {
    repaint_all();
    emit zoom_changed(state_.transform.zoom());
    emit transform_changed(state_.transform);
}

void ImageView::fit() {
    state_.transform.fit();
    finish_transform();
}

void ImageView::actual_pixels() {
    look_at(state_.transform.centre(), 1);
}

void ImageView::look_at(QPointF image_px, double zoom) {
    state_.transform.look_at(image_px, zoom);
    finish_transform();
}

void ImageView::zoom(int steps) {
    look_at(state_.transform.centre(), state_.transform.zoom() * std::pow(zoom_step, steps));
}

void ImageView::set_pixel_grid(bool on) {
    state_.pixel_grid = on;
    repaint_all();
}

QPoint ImageView::pixel_at(QPointF logical) const {
    const QPointF at = state_.transform.image_from_view(device(logical));
    const QPoint pixel(int(std::floor(at.x())), int(std::floor(at.y())));
    const QRect picture(QPoint(0, 0), state_.transform.image_size().toSize());
    return state_.has_image() && picture.contains(pixel) ? pixel : QPoint(-1, -1);
}

void ImageView::resizeEvent(QResizeEvent*) {
    overlay_->setGeometry(rect());
    state_.transform.set_view_size(QSizeF(size()) * devicePixelRatioF());
    update_hint();
    emit zoom_changed(state_.transform.zoom());
}

void ImageView::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::ParentChange || event->type() == QEvent::ScreenChangeInternal)
        state_.transform.set_view_size(QSizeF(size()) * devicePixelRatioF());
}

ShapeTool* ImageView::shape_tool() {
    if (tool_ == Tool::rectangle) return &region_tool_;
    return tool_ == Tool::line ? &line_tool_ : nullptr;
}

ImageView::Drag ImageView::drag_for(const QMouseEvent& event) {
    if (event.button() == Qt::MiddleButton || (event.button() == Qt::LeftButton && space_)) return Drag::pan;
    if (event.button() == Qt::LeftButton && light_tool_.is_over_handle()) return Drag::light;
    if (event.button() == Qt::LeftButton && is_over_divider(event.position())) return Drag::wipe;
    if (shape_tool() && event.button() == Qt::LeftButton) return state_.has_image() ? Drag::shape : Drag::pan;
    if (!moves_camera())
        return event.button() == Qt::LeftButton    ? Drag::pick
               : event.button() == Qt::RightButton ? Drag::pan
                                                   : Drag::none;
    const bool slides = event.button() == Qt::RightButton || event.modifiers() & Qt::ShiftModifier;
    camera_.begin_drag(slides                 ? CameraController::Drag::slide
                       : tool_ == Tool::orbit ? CameraController::Drag::orbit
                                              : CameraController::Drag::look);
    return Drag::camera;
}

void ImageView::mousePressEvent(QMouseEvent* event) {
    if (drag_ != Drag::none) return;
    light_tool_.hover(event->position());
    drag_ = drag_for(*event);
    last_position_ = press_position_ = event->position();
    if (drag_ == Drag::shape) shape_tool()->press(event->position());
    if (drag_ == Drag::light) light_tool_.press(event->position());
    update_cursor_shape();
}

void ImageView::mouseMoveEvent(QMouseEvent* event) {
    const QPointF delta = event->position() - last_position_;
    last_position_ = event->position();
    // A press that wanders off is no pick but a pan.
    if (drag_ == Drag::pick && !is_click(event->position())) drag_ = Drag::pan;
    const QPointF at = state_.transform.image_from_view(device(event->position()));
    const QSizeF size = state_.transform.image_size();
    if (state_.has_lens) state_.lens = {at.x() / size.width(), at.y() / size.height()}, repaint_all();
    if (drag_ == Drag::wipe) {
        move_wipe(at.x() / size.width());
    } else if (drag_ == Drag::pan) {
        state_.transform.pan(device(delta));
        finish_transform();
    } else if (drag_ == Drag::shape) {
        if (auto* shape = shape_tool()) shape->drag(event->position(), event->modifiers());
    } else if (drag_ == Drag::light) {
        light_tool_.drag(event->position());
    } else if (drag_ == Drag::camera) {
        camera_.drag(delta, height(), size.height() * state_.transform.zoom() / devicePixelRatioF());
    }
    if (drag_ == Drag::none && light_tool_.hover(event->position())) {
        update_hint();
        update_cursor_shape();
    }
    const bool over = is_over_divider(event->position());
    if (over != over_divider_) {
        over_divider_ = over;
        update_cursor_shape();
    }
    if (auto* shape = shape_tool(); shape && drag_ == Drag::none) {
        shape->hover(event->position());
        update_cursor_shape();
    }
    emit cursor_moved(pixel_at(event->position()));
}

bool ImageView::event(QEvent* event) {
    // Escape clears a shape, or takes a light back, before it is the window's key.
    if (event->type() == QEvent::ShortcutOverride) {
        const auto& key = *static_cast<QKeyEvent*>(event);
        if ((shape_tool() && shape_tool()->takes(key)) || takes_light_key(key)) {
            event->accept();
            return true;
        }
    }
    return QWidget::event(event);
}

void ImageView::move_wipe(double fraction) {
    const double before = state_.wipe;
    set_wipe(fraction);
    if (state_.wipe != before) emit wipe_moved(state_.wipe);
}

void ImageView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton && is_over_divider(event->position())) return move_wipe(0.5);
    mousePressEvent(event);
}

bool ImageView::is_click(QPointF logical) const {
    return (logical - press_position_).manhattanLength() <= click_slack;
}

void ImageView::pick(QPointF logical) {
    set_mark(&Marks::picked, pixel_at(logical));
    emit picked_changed(state_.marks.picked);
}

void ImageView::mouseReleaseEvent(QMouseEvent* event) {
    if (drag_ == Drag::pick) {
        pick(event->position());
        const QPoint picked = state_.marks.picked;
        if (event->modifiers() == Qt::ShiftModifier && picked.x() >= 0) emit explain_wanted(picked);
    }
    region_tool_.release();
    line_tool_.release();
    light_tool_.release();
    if (std::exchange(drag_, Drag::none) == Drag::camera) camera_.finish();
    update_cursor_shape();
    if (event->button() != Qt::RightButton || !is_click(event->position())) return;
    pick(event->position());
    emit menu_wanted(event->globalPosition().toPoint());
}

void ImageView::contextMenuEvent(QContextMenuEvent* event) {
    // The mouse asks by a click, because its right button drags, too.
    if (event->reason() == QContextMenuEvent::Keyboard) emit menu_wanted(mapToGlobal(rect().center()));
}

void ImageView::wheelEvent(QWheelEvent* event) {
    const double steps = event->angleDelta().y() / 120.0;
    if (steps == 0) return;
    if (event->modifiers() & Qt::ControlModifier && moves_camera()) {
        camera_.move_to(dollied(camera_.pose(), std::pow(1.1, -steps)));
        camera_.settle();
    } else {
        state_.transform.zoom_about(device(event->position()),
                                    state_.transform.zoom() * std::pow(zoom_step, steps));
        finish_transform();
        emit cursor_moved(pixel_at(event->position()));
    }
    event->accept();
}

/// The divider has the arrows before a light, a shape before both.
bool ImageView::takes_light_key(const QKeyEvent& event) const {
    const bool moves_divider =
        state_.has_divider() && (event.key() == Qt::Key_Left || event.key() == Qt::Key_Right);
    return light_tool_.takes(event) && !moves_divider;
}

void ImageView::keyPressEvent(QKeyEvent* event) {
    if (light_tool_.is_dragging() && takes_light_key(*event)) return light_tool_.press_key(*event);
    if (event->key() == Qt::Key_Space) {
        space_ = true;
        return update_cursor_shape();
    }
    if (tool_ == Tool::fly && CameraController::is_fly_key(event->key()) &&
        !(event->modifiers() & Qt::ControlModifier))
        return camera_.press_key(*event);
    if (auto* shape = shape_tool(); shape && shape->takes(*event)) return shape->press_key(*event);
    const QPointF way =
        QPointF(arrow_of(event->key())) * (event->modifiers() & Qt::ShiftModifier ? 0.1 : 0.01);
    if (state_.has_divider() && way.x() != 0) return move_wipe(state_.wipe + way.x());
    if (takes_light_key(*event)) return light_tool_.press_key(*event);
    if (state_.has_lens && !way.isNull()) {
        emit cursor_moved(state_.move_lens(way));
        return repaint_all();
    }
    QWidget::keyPressEvent(event);
}

void ImageView::keyReleaseEvent(QKeyEvent* event) {
    if (event->isAutoRepeat()) return;
    light_tool_.finish_keys();
    if (event->key() == Qt::Key_Space) {
        space_ = false;
        update_cursor_shape();
    }
    if (!camera_.holds_key(event->key())) return QWidget::keyReleaseEvent(event);
    if (camera_.release_key(*event)) camera_.settle();
}

void ImageView::leaveEvent(QEvent*) {
    if (drag_ == Drag::none && light_tool_.hover({-1e6, -1e6})) update_hint();
    emit cursor_moved({-1, -1});
}

void ImageView::focusInEvent(QFocusEvent* event) {
    QWidget::focusInEvent(event);
    emit activated();
}

void ImageView::focusOutEvent(QFocusEvent* event) {
    QWidget::focusOutEvent(event);
    camera_.drop_keys();
    light_tool_.finish_keys();
    space_ = false;
    update_cursor_shape();
    if (drag_ == Drag::none) camera_.finish();
}

}  // namespace ir::widgets
