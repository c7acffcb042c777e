#include "widgets/space/space_view.h"

#include <QAction>
#include <QActionGroup>
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "widgets/space/picture_pacer.h"
#include "widgets/space/space_camera.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

/// Pictures that take longer are drawn in half or a quarter of their size while the camera moves.
constexpr double slow_ms = 120, very_slow_ms = 600;
/// After so long without another one, a picture is drawn once more with smooth edges.
constexpr int still_ms = 300;
constexpr int still_oversampling = 2;
/// Elements are picked up to so far from the cursor, logical pixels.
constexpr double pick_reach = 3;

}  // namespace

SpaceView::SpaceView(QWidget* parent, ImageView::Surface surface)
    : QWidget(parent), sphere_pose_(widgets::sphere_pose()) {
    tools_ = new QToolBar(this);
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
    make_tools();
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("3D view"));
    fly_timer_.setInterval(16);
    settle_timer_.setInterval(350);
    settle_timer_.setSingleShot(true);
    connect(&fly_timer_, &QTimer::timeout, this, &SpaceView::fly_step);
    connect(&settle_timer_, &QTimer::timeout, this, &SpaceView::finish_gesture);
    refine_timer_.setInterval(still_ms);
    refine_timer_.setSingleShot(true);
    connect(&refine_timer_, &QTimer::timeout, this, [this] {
        if (gesture_ || picture_.colour.empty()) return;
        refine_ = true;
        pacer_->want();
    });
    connect(pacer_, &PicturePacer::due, this, &SpaceView::send_request);
    connect(pacer_, &PicturePacer::late, this, [this] { set_busy(!gesture_ && oversampling_ == 1); });
    update_tools();
}

void SpaceView::make_tools() {
    tools_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    tools_->setIconSize({16, 16});
    const auto add = [&](const QString& text, const char* name, bool checkable) {
        auto* action = tools_->addAction(text);
        action->setObjectName(QLatin1String(name));
        action->setCheckable(checkable);
        return action;
    };
    experiment_camera_ = add(tr("Experiment's camera"), "experiment_camera", true);
    free_camera_ = add(tr("Free camera"), "free_camera", true);
    auto* group = new QActionGroup(this);
    group->addAction(experiment_camera_);
    group->addAction(free_camera_);
    tools_->addSeparator();
    frame_ = add(tr("Frame"), "frame", false);
    frame_->setIcon(icon("fit"));
    frame_->setToolTip(tr("Show everything (F, or a double click)"));
    show_scene_ = add(tr("Scene"), "show_scene", true);
    show_scene_->setToolTip(tr("Draw the scene, flat shaded, behind the layers"));
    show_centres_ = add(tr("Centres"), "show_centres", true);
    show_centres_->setToolTip(tr("Mark the centres of the sphere's regions"));
    connect(experiment_camera_, &QAction::triggered, this, &SpaceView::use_experiment_camera);
    connect(free_camera_, &QAction::triggered, this, &SpaceView::use_free_camera);
    connect(frame_, &QAction::triggered, this, &SpaceView::frame_all);
    const auto connect_tick = [&](QAction* action, bool SpaceScene::*member) {
        connect(action, &QAction::triggered, this, [this, member](bool on) {
            scene_.*member = on;
            scene_updated();
            emit scene_changed(scene_);
        });
    };
    connect_tick(show_scene_, &SpaceScene::show_scene);
    connect_tick(show_centres_, &SpaceScene::show_centres);
}

void SpaceView::update_tools() {
    const bool sphere = shows_sphere(scene_);
    for (QAction* action : {experiment_camera_, free_camera_}) action->setEnabled(!sphere);
    (is_free() ? free_camera_ : experiment_camera_)->setChecked(true);
    const bool own = shows_own_space();
    const QString on_sphere = tr("A sphere of directions is always seen from outside");
    experiment_camera_->setText(own ? tr("From the front") : tr("Experiment's camera"));
    experiment_camera_->setToolTip(sphere ? on_sphere
                                   : own  ? tr("See all of it from the front (Home)")
                                          : tr("See it as the experiment does (Home)"));
    free_camera_->setToolTip(sphere ? on_sphere
                                    : tr("Drag to orbit, Shift-drag to slide, Ctrl-drag to look around,\n"
                                         "wheel to go nearer, W A S D Q E to fly"));
    show_scene_->setChecked(scene_.show_scene);
    show_scene_->setVisible(!sphere && !own);
    show_centres_->setChecked(scene_.show_centres);
    show_centres_->setVisible(sphere);
}

/// Told by the fields of what was drawn last.
bool SpaceView::shows_own_space() const {
    return std::any_of(picture_.layers.begin(), picture_.layers.end(), [](const LayerInfo& info) {
        return space_of(info.asked.kind, info.fields) == Space::own && info.note.empty();
    });
}

