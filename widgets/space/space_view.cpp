#include "widgets/space/space_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "widgets/space/picture_pacer.h"
#include "widgets/space/space_camera.h"
#include "widgets/space/space_tools.h"

namespace ir::widgets {
namespace {

/// Pictures that take longer are drawn in half or a quarter of their size while the camera moves.
constexpr double slow_ms = 120, very_slow_ms = 600;
/// After so long without another one, a picture is drawn once more with smooth edges.
constexpr int still_ms = 300;
constexpr int still_oversampling = 2;
/// Elements are picked up to so far from the cursor, logical pixels.
constexpr double pick_reach = 3;
/// A press that moves further is a drag, not a click; logical pixels.
constexpr double click_reach = 4;
constexpr double wheel_step = 1.15;
/// Seconds to fly through the whole scene.
constexpr double crossing_seconds = 8;

/// Keys that the view takes for itself, without Ctrl and Alt.
bool is_own_key(int key) {
    return CameraController::is_fly_key(key) || key == Qt::Key_F || key == Qt::Key_Home;
}

}  // namespace

SpaceView::SpaceView(QWidget* parent, ImageView::Surface surface)
    : QWidget(parent), sphere_pose_(widgets::sphere_pose()) {
    tools_ = new SpaceTools(this);
    image_ = new ImageView(this, surface);
    image_->setAttribute(Qt::WA_TransparentForMouseEvents);
    image_->setFocusPolicy(Qt::NoFocus);
    image_->setMouseTracking(false);
    image_->set_pixel_grid(false);
    overlay_widget_ = make_space_overlay(overlay_, this);
    pacer_ = new PicturePacer(PicturePacer::patience_ms, this);
    pacer_->set_held(true);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(tools_);
    column->addWidget(image_, 1);
    overlay_widget_->raise();
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("3D view"));
    connect(&hand_, &CameraController::moved, this, &SpaceView::move_camera);
    connect(&hand_, &CameraController::finished, this, &SpaceView::finish_gesture);
    connect(tools_, &SpaceTools::experiment_camera_wanted, this, &SpaceView::use_experiment_camera);
    connect(tools_, &SpaceTools::free_camera_wanted, this, &SpaceView::use_free_camera);
    connect(tools_, &SpaceTools::frame_wanted, this, &SpaceView::frame_all);
    const auto toggles = [this](bool SpaceScene::*member) {
        return [this, member](bool on) {
            scene_.*member = on;
            scene_updated();
            emit scene_changed(scene_);
        };
    };
    connect(tools_, &SpaceTools::scene_toggled, this, toggles(&SpaceScene::show_scene));
    connect(tools_, &SpaceTools::centres_toggled, this, toggles(&SpaceScene::show_centres));
    refine_timer_.setInterval(still_ms);
    refine_timer_.setSingleShot(true);
    connect(&refine_timer_, &QTimer::timeout, this, [this] {
        if (hand_.is_moving() || picture_.colour.empty()) return;
        refine_ = true;
        pacer_->want();
    });
    connect(pacer_, &PicturePacer::due, this, &SpaceView::send_request);
    connect(pacer_, &PicturePacer::late, this,
            [this] { set_busy(!hand_.is_moving() && oversampling_ == 1); });
    tools_->show_state(scene_, shows_own_space());
}

/// Told by the fields of what was drawn last.
bool SpaceView::shows_own_space() const {
    return std::any_of(picture_.layers.begin(), picture_.layers.end(), [](const LayerInfo& info) {
        return space_of(info.requested.kind, info.fields) == Space::own && info.note.empty();
    });
}

void SpaceView::scene_updated() {
    tools_->show_state(scene_, shows_own_space());
    want_picture();
    update_overlay();
}

void SpaceView::refine_later() {
    // Finer screens need no smoother edges.
    if (oversampling_ == 1 && devicePixelRatioF() < 1.5) refine_timer_.start();
}

void SpaceView::want_picture() {
    refine_ = false;
    refine_timer_.stop();
    pacer_->want();
}

void SpaceView::set_scene(const SpaceScene& scene) {
    if (scene == scene_) return;
    scene_ = scene;
    scene_updated();
}

void SpaceView::set_layers(const std::vector<SpaceLayer>& layers) {
    if (layers == scene_.layers) return;
    scene_.layers = layers;
    scene_updated();
}

void SpaceView::refresh() {
    want_picture();
}

