#include "app/gui/workspace.h"

#include <QDockWidget>
#include <algorithm>
#include <utility>

#include "app/gui/camera_pose.h"
#include "app/gui/stage_chain.h"

namespace ir::gui {

using widgets::CompareView;
using widgets::ImageView;
using widgets::ViewArea;
using widgets::ViewPane;
using widgets::ViewState;

Workspace::Workspace(Session& session, LivePictures& live, Renderer& renderer, ImageLoader& images,
                     KeptResults& kept, ImageView::Surface surface)
    : session_(session),
      live_(live),
      renderer_(renderer),
      pictures_(session, live, images, kept),
      surface_(surface) {
    area_ = new ViewArea([this](int view) { return make_pane(view); });
    connect(area_, &ViewArea::active_changed, this, &Workspace::on_active_changed);
    connect(area_, &ViewArea::views_changed, this, &Workspace::update_all);
    connect(&live_, &LivePictures::picture_arrived, this, &Workspace::on_picture);
    connect(&live_, &LivePictures::state_changed, this, [this](const std::string& id) {
        for (const int view : area_->open_views())
            if (shows(view, id)) update_view(view);
    });
    connect(&images, &ImageLoader::arrived, this, &Workspace::update_all);
    connect(&images, &ImageLoader::failed, this, &Workspace::update_all);
    connect(&kept, &KeptResults::changed, this, &Workspace::update_all);
    connect(&renderer_, &Renderer::scene_view_arrived, this, &Workspace::on_scene_view);
    connect(&session_, &Session::document_changed, this, &Workspace::update_all);
    connect(&session_, &Session::experiment_selected, this, [this] {
        if (const auto* chosen = session_.experiment()) show_owner(chosen->id);
    });
}

ViewPane* Workspace::make_pane(int view) {
    auto* pane = new ViewPane(nullptr, surface_);
    pane->setObjectName(QStringLiteral("pane-%1").arg(view + 1));
    panes_[std::size_t(view)] = pane;
    pane->compare().set_tool(tool_);
    pane->compare().set_pixel_grid(grid_);
    pane->compare().set_legend(legend_);
    pane->compare().set_pins(pins_);
    pane->compare().set_region(region_size_, region_);
    connect_pane(view, *pane);
    return pane;
}

void Workspace::connect_pane(int view, ViewPane& pane) {
    auto& compare = pane.compare();
    connect(&pane.header(), &widgets::ViewHeader::state_chosen, this, [this, view](const ViewState& state) {
        area_->set_active(view);
        set_state(view, state);
    });
    connect(&pane.header(), &widgets::ViewHeader::link_chosen, this, &Workspace::set_linked);
    connect(&compare, &CompareView::linked_changed, this, &Workspace::set_linked);
    connect(&compare, &CompareView::swapped, this, [this, view] {
        auto state = states_[std::size_t(view)];
        const bool row = state.mode == widgets::ViewMode::stages;
        if (row && state.more.empty()) return;
        std::swap(state.a, row ? state.more.front() : state.b);
        set_state(view, state);
    });
    connect(&compare, &CompareView::stage_pair_chosen, this, [this, view](widgets::StagePair pair) {
        auto state = states_[std::size_t(view)];
        state.pair = pair;
        set_state(view, state);
    });
    connect(&compare, &CompareView::activated, this, [this, view] { area_->set_active(view); });
    connect(&compare, &CompareView::region_changed, this, &Workspace::set_region);
    connect(&compare, &CompareView::tool_changed, this, &Workspace::set_tool);
    connect(&compare, &CompareView::camera_moved, this,
            [this, view](const widgets::CameraPose& pose, int picture) {
                area_->set_active(view);
                const auto& state = states_[std::size_t(view)];
                const std::string owner = picture == 1 && !linked_ ? state.b.owner : state.a.owner;
                session_.move_camera(owner, pose, linked_ ? shown_experiments() : std::vector<std::string>());
            });
    connect(&compare, &CompareView::camera_gesture_finished, this,
            [this](int) { session_.finish_camera_move(); });
    connect(&compare, &CompareView::picked_changed, this,
            [this, view](QPoint pixel) { emit picked(pointed_pixel_of_result(view, pixel)); });
    connect(&compare, &CompareView::difference_shown, this, [this, view, &pane] {
        update_displays(view);
        pane.update_summary();
        if (view == area_->active()) emit picture_shown();
    });
    connect(&pane, &ViewPane::space_made, this,
            [this, view](widgets::SpacePane& space) { connect_space(view, space); });
    connect(&pane, &ViewPane::table_made, this,
            [this, view](widgets::BufferTable& table) { connect_table(view, table); });
    connect(&pane, &ViewPane::cursor_moved, this, [this, view](QPoint pixel) {
        if (view == area_->active()) emit cursor_moved(pointed_pixel_of_result(view, pixel));
    });
    connect(&pane, &ViewPane::explain_wanted, this, [this, view](QPoint pixel) {
        area_->set_active(view);
        emit explain_wanted(pointed_pixel_of_result(view, pixel));
    });
}

void Workspace::set_state(int view, ViewState state) {
    state = completed(std::move(state));
    auto& present = states_[std::size_t(view)];
    if (state == present) return;
    const bool is_other = state.a.owner != present.a.owner;
    present = std::move(state);
    if (view == area_->active() && session_.experiment(present.a.owner))
        session_.select_experiment(present.a.owner);
    send_wants();
    update_view(view);
    if (is_other) mark_explained(view);
    if (view == area_->active()) emit active_changed();
}

bool Workspace::is_settled() const {
    const auto views = area_->open_views();
    return std::none_of(views.begin(), views.end(), [this](int view) {
        return drawings_[std::size_t(view)].is_under_way() ||
               (pane(view) && pane(view)->compare().is_computing());
    });
}

QString Workspace::missing(int view) const {
    const auto& shown = state(view);
    if (!session_.has_project()) return {};
    for (const auto& source : sources(shown))
        if (const auto why = pictures_.why_unfinished(source.owner); !why.isEmpty()) return why;
    if (!pane(view)) return {};
    if (pane(view)->content() == ViewPane::Content::space)
        for (const auto& layer : shown.space.layers)
            if (const auto why = pictures_.why_empty(shown.a.owner, layer.key);
                layer.visible && !why.isEmpty())
                return why;
    return pane(view)->missing();
}

bool Workspace::shows(int view, const std::string& owner) const {
    const auto shown = sources(state(view));
    return std::any_of(shown.begin(), shown.end(), [&](const auto& source) { return source.owner == owner; });
}

void Workspace::update_all() {
    if (loading_) return;
    const auto owner = active_state().a.owner;
    for (std::size_t view = 0; view < states_.size(); ++view) {
        auto state = completed(without_lost(int(view)));
        const auto before = std::exchange(states_[view], std::move(state));
        const auto& lost = before.a;
        if (!lost.owner.empty() && !lost.is_file() && !session_.experiment(lost.owner))
            gone_[view] = {before, states_[view]};
    }
    // What is worked on is what is shown.
    if (active_state().a.owner != owner) session_.select_experiment(active_state().a.owner);
    send_wants();
    for (const int view : area_->open_views()) update_view(view);
}

/// Sizes and fields of buffers are known now, and with them what was left open.
void Workspace::on_picture(const std::string& id) {
    bool completed_some = false;
    for (const int view : area_->open_views()) {
        if (!shows(view, id)) continue;
        auto state = completed(without_lost(view));
        if (state != states_[std::size_t(view)]) {
            states_[std::size_t(view)] = std::move(state);
            completed_some = true;
        }
        update_view(view);
    }
    if (completed_some) send_wants();
}

void Workspace::on_active_changed() {
    const auto& owner = active_state().a.owner;
    if (session_.experiment(owner)) session_.select_experiment(owner);
    emit active_changed();
}

void Workspace::update_view(int view) {
    auto* pane = panes_[std::size_t(view)];
    if (!pane) return;
    update_header(view);
    switch (content_of(state(view))) {
        case ViewPane::Content::picture:
            update_pictures(view);
            break;
        case ViewPane::Content::space:
            update_space(view);
            break;
        case ViewPane::Content::table:
            update_table(view);
            break;
    }
    update_camera(view);
    if (view == area_->active()) emit picture_shown();
}

void Workspace::update_header(int view) {
    const auto& shown = state(view);
    widgets::ViewFields fields;
    fields.owners = pictures_.owners();
    for (const auto& source : {shown.a, shown.b}) {  // a kept result that is gone has its name still
        const QString id = QString::fromStdString(source.owner);
        if (source.is_kept() && std::none_of(fields.owners.begin(), fields.owners.end(),
                                             [&](const auto& each) { return each.id == id; }))
            fields.owners.push_back({id, QString::fromStdString(pictures_.owner_name(source.owner)), {}});
    }
    fields.outputs_a = pictures_.outputs(shown.a.owner);
    fields.outputs_b = pictures_.outputs(shown.b.owner);
    if (widgets::takes_many(shown.mode)) fields.candidates = candidates(shown);
    fields.state = shown;
    fields.linked = linked_;
    fields.has_stages = has_stages(session_, shown.a.owner);
    if (widgets::compares(shown.mode)) fields.warning = pictures_.warning(shown.a, shown.b);
    if (shown.mode == widgets::ViewMode::stages) fields.warning = missing_stages(shown);
    pane(view)->header().set_fields(fields);
    const auto* output = pictures_.find(fields.outputs_a, shown.a.output);
    area_->set_title(view,
                     output ? QStringLiteral("%1 · %2").arg(
                                  QString::fromStdString(pictures_.owner_name(shown.a.owner)), output->label)
                            : QString());
}

void Workspace::update_camera(int view) {
    const auto result = live_.result(state(view).a.owner);
    const auto* chosen = session_.experiment();
    std::optional<widgets::CameraPose> pose;
    if (chosen && chosen->id == state(view).a.owner) pose = session_.camera_pose();
    if (!pose && result) pose = pose_of(result->camera);
    if (pose) pane(view)->compare().set_camera(*pose);
    const auto other = linked_ ? nullptr : live_.result(state(view).b.owner);
    if (other && state(view).b.owner != state(view).a.owner)
        pane(view)->compare().set_camera(1, pose_of(other->camera));
}

std::vector<std::string> Workspace::shown_experiments() const {
    std::vector<std::string> ids;
    for (const int view : area_->open_views())
        for (const auto& source : sources(state(view)))
            if (session_.experiment(source.owner) &&
                std::find(ids.begin(), ids.end(), source.owner) == ids.end())
                ids.push_back(source.owner);
    return ids;
}

void Workspace::send_wants() {
    std::map<std::string, Want> wants;
    for (const auto& id : shown_experiments()) {
        Want& want = wants[id];
        for (const int view : area_->open_views()) {
            const auto more = want_of(state(view), id);
            want.parts.insert(more.parts.begin(), more.parts.end());
            want.buffers.insert(more.buffers.begin(), more.buffers.end());
            want.kept.insert(more.kept.begin(), more.kept.end());
        }
        want.inspection = inspection(id);
        for (const auto& [panel, wanted] : panel_wants_)
            if (const auto found = wanted.find(id); found != wanted.end()) {
                const auto& more = found->second;
                want.thumbnails |= more.thumbnails;
                want.parts.insert(more.parts.begin(), more.parts.end());
                want.kept.insert(more.kept.begin(), more.kept.end());
                want.buffers.insert(more.buffers.begin(), more.buffers.end());
            }
    }
    live_.set_wants(std::move(wants));
    std::vector<widgets::ViewSource> shown;
    for (const int view : area_->open_views())
        for (const auto& source : sources(state(view))) shown.push_back(source);
    pictures_.keep_only(shown);
}

void Workspace::set_panel_wants(std::map<std::string, Want> wants, const std::string& panel) {
    panel_wants_[panel] = std::move(wants);
    send_wants();
}

void Workspace::set_linked(bool linked) {
    if (linked == linked_) return;
    linked_ = linked;
    for (auto* pane : panes_)
        if (pane) pane->compare().set_linked(linked);
    link_.set_linked(linked);
    for (const int view : area_->open_views()) update_view(view);
    emit linked_changed(linked);
}

void Workspace::set_tool(ImageView::Tool tool) {
    if (tool == tool_) return;
    tool_ = tool;
    for (auto* pane : panes_)
        if (pane) pane->compare().set_tool(tool);
    emit tool_changed(tool);
}

void Workspace::set_region(QSize size, const QRect& region) {
    region_size_ = region.isEmpty() ? QSize() : size;
    region_ = region;
    for (auto* pane : panes_)
        if (pane) pane->compare().set_region(region_size_, region_);
    emit region_changed();
}

void Workspace::set_pixel_grid(bool on) {
    grid_ = on;
    for (auto* pane : panes_)
        if (pane) pane->compare().set_pixel_grid(on);
}

void Workspace::set_legend(bool on) {
    legend_ = on;
    for (auto* pane : panes_)
        if (pane) pane->compare().set_legend(on);
}

}  // namespace ir::gui
