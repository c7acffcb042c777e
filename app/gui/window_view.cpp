#include <QLabel>
#include <QProgressBar>
#include <QStackedWidget>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/main_window.h"
#include "widgets/models/report_rows.h"

namespace ir::gui {
namespace {

QString text_of(const std::string& text) {
    return QString::fromStdString(text);
}

const ResourceReport* find_resource(const FrameReport& report, const std::string& key) {
    const auto found = std::find_if(report.resources.begin(), report.resources.end(),
                                    [&](const auto& resource) { return resource.key == key; });
    return found == report.resources.end() ? nullptr : &*found;
}

/// Empty when what is shown was not computed or has no picture.
const Image& image_of(const engine::LiveResult& result) {
    static const Image none;
    return result.images.empty() ? none : result.images.begin()->second;
}

QString why_no_picture(const ResourceReport* resource) {
    if (!resource) return MainWindow::tr("This method has no buffer of that name.");
    if (!resource->available)
        return MainWindow::tr("“%1” has not been computed.").arg(text_of(resource->label));
    return MainWindow::tr("“%1” holds a %2, which has no picture.")
        .arg(text_of(resource->label), text_of(to_string(resource->kind)));
}

}  // namespace

void MainWindow::make_centre() {
    auto* centre = new QWidget;
    auto* layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    banners_ = new widgets::BannerStack;
    layout->addWidget(banners_);
    pages_ = new QStackedWidget;
    layout->addWidget(pages_, 1);
    welcome_ = new widgets::WelcomePage;
    pages_->addWidget(welcome_);
    auto* page = new QWidget;
    auto* column = new QVBoxLayout(page);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    display_bar_ = new widgets::DisplayBar;
    view_ = new widgets::ImageView(nullptr, options_.surface);
    view_->setObjectName(QStringLiteral("view"));
    values_ = new widgets::ValueStrip;
    column->addWidget(display_bar_);
    column->addWidget(view_, 1);
    column->addWidget(values_);
    pages_->addWidget(page);
    setCentralWidget(centre);
}

void MainWindow::connect_view() {
    using widgets::ImageView;
    connect(view_, &ImageView::cursor_moved, this,
            [this](QPoint pixel) { values_->show_pixel(view_->image(), pixel); });
    connect(view_, &ImageView::zoom_changed, values_, &widgets::ValueStrip::set_zoom);
    connect(view_, &ImageView::camera_moved, this,
            [this](const widgets::CameraPose& pose) { session_.move_camera(pose); });
    connect(view_, &ImageView::camera_gesture_finished, this, [this] { session_.finish_camera_move(); });
    connect(display_bar_, &widgets::DisplayBar::display_chosen, this, &MainWindow::choose_display);
    connect(display_bar_, &widgets::DisplayBar::automatic_chosen, this, [this] {
        if (session_.result()) chosen_displays_.erase(session_.shown_key(*session_.result()));
        exposure_ = 0;
        update_display();
    });
    connect(buffers_, &widgets::RowsPanel::row_clicked, this, [this](const QString& key) {
        if (!key.startsWith(QStringLiteral("pass:"))) session_.show_buffer(key.toStdString());
    });
    connect(welcome_, &widgets::WelcomePage::new_chosen, this, [this] { new_project(); });
    connect(welcome_, &widgets::WelcomePage::open_chosen, this, [this] { choose_project(); });
    connect(welcome_, &widgets::WelcomePage::project_chosen, this,
            [this](const QString& path) { open_path(path); });
}

void MainWindow::show_picture(std::shared_ptr<const engine::LiveResult> result) {
    const auto shown = session_.shown_key(*result);
    const auto& image = image_of(*result);
    const auto* resource = find_resource(result->report, shown);
    const QString name = resource && !resource->label.empty() ? text_of(resource->label) : text_of(shown);
    if (image.empty()) {
        view_->set_note(why_no_picture(resource));
    } else {
        const Semantic semantic = resource ? resource->semantic : Semantic::generic;
        display_bar_->set_image(name, semantic, image.channels);
        view_->set_image(image, semantic);
        update_display();
    }
    values_->set_picture(image, resource ? resource->semantic : Semantic::generic, name,
                         resource ? text_of(resource->unit) : QString());
    update_lists(*result);
}

void MainWindow::update_display() {
    const auto* result = session_.result();
    if (!result || image_of(*result).empty()) return;
    const auto shown = session_.shown_key(*result);
    const auto* resource = find_resource(result->report, shown);
    const auto chosen = chosen_displays_.find(shown);
    const bool automatic = chosen == chosen_displays_.end();
    widgets::Display display =
        automatic ? widgets::display_for(resource ? resource->semantic : Semantic::generic,
                                         resource ? resource->colour_map : "", image_of(*result))
                  : chosen->second;
    display.exposure = exposure_;
    display.mark_bad = mark_bad_;
    view_->set_display(display);
    display_bar_->set_display(display, automatic && exposure_ == 0);
}

void MainWindow::choose_display(const widgets::Display& display) {
    if (!session_.result()) return;
    // Exposure is one for all buffers; the rest belongs to the buffer.
    const bool only_exposure = display.exposure != exposure_;
    exposure_ = display.exposure;
    if (!only_exposure) chosen_displays_[session_.shown_key(*session_.result())] = display;
    update_display();
}

void MainWindow::step_exposure(double stops) {
    exposure_ = std::clamp(exposure_ + stops, -40.0, 40.0);
    update_display();
}

void MainWindow::step_buffer(int step) {
    const auto* result = session_.result();
    if (!result) return;
    std::vector<std::string> keys;
    for (const auto& pass : buffers_->model().rows())
        for (const auto& row : pass.children) keys.push_back(row.key);
    const auto now = std::find(keys.begin(), keys.end(), session_.shown_key(*result));
    if (keys.empty()) return;
    const auto count = int(keys.size());
    const int at = now == keys.end() ? 0 : (int(now - keys.begin()) + step + count) % count;
    session_.show_buffer(keys[std::size_t(at)]);
}

void MainWindow::update_lists(const engine::LiveResult& result) {
    for (const auto& [key, image] : result.thumbnails) {
        const auto* resource = find_resource(result.report, key);
        const auto display = widgets::display_for(resource ? resource->semantic : Semantic::generic,
                                                  resource ? resource->colour_map : "", image);
        thumbnails_[key] = widgets::to_qimage(image, display);
    }
    buffers_->set_rows(widgets::buffer_rows(result.report, thumbnails_, session_.shown_key(result)));
    timings_->set_rows(widgets::timing_rows(result.report));
    counters_->set_rows(widgets::counter_rows(result.report));
}

void MainWindow::update_scene_tree() {
    const auto* scene = session_.scene();
    if (!scene) return scene_tree_->set_rows({});
    widgets::SceneListing listing;
    listing.name = scene->name;
    listing.cameras = scene->cameras;
    listing.lights = scene->lights;
    listing.materials = scene->materials;
    listing.warnings = scene->warnings;
    listing.triangles = scene->triangles;
    listing.textures = scene->textures;
    for (const auto& node : scene->nodes) listing.nodes.push_back({node.name, node.parent, node.triangles});
    const auto extent = scene->bounds.max - scene->bounds.min;
    listing.extent = QStringLiteral("%1 × %2 × %3 m")
                         .arg(extent.x, 0, 'g', 3)
                         .arg(extent.y, 0, 'g', 3)
                         .arg(extent.z, 0, 'g', 3)
                         .toStdString();
    if (const auto* experiment = session_.experiment()) {
        const auto* camera = projects::find_item(session_.document().cameras, experiment->camera);
        if (camera)
            listing.used_camera = camera->scene_camera;
        else if (!scene->cameras.empty())
            listing.used_camera = scene->cameras.front();
    }
    scene_tree_->set_rows(widgets::scene_rows(listing));
}

void MainWindow::update_camera() {
    if (const auto pose = session_.camera_pose()) view_->set_camera(*pose);
    // Crossing the scene takes about six seconds.
    if (session_.scene()) view_->set_fly_speed(std::max(0.05, double(session_.scene()->bounds.radius()) / 3));
}

void MainWindow::update_state() {
    using State = Session::State;
    const State state = session_.state();
    const bool rendering = state == State::rendering;
    progress_->setVisible(rendering);
    cancel_button_->setVisible(rendering);
    actions_.value(QStringLiteral("cancel"))->setEnabled(rendering);
    view_->set_stale(rendering);
    if (rendering) progress_->setValue(0);
    const auto* result = session_.result();
    const QString reason = text_of(session_.state_text());
    switch (state) {
        case State::empty:
            state_label_->setText(tr("Ready"));
            break;
        case State::blocked:
            state_label_->setText(reason);
            break;
        case State::rendering:
            state_label_->setText(tr("Rendering …"));
            break;
        case State::done:
            state_label_->setText(tr("%1 of %2 frames, %3 ms, %4")
                                      .arg(result->frame)
                                      .arg(result->frames)
                                      .arg(widgets::milliseconds_text(result->report.wall_ms),
                                           widgets::bytes_text(result->report.memory_bytes)));
            break;
        case State::cancelled:
            state_label_->setText(tr("Cancelled. F5 renders again."));
            break;
        case State::failed:
            state_label_->setText(tr("Failed: %1").arg(reason));
            break;
    }
    state_label_->setToolTip(state_label_->text());
    if (state == State::failed || state == State::blocked)
        banners_->show_banner(QStringLiteral("render"), widgets::BannerStack::Kind::error, reason);
    else
        banners_->hide_banner(QStringLiteral("render"));
    if ((state == State::blocked || state == State::empty || state == State::failed) &&
        session_.has_project() && (state != State::failed || view_->image().empty()))
        view_->set_note(reason);
    if (is_settled()) emit settled();
}

void MainWindow::restore_view_memory() {
    if (!session_.has_project()) return;
    const auto& memory = session_.memory();
    const auto view = memory.find("view");
    if (view == memory.end() || !view->is_object()) return view_->fit();
    exposure_ = view->value("exposure", 0.0);
    if (view->value("fitted", true)) return view_->fit();
    view_->look_at({view->value("x", 0.0), view->value("y", 0.0)}, view->value("zoom", 1.0));
}

void MainWindow::store_view_memory() {
    if (!session_.has_project()) return;
    const auto& transform = view_->transform();
    session_.memory()["view"] = {{"fitted", transform.is_fitted()},
                                 {"zoom", transform.zoom()},
                                 {"x", transform.centre().x()},
                                 {"y", transform.centre().y()},
                                 {"exposure", exposure_}};
}

}  // namespace ir::gui