QRect SpaceView::picture_area() const {
    return image_->geometry();
}

QSize SpaceView::wanted_size() const {
    const QSizeF size = QSizeF(image_->size()) * devicePixelRatioF();
    return {std::max(1, int(std::lround(size.width()))), std::max(1, int(std::lround(size.height())))};
}

void SpaceView::send_request() {
    divisor_ = hand_.is_moving() ? moving_divisor_ : 1;
    oversampling_ = refine_ ? still_oversampling : 1;
    sent_ = scene_;
    const QSize size = wanted_size();
    if (shows_sphere(scene_)) {
        const auto shown = std::count_if(scene_.layers.begin(), scene_.layers.end(),
                                         [](const SpaceLayer& layer) { return layer.visible; });
        const QSizeF area = image_->size();
        sent_.camera = fitted_below(sphere_pose_, double(size.width()) / size.height(),
                                    legend_strip(std::size_t(shown), area) / std::max(1.0, area.height()));
    }
    for (SpaceLayer& layer : sent_.layers)
        layer.size_px = float(layer.size_px * devicePixelRatioF() / divisor_);
    emit view_wanted(sent_, {std::max(1, size.width() / divisor_), std::max(1, size.height() / divisor_)},
                     oversampling_);
}

void SpaceView::set_picture(SpacePicture picture) {
    pacer_->answered();
    // Half the size is a little more than a quarter of the time.
    const double full_ms = double(pacer_->last_ms()) * std::pow(divisor_, 1.8);
    if (oversampling_ == 1) moving_divisor_ = full_ms > very_slow_ms ? 4 : full_ms > slow_ms ? 2 : 1;
    picture_ = std::move(picture);
    const SpaceScene& requested = picture_.scene ? *picture_.scene : sent_;
    const std::vector<int> places = scene_indices(picture_.layers, requested.layers);
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i] >= 0) picture_.layers[i].requested = requested.layers[std::size_t(places[i])];
    if (!requested.camera) experiment_pose_ = picture_.camera;
    overlay_.note.clear();
    tools_->show_state(scene_, shows_own_space());
    image_->set_picture(make_picture(picture_.colour, Semantic::radiance));
    image_->fit();
    if (pacer_->is_idle()) {
        set_busy(false);
        if (!hand_.is_moving()) refine_later();
    }
    update_overlay();
    update_hover();
    emit picture_shown(picture_.layers);
}

void SpaceView::set_note(const QString& note) {
    pacer_->answered();
    set_busy(false);
    overlay_.note = note;
    if (picture_.colour.empty()) image_->set_picture(make_note(note));
    update_overlay();
}

void SpaceView::set_stale(bool stale) {
    if (overlay_.stale == stale) return;
    overlay_.stale = stale;
    overlay_widget_->update();
}

void SpaceView::clear(const QString& note) {
    picture_ = {};
    experiment_pose_.reset();
    hovered_ = {};
    set_note(note);
    update_hover();
}

void SpaceView::set_marks(SpaceMarks marks) {
    if (marks == overlay_.marks) return;
    overlay_.marks = std::move(marks);
    overlay_widget_->update();
}

void SpaceView::set_bounds(const SpaceBox& bounds) {
    bounds_ = bounds;
    hand_.set_fly_speed(glm::length(bounds.high - bounds.low) / crossing_seconds);
}

void SpaceView::set_selectors(const std::vector<SpaceSelector>& selectors) {
    selectors_ = selectors;
    update_hover();
}

void SpaceView::set_hover_values(const QString& values) {
    if (values == hover_values_) return;
    hover_values_ = values;
    update_hover_text();
}

void SpaceView::set_busy(bool busy) {
    if (overlay_.busy == busy) return;
    overlay_.busy = busy;
    overlay_widget_->update();
}

void SpaceView::update_overlay() {
    indices_ = scene_indices(picture_.layers, scene_.layers);
    overlay_.layers.clear();
    for (std::size_t i = 0; i < picture_.layers.size(); ++i)
        if (indices_[i] >= 0) overlay_.layers.push_back(picture_.layers[i]);
    overlay_.camera = picture_.camera;
    overlay_.moment = picture_.moment;
    overlay_.has_picture = !picture_.colour.empty();
    overlay_widget_->update();
}

CameraPose SpaceView::pose() const {
    if (shows_sphere(scene_)) return sphere_pose_;
    return scene_.camera ? *scene_.camera : experiment_pose_.value_or(CameraPose{});
}

