#include "app/gui/profile_dock.h"

#include <algorithm>
#include <utility>

#include "app/gui/json_fields.h"
#include "app/gui/shown_pictures.h"

namespace ir::gui {

using widgets::ShownPicture;

ProfileDock::ProfileDock(Session& session, Workspace& workspace)
    : session_(session), workspace_(workspace), panel_(new widgets::ProfilePanel) {
    auto& views = workspace_.views();
    auto& tools = workspace_.tools();
    connect(&views, &ViewModel::active_changed, this, &ProfileDock::update);
    connect(&views, &ViewModel::shown_changed, this, &ProfileDock::update);
    connect(&workspace_, &Workspace::picture_shown, this, &ProfileDock::update);
    connect(&tools, &PictureTools::region_changed, this, &ProfileDock::update);
    connect(&tools, &PictureTools::line_changed, this, &ProfileDock::update);
    connect(&tools, &PictureTools::tool_changed, this, &ProfileDock::update);
    connect(&tools, &PictureTools::shape_drawn, this, &ProfileDock::on_drawn);
    connect(panel_, &widgets::ProfilePanel::pixel_chosen, this, &ProfileDock::mark);
    connect(panel_, &widgets::ProfilePanel::tool_chosen, this, [this](widgets::ImageView::Tool tool) {
        workspace_.tools().set_tool(tool);
        if (tool != widgets::ImageView::Tool::inspect) workspace_.active_pane().setFocus();
    });
}

void ProfileDock::set_visible(bool visible, bool metrics_visible) {
    metrics_visible_ = metrics_visible;
    if (visible == visible_) return;
    visible_ = visible;
    came_by_drawing_ &= visible;
    update();
}

void ProfileDock::on_drawn() {
    const auto& tools = workspace_.tools();
    const bool has_line = !tools.line().isNull(), has_rectangle = !tools.region_size().isEmpty();
    const std::pair now(tools.line(), tools.region(tools.region_size()));
    const bool is_new = std::exchange(last_drawn_, now) != now;
    if (!has_line && !has_rectangle) {
        if (std::exchange(came_by_drawing_, false)) emit emptied();
    } else if (is_new && !visible_ && (has_line || !metrics_visible_)) {
        if (!panel_->isVisible()) came_by_drawing_ = true;  // behind another tab somebody opened it
        emit drawn();
    }
}

void ProfileDock::leave() {
    if (std::exchange(came_by_drawing_, false)) emit emptied();
}

void ProfileDock::update() {
    if (!visible_) return panel_->set_fields({.why_empty = tr("No pictures.")});
    const auto& tools = workspace_.tools();
    bool awaits = false;
    std::vector<ShownPicture> all;
    if (session_.has_project())
        for (auto& seen : shown_pictures(workspace_, awaits)) all.push_back(std::move(seen.shown));
    widgets::ProfileFields fields;
    fields.tool = tools.tool();
    fields.line = tools.line();
    fields.rectangle = tools.region(tools.region_size());
    std::size_t left_out = 0;
    const auto of_size = [&](QSize size, bool any) {
        std::vector<ShownPicture> fitting;
        for (const auto& each : all)
            if (any || each.picture->size() == size) fitting.push_back(each);
        left_out = std::max(left_out, all.size() - fitting.size());
        return fitting;
    };
    if (!fields.line.isNull()) fields.along = of_size(tools.line_size(), false);
    if (!fields.rectangle.isEmpty() || fields.line.isNull())
        fields.within = of_size(tools.region_size(), fields.rectangle.isEmpty());
    if (left_out > 0)
        fields.note = left_out == 1 ? tr("One picture has another size")
                                    : tr("%1 pictures have another size").arg(left_out);
    if (all.empty())
        fields.why_empty = awaits ? widgets::full_picture_awaited() : tr("No view shows a picture.");
    panel_->set_fields(fields);
}

/// In all pictures of the line's size.
void ProfileDock::mark(QPoint pixel) {
    for (const int view : workspace_.area().open_views())
        if (auto* pane = workspace_.pane(view))
            pane->compare().panes().set_picked(pixel, workspace_.tools().line_size());
}

void ProfileDock::save(projects::Json& memory) const {
    memory["profile"] = {{"channel", panel_->choice()},
                         {"logarithmic", panel_->is_logarithmic()},
                         {"waveforms", panel_->shows_waveforms()}};
}

void ProfileDock::load(const projects::Json& memory) {
    const auto& kept = member_or_null(memory, "profile");
    panel_->set_choice(field_or(kept, "channel", one_number));
    panel_->set_logarithmic(field_or(kept, "logarithmic", false));
    panel_->set_shows_waveforms(field_or(kept, "waveforms", false));
    update();
}

}  // namespace ir::gui