void SpaceView::scene_updated() {
    update_tools();
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
    divisor_ = gesture_ ? moving_divisor_ : 1;
    oversampling_ = refine_ ? still_oversampling : 1;
    sent_ = scene_;
    const QSize size = wanted_size();
    if (shows_sphere(scene_))
        sent_.camera = fitted_to_width(sphere_pose_, double(size.width()) / size.height());
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
    const SpaceScene& asked = picture_.scene ? *picture_.scene : sent_;
    const std::vector<int> places = scene_indices(picture_.layers, asked.layers);
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i] >= 0) picture_.layers[i].asked = asked.layers[std::size_t(places[i])];
    if (!asked.camera) experiment_pose_ = picture_.camera;
    overlay_.note.clear();
    update_tools();
    image_->set_image(picture_.colour, Semantic::radiance);
    image_->fit();
    if (pacer_->is_idle()) {
        set_busy(false);
        if (!gesture_) refine_later();
    }
    update_overlay();
    update_hover();
    emit picture_shown(picture_.layers);
}

void SpaceView::set_note(const QString& note) {
    pacer_->answered();
    set_busy(false);
    overlay_.note = note;
    if (picture_.colour.empty()) image_->set_note(note);
    update_overlay();
}

void SpaceView::clear(const QString& note) {
    picture_ = {};
    experiment_pose_.reset();
    hovered_ = {};
    set_note(note);
    update_hover();
}

void SpaceView::set_bounds(const SpaceBox& bounds) {
    bounds_ = bounds;
}

void SpaceView::set_selectors(const std::vector<SpaceSelector>& selectors) {
    selectors_ = selectors;
    update_hover();
}

void SpaceView::set_hover_values(const QString& values) {
    if (values == hover_values_) return;
    hover_values_ = values;
    overlay_.hover = hover_text(hovered_);
    overlay_widget_->update();
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
    overlay_.has_picture = !picture_.colour.empty();
    overlay_widget_->update();
}

CameraPose SpaceView::pose() const {
    if (shows_sphere(scene_)) return sphere_pose_;
    return scene_.camera ? *scene_.camera : experiment_pose_.value_or(CameraPose{});
}

SpaceView::Element SpaceView::element_at(QPointF position) const {
    const double ratio = devicePixelRatioF();
    const QPointF in_view = (position - QPointF(picture_area().topLeft())) * ratio;
    const ViewTransform& transform = image_->transform();
    const QPointF at = transform.image_from_view(in_view);
    const int x0 = int(std::floor(at.x())), y0 = int(std::floor(at.y()));
    const int reach = int(std::ceil(pick_reach * ratio / transform.zoom()));
    const Image& image = picture_.colour;
    int best = reach * reach + 1;
    Element found;
    for (int y = std::max(0, y0 - reach); y <= std::min(image.height - 1, y0 + reach); ++y)
        for (int x = std::max(0, x0 - reach); x <= std::min(image.width - 1, x0 + reach); ++x) {
            const int distance = (x - x0) * (x - x0) + (y - y0) * (y - y0);
            const auto pixel = std::size_t(y) * image.width + x;
            if (distance >= best || pixel >= picture_.layer.size() || pixel >= picture_.element.size())
                continue;
            const int drawn = picture_.layer[pixel];
            if (drawn < 0 || std::size_t(drawn) >= indices_.size()) continue;
            if (indices_[std::size_t(drawn)] < 0) continue;
            best = distance;
            found = {indices_[std::size_t(drawn)], picture_.element[pixel]};
        }
    return found;
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
    if (!is_free()) return update_tools();
    scene_.camera.reset();
    scene_updated();
    emit scene_changed(scene_);
}

void SpaceView::use_free_camera() {
    if (is_free() || !can_move()) return update_tools();
    move_camera(pose());
    finish_gesture();
}

void SpaceView::frame_all() {
    if (!can_move()) return;
    if (shows_sphere(scene_)) {
        CameraPose pose = sphere_pose_;
        pose.eye *= glm::length(widgets::sphere_pose().eye) / glm::length(pose.eye);
        return move_camera(pose), finish_gesture();
    }
    if (shows_own_space()) return use_experiment_camera();
    std::optional<SpaceBox> box;
    for (const LayerInfo& info : picture_.layers) {
        if (!info.bounds || info.elements == 0) continue;
        if (!box) box = info.bounds;
        box->low = glm::min(box->low, info.bounds->low);
        box->high = glm::max(box->high, info.bounds->high);
    }
    const double aspect = double(image_->width()) / std::max(1, image_->height());
    move_camera(framed(pose(), box.value_or(bounds_), aspect));
    finish_gesture();
}

}  // namespace ir::widgets