SpaceElement SpaceView::element_at(QPointF position) const {
    const double ratio = devicePixelRatioF();
    const ViewTransform& transform = image_->transform();
    const QPointF at = transform.image_from_view((position - QPointF(picture_area().topLeft())) * ratio);
    return element_near(picture_, indices_, {int(std::floor(at.x())), int(std::floor(at.y()))},
                        int(std::ceil(pick_reach * ratio / transform.zoom())));
}

QImage SpaceView::snapshot(bool overlays) const {
    const double ratio = devicePixelRatioF();
    QImage shot(wanted_size(), QImage::Format_RGB32);
    shot.fill(surround_colour);
    QPainter painter(&shot);
    if (!picture_.colour.empty()) {
        const ViewTransform& t = image_->transform();
        painter.drawImage(QRectF(t.offset(), t.image_size() * t.zoom()),
                          to_qimage(picture_.colour, image_->display()));
    }
    painter.scale(ratio, ratio);
    painter.setFont(font());
    OverlayState state = overlay_;
    state.hover.clear();  // what passes is no part of it
    state.busy = false;
    if (overlays) paint_space_overlay(painter, state, QRectF({0, 0}, QSizeF(image_->size())));
    return shot;
}

void SpaceView::use_experiment_camera() {
    if (shows_sphere(scene_)) {
        sphere_pose_ = widgets::sphere_pose();
        return scene_updated();
    }
    if (!is_free()) return tools_->show_state(scene_, shows_own_space());
    scene_.camera.reset();
    scene_updated();
    emit scene_changed(scene_);
}

void SpaceView::use_free_camera() {
    if (is_free() || !can_move()) return tools_->show_state(scene_, shows_own_space());
    scene_.camera = pose();
    scene_updated();
    emit scene_changed(scene_);
}

void SpaceView::frame_all() {
    if (!can_move()) return;
    CameraPose framed_pose = pose();
    if (shows_sphere(scene_)) {
        framed_pose.eye *= glm::length(widgets::sphere_pose().eye) / glm::length(framed_pose.eye);
    } else if (shows_own_space()) {
        return use_experiment_camera();
    } else {
        const double aspect = double(image_->width()) / std::max(1, image_->height());
        framed_pose = framed(framed_pose, bounds_of(picture_.layers).value_or(bounds_), aspect);
    }
    hand().move_to(framed_pose);
    hand_.finish();
}

bool SpaceView::event(QEvent* event) {
    // The window may have shortcuts of one letter: where the camera flies they wait.
    if (event->type() == QEvent::ShortcutOverride) {
        const auto* key = static_cast<QKeyEvent*>(event);
        if (is_own_key(key->key()) && !(key->modifiers() & (Qt::ControlModifier | Qt::AltModifier))) {
            event->accept();
            return true;
        }
    }
    return QWidget::event(event);
}

void SpaceView::resizeEvent(QResizeEvent*) {
    // The layout places the picture after this event.
    QMetaObject::invokeMethod(
        this,
        [this] {
            overlay_widget_->setGeometry(picture_area());
            overlay_widget_->raise();
        },
        Qt::QueuedConnection);
    overlay_widget_->setGeometry(picture_area());
    want_picture();
}

void SpaceView::showEvent(QShowEvent*) {
    pacer_->set_held(false);
}

void SpaceView::hideEvent(QHideEvent*) {
    pacer_->set_held(true);
}

void SpaceView::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    // Another screen may have another scale.
    if (event->type() == QEvent::ParentChange || event->type() == QEvent::ScreenChangeInternal) {
        if (pacer_ && wanted_size() != QSize(picture_.colour.width, picture_.colour.height)) want_picture();
    }
}

bool SpaceView::can_move() const {
    return is_free() || experiment_pose_ || shows_sphere(scene_);
}

CameraController& SpaceView::hand() {
    hand_.set_pose(pose());
    return hand_;
}

CameraController::Drag SpaceView::drag_for(const QMouseEvent& event) const {
    if (shows_sphere(scene_)) return CameraController::Drag::orbit;
    if (event.button() != Qt::LeftButton || event.modifiers() & Qt::ShiftModifier)
        return CameraController::Drag::slide;
    return event.modifiers() & Qt::ControlModifier ? CameraController::Drag::look
                                                   : CameraController::Drag::orbit;
}

