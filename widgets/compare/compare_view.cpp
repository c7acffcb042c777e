#include "widgets/compare/compare_view.h"

#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>
#include <tuple>

#include "renderers/image/channels.h"
#include "widgets/compare/difference_worker.h"
#include "widgets/compare/stage_bar.h"
#include "widgets/compare/view_link.h"

/// State of a comparison and its panes' signals. What the panes show stands in compare_panes.cpp, where they
/// are in compare_layout.cpp, keys in compare_keys.cpp.
namespace ir::widgets {

CompareView::CompareView(QWidget* parent, ImageView::Surface surface)
    : QWidget(parent),
      surface_(surface),
      scroll_(new QScrollArea(this)),
      board_(new QWidget),
      link_(new ViewLink(this)),
      worker_(new DifferenceWorker(this)),
      bar_(new StageBar(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(scroll_, 1);
    layout->addWidget(bar_);
    scroll_->setFrameShape(QFrame::NoFrame);
    scroll_->setFocusPolicy(Qt::NoFocus);
    scroll_->setWidgetResizable(true);
    scroll_->setWidget(board_);
    board_->installEventFilter(this);
    setFocusProxy(pane(0));
    connect(worker_, &DifferenceWorker::ready, this, &CompareView::show_difference);
    connect(bar_, &StageBar::chosen, this, &CompareView::choose_pair);
    refresh();
}

CompareView::~CompareView() = default;

void CompareView::set_pictures(std::vector<std::shared_ptr<const Picture>> pictures) {
    for (auto& picture : pictures)
        if (!picture) picture = make_note({});
    if (pictures == pictures_) return;
    pictures_ = std::move(pictures);
    displays_.resize(pictures_.size());
    poses_.resize(pictures_.size(), poses_.empty() ? CameraPose() : poses_.front());
    if (flipped_ >= count()) flipped_ = 0;
    if (held_ >= count()) held_ = -1;
    refresh();
}

void CompareView::set_displays(std::vector<Display> displays) {
    displays_ = std::move(displays);
    displays_.resize(pictures_.size());
    refresh();
}

void CompareView::set_difference_display(std::optional<Display> display) {
    difference_display_ = std::move(display);
    refresh();
}

void CompareView::set_mode(Mode mode) {
    if (mode == mode_) return;
    mode_ = mode;
    held_ = -1;
    flipped_ = 0;
    refresh();
}

void CompareView::set_difference(DifferenceKind kind) {
    if (kind == kind_) return;
    kind_ = kind;
    refresh();
}

void CompareView::set_wipe(double fraction) {
    wipe_ = std::clamp(fraction, 0.0, 1.0);
    main_view().set_wipe(wipe_);
}

void CompareView::set_legend(bool on) {
    legend_ = on;
    update_legends();
}

void CompareView::set_pixel_grid(bool on) {
    pixel_grid_ = on;
    for (auto* view : panes_) view->set_pixel_grid(on);
}

void CompareView::set_tool(ImageView::Tool tool) {
    tool_ = tool;
    for (auto* view : panes_) view->set_tool(tool);
}

void CompareView::set_camera(const CameraPose& pose) {
    std::fill(poses_.begin(), poses_.end(), pose);
    if (poses_.empty()) poses_.push_back(pose);
    for (auto* view : panes_) view->camera().set_pose(pose);
}

void CompareView::set_camera(int picture, const CameraPose& pose) {
    if (picture < 0 || picture >= int(poses_.size())) return;
    poses_[picture] = pose;
    const auto shown = contents();
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (picture_of(int(i), {}) == picture) panes_[i]->camera().set_pose(pose);
}

void CompareView::set_fly_speed(double metres_per_second) {
    fly_speed_ = metres_per_second;
    for (auto* view : panes_) view->camera().set_fly_speed(metres_per_second);
}

void CompareView::set_picked(QPoint pixel, QSize size) {
    picked_ = pixel;
    picked_size_ = size;
    for (auto* view : panes_) mark(*view);
}

void CompareView::set_pins(std::vector<PinMark> pins) {
    pins_ = std::move(pins);
    for (auto* view : panes_) view->set_mark(&Marks::pins, pins_);
}

void CompareView::set_region(QSize size, const QRect& region) {
    region_size_ = size;
    region_ = region;
    update_regions();
}

void CompareView::set_noise_hint(const QString& hint) {
    if (hint == noise_hint_) return;
    noise_hint_ = hint;
    if (!noise_refusal().isEmpty()) refresh();
}

void CompareView::swap() {
    if (count() < 2) return;
    std::swap(pictures_[0], pictures_[1]);
    std::swap(displays_[0], displays_[1]);
    std::swap(poses_[0], poses_[1]);
    refresh();
    emit swapped();
}

void CompareView::set_linked(bool linked) {
    if (linked == link_->is_linked()) return;
    link_->set_linked(linked);
    refresh();
    emit linked_changed(linked);
}

void CompareView::fit() {
    panes_[active_pane_]->fit();
}

void CompareView::actual_pixels() {
    panes_[active_pane_]->actual_pixels();
}

void CompareView::zoom_in() {
    panes_[active_pane_]->zoom(1);
}

void CompareView::zoom_out() {
    panes_[active_pane_]->zoom(-1);
}

void CompareView::look_at(QPointF image_px, double zoom) {
    panes_[active_pane_]->look_at(image_px, zoom);
}

void CompareView::flip_next() {
    if (mode_ != Mode::flip || count() < 2) return;
    flipped_ = (flipped_ + 1) % count();
    refresh();
    emit activated(flipped_);
}

Display CompareView::shown_display(int picture) const {
    if (picture < 0 || picture >= count()) return {};
    const auto kind_of = [](const Picture& each) {
        return std::tuple(each.semantic, each.unit,
                          each.has_image() ? value_channels(each.semantic, each.image->channels) : 0);
    };
    const bool alike = kind_of(*pictures_[picture]) == kind_of(*pictures_.front());
    return displays_[is_linked() && alike ? 0 : picture];
}

bool CompareView::is_linked() const {
    return link_->is_linked();
}

int CompareView::shown_picture() const {
    if (held_ >= 0) return held_;
    return mode_ == Mode::flip ? flipped_ : 0;
}

int CompareView::active_picture() const {
    return std::max(0, picture_of(active_pane_, {}));
}

std::shared_ptr<const Picture> CompareView::difference_picture() const {
    const auto* result = worker_->result(0);
    return result && result->picture->has_image() ? result->picture : nullptr;
}

std::shared_ptr<const Picture> CompareView::pointed_picture() const {
    const auto* view = panes_[pointed_pane_];
    return is_right_of_wipe(pointed_pane_, pointed_) ? view->state().pictures[1].picture : view->picture();
}

const Display& CompareView::difference_display() const {
    return shown_difference_;
}

ImageView& CompareView::main_view() {
    return *panes_.front();
}

bool CompareView::is_computing() const {
    return worker_->is_computing();
}

ImageView* CompareView::pane(int index) {
    while (int(panes_.size()) <= index) {
        auto* view = new ImageView(board_, surface_);
        view->set_tool(tool_);
        view->set_pixel_grid(pixel_grid_);
        view->camera().set_fly_speed(fly_speed_);
        view->set_mark(&Marks::picked, picked_);
        view->set_mark(&Marks::pins, pins_);
        if (!poses_.empty()) view->camera().set_pose(poses_.front());
        view->installEventFilter(this);
        connect_pane(view, int(panes_.size()));
        panes_.push_back(view);
    }
    return panes_[index];
}

void CompareView::connect_pane(ImageView* view, int index) {
    connect(view, &ImageView::cursor_moved, this, [this, index](QPoint pixel) {
        pointed_pane_ = index;
        pointed_ = pixel;
        emit cursor_moved(pixel, picture_of(index, pixel));
    });
    connect(view, &ImageView::picked_changed, this, [this, view, index](QPoint pixel) {
        pointed_pane_ = index;
        pointed_ = pixel;
        set_picked(pixel, view->transform().image_size().toSize());
        emit picked_changed(pixel);
    });
    connect(view, &ImageView::region_changed, this, [this, view](QRect region) {
        set_region(view->transform().image_size().toSize(), region);
        emit region_changed(region_size_, region);
    });
    connect(view, &ImageView::zoom_changed, this, [this, index](double zoom) {
        if (index == active_pane_) emit zoom_changed(zoom);
    });
    connect(view, &ImageView::transform_changed, this, &CompareView::transform_changed);
    connect(view, &ImageView::camera_moved, this,
            [this, index](const CameraPose& pose) { camera_from(index, pose); });
    connect(view, &ImageView::camera_gesture_finished, this,
            [this, index] { emit camera_gesture_finished(std::max(0, picture_of(index, {}))); });
    connect(view, &ImageView::tool_changed, this, [this](ImageView::Tool tool) {
        if (tool == tool_) return;
        set_tool(tool);
        emit tool_changed(tool);
    });
    connect(view, &ImageView::wipe_moved, this, [this](double fraction) {
        wipe_ = fraction;
        emit wipe_moved(fraction);
    });
    connect(view, &ImageView::activated, this, [this, index] {
        active_pane_ = index;
        board_->update();
        emit activated(active_picture());
    });
}

void CompareView::camera_from(int pane, const CameraPose& pose) {
    const int picture = std::max(0, picture_of(pane, {}));
    if (is_linked()) {
        std::fill(poses_.begin(), poses_.end(), pose);
        for (auto* view : panes_) view->camera().set_pose(pose);
    } else if (picture < int(poses_.size())) {
        poses_[picture] = pose;
    }
    emit camera_moved(pose, picture);
}

}  // namespace ir::widgets
