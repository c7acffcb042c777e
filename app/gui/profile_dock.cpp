#include "app/gui/profile_dock.h"

#include <algorithm>
#include <set>

#include "app/gui/json_fields.h"

namespace ir::gui {

using widgets::ShownPicture;
using widgets::ViewMode;
using widgets::ViewPane;

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

void ProfileDock::set_visible(bool visible) {
    if (visible == visible_) return;
    visible_ = visible;
    came_by_drawing_ &= visible;
    update();
}

void ProfileDock::on_drawn() {
    const auto& tools = workspace_.tools();
    const bool has_line = !tools.line().isNull(), has_rectangle = !tools.region_size().isEmpty();
    if (!has_line && !has_rectangle) {
        if (std::exchange(came_by_drawing_, false)) emit emptied();
    } else if (!visible_) {
        has_line ? emit line_drawn() : emit rectangle_drawn();
        came_by_drawing_ = true;
    }
}

/// Pictures of all open views, each once, under names that tell them apart. `awaits`: of some there is only a
/// draft.
std::vector<ShownPicture> ProfileDock::shown_pictures(bool& awaits) const {
    std::vector<ShownPicture> shown;
    std::set<const Image*> known;
    const auto add = [&](const std::shared_ptr<const widgets::Picture>& picture, int view) {
        if (!picture || !picture->has_image()) return;
        if (!picture->draft.isEmpty()) return void(awaits = true);
        if (!known.insert(picture->image.get()).second) return;
        QString name = picture->label;
        const auto has = [&](const QString& text) {
            return std::any_of(shown.begin(), shown.end(),
                               [&](const ShownPicture& each) { return each.name == text; });
        };
        if (has(name)) name = tr("%1 (view %2)").arg(name).arg(view + 1);
        for (int i = 2; has(name); ++i) name = QStringLiteral("%1 #%2").arg(picture->label).arg(i);
        shown.push_back({name, picture});
    };
    for (const int view : workspace_.area().open_views()) {
        auto* pane = workspace_.pane(view);
        if (!pane || pane->content() != ViewPane::Content::picture) continue;
        const auto& compared = pane->compare().compared();
        for (const auto& picture : compared.pictures) add(picture, view);
        if (compared.mode == ViewMode::difference && compared.refusal().isEmpty())
            add(pane->picture_at(-1), view);
    }
    return shown;
}

void ProfileDock::update() {
    if (!visible_) return panel_->set_fields({.why_empty = tr("No pictures.")});
    const auto& tools = workspace_.tools();
    bool awaits = false;
    const auto all = session_.has_project() ? shown_pictures(awaits) : std::vector<ShownPicture>();
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
    memory["profile"] = {{"channel", panel_->choice()}, {"logarithmic", panel_->is_logarithmic()}};
}

void ProfileDock::load(const projects::Json& memory) {
    const auto& kept = member_or_null(memory, "profile");
    panel_->set_choice(field_or(kept, "channel", one_number));
    panel_->set_logarithmic(field_or(kept, "logarithmic", false));
    update();
}

}  // namespace ir::gui