void SpaceView::mousePressEvent(QMouseEvent* event) {
    if (drag_ != Drag::none || !picture_area().contains(event->position().toPoint())) return;
    setFocus(Qt::MouseFocusReason);
    last_position_ = press_position_ = event->position();
    if (shows_sphere(scene_) && event->button() != Qt::LeftButton) return;
    const auto drag = drag_for(*event);
    hand_.begin_drag(drag);
    drag_ = drag == CameraController::Drag::orbit ? Drag::press : Drag::camera;
}

void SpaceView::mouseMoveEvent(QMouseEvent* event) {
    const QPointF delta = event->position() - last_position_;
    if (drag_ == Drag::press && (event->position() - press_position_).manhattanLength() > click_reach)
        drag_ = Drag::camera;
    last_position_ = event->position();
    cursor_inside_ = picture_area().contains(event->position().toPoint());
    if (drag_ != Drag::camera) return update_hover();
    const double height = picture_area().height();
    if (can_move()) hand().drag(delta, height, height);
}

void SpaceView::mouseReleaseEvent(QMouseEvent* event) {
    const Drag drag = std::exchange(drag_, Drag::none);
    last_position_ = event->position();
    if (drag == Drag::press) {
        const SpaceElement element = element_at(event->position());
        emit element_clicked(element.layer, element.element);
    } else if (drag == Drag::camera) {
        hand_.finish();
    }
    update_hover();
}

void SpaceView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton && picture_area().contains(event->position().toPoint()))
        frame_all();
}

void SpaceView::wheelEvent(QWheelEvent* event) {
    const double steps = event->angleDelta().y() / 120.0;
    event->accept();
    if (steps == 0 || !can_move()) return;
    const double factor = std::pow(wheel_step, -steps);
    const QRectF area = picture_area();
    const QPointF from_middle = event->position() - area.center();
    const QPointF at(from_middle.x() / std::max(1.0, area.height()),
                     -from_middle.y() / std::max(1.0, area.height()));
    hand().move_to(shows_sphere(scene_) ? sphere_dollied(pose(), factor)
                                        : dollied_towards(pose(), at, factor));
    hand_.settle();
}

void SpaceView::keyPressEvent(QKeyEvent* event) {
    const bool plain = !(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier));
    if (event->key() == Qt::Key_Home) return use_experiment_camera();
    if (event->key() == Qt::Key_F && plain) return frame_all();
    if (!CameraController::is_fly_key(event->key()) || !plain || !can_move() || shows_sphere(scene_))
        return QWidget::keyPressEvent(event);
    hand().press_key(*event);
}

void SpaceView::keyReleaseEvent(QKeyEvent* event) {
    if (event->isAutoRepeat() || !hand_.holds_key(event->key())) return QWidget::keyReleaseEvent(event);
    if (hand().release_key(*event)) hand_.finish();
}

void SpaceView::move_camera(const CameraPose& pose) {
    if (shows_sphere(scene_))
        sphere_pose_ = pose;
    else
        scene_.camera = pose;
    hovered_ = {};
    overlay_.hover.clear();
    scene_updated();
}

void SpaceView::finish_gesture() {
    if (divisor_ > 1)
        want_picture();  // the last picture was a coarse one
    else if (pacer_->is_idle())
        refine_later();
    emit scene_changed(scene_);
}

void SpaceView::update_hover() {
    const bool still = cursor_inside_ && drag_ == Drag::none;
    const SpaceElement element = still ? element_at(last_position_) : SpaceElement{};
    overlay_.hover_at = last_position_ - QPointF(picture_area().topLeft());
    if (!(element == hovered_)) {
        hovered_ = element;
        hover_values_.clear();
        setCursor(element.layer >= 0 ? Qt::PointingHandCursor : Qt::ArrowCursor);
        emit element_hovered(element.layer, element.element);
    }
    update_hover_text();
}

void SpaceView::update_hover_text() {
    overlay_.hover = element_text(scene_, picture_.layers, selectors_, hovered_, hover_values_);
    overlay_widget_->update();
}

void SpaceView::leaveEvent(QEvent*) {
    cursor_inside_ = false;
    update_hover();
}

void SpaceView::focusOutEvent(QFocusEvent* event) {
    QWidget::focusOutEvent(event);
    hand_.drop_keys();
    if (drag_ == Drag::none) hand_.finish();
}

}  // namespace ir::widgets
