#include <tuple>

#include "app/gui/json_fields.h"
#include "app/gui/view_memory.h"
#include "app/gui/workspace.h"

namespace ir::gui {

using widgets::ViewArea;
using widgets::ViewPane;

void Workspace::save(projects::Json& memory) const {
    auto& views = memory["views"];
    views = {{"arrangement", area_->save().toBase64().toStdString()},
             {"active", area_->active()},
             {"linked", linked_}};
    views["states"] = projects::Json::array();
    for (const auto& state : states_) views["states"].push_back(to_json(state));
    const auto* pane = panes_[std::size_t(area_->active())];
    if (pane) {
        const auto& transform = const_cast<ViewPane*>(pane)->compare().main_view().transform();
        views["zoom"] = {{"fitted", transform.is_fitted()},
                         {"zoom", transform.zoom()},
                         {"x", transform.centre().x()},
                         {"y", transform.centre().y()}};
    }
    memory["displays"] = displays_.save();
    memory["region"] = to_json(region_size_, region_);
    auto& inspections = memory["inspections"] = projects::Json::object();
    for (const auto& [id, inspection] : inspections_)
        if (session_.experiment(id)) inspections[id] = to_json(inspection);
}

void Workspace::load(const projects::Json& memory) {
    loading_ = true;
    pictures_.clear();
    inspections_.clear();
    panel_wants_.clear();
    if (const auto& kept = member_or_null(memory, "inspections"); kept.is_object())
        for (const auto& [id, inspection] : kept.items()) inspections_[id] = inspection_from_json(inspection);
    drawings_ = {};
    displays_.clear();
    displays_.load(member_or_null(memory, "displays"));
    std::tie(region_size_, region_) = region_from_json(member_or_null(memory, "region"));
    set_region(region_size_, region_);
    const auto& views = member_or_null(memory, "views");
    states_ = before_ = {};
    gone_ = {};
    std::size_t view = 0;
    for (const auto& state : member_or_null(views, "states"))
        if (view < states_.size()) states_[view++] = view_state_from_json(state);
    const auto arrangement = field_or(views, "arrangement", std::string());
    // Written by hand, a session file may name the views alone.
    using A = ViewArea::Arrangement;
    if (arrangement.empty())
        area_->arrange(view > 3 ? A::four : view == 3 ? A::three : view == 2 ? A::side_by_side : A::one);
    else
        area_->restore(QByteArray::fromBase64(QByteArray::fromStdString(arrangement)));
    loading_ = false;
    area_->set_active(field_or(views, "active", 0));
    linked_ = !field_or(views, "linked", true);
    set_linked(!linked_);
    update_all();
    for (const int view : area_->open_views()) mark_explained(view);
    const auto& zoom = member_or_null(views, "zoom");
    auto& compare = active_pane().compare();
    if (field_or(zoom, "fitted", true))
        compare.fit();
    else
        compare.look_at({field_or(zoom, "x", 0.0), field_or(zoom, "y", 0.0)}, field_or(zoom, "zoom", 1.0));
    active_pane().setFocus();  // whatever gets the focus is the active view
    emit active_changed();
}

}  // namespace ir::gui
