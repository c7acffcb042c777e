#include "app/gui/picture_tools.h"

#include <utility>

#include "app/gui/json_fields.h"
#include "app/gui/view_memory.h"

namespace ir::gui {

void PictureTools::add(widgets::CompareView& view) {
    views_.push_back(&view);
    view.set_tool(tool_);
    view.set_pixel_grid(grid_);
    view.set_legend(legend_);
    view.set_pins(pins_);
    view.set_region(region_size_, region_);
    connect(&view, &widgets::CompareView::tool_changed, this, &PictureTools::set_tool);
    connect(&view, &widgets::CompareView::region_changed, this, &PictureTools::set_region);
}

void PictureTools::set_tool(Tool tool) {
    if (tool == tool_) return;
    tool_ = tool;
    for (auto* view : views_) view->set_tool(tool);
    emit tool_changed(tool);
}

void PictureTools::set_pixel_grid(bool on) {
    grid_ = on;
    for (auto* view : views_) view->set_pixel_grid(on);
}

void PictureTools::set_legend(bool on) {
    legend_ = on;
    for (auto* view : views_) view->set_legend(on);
}

void PictureTools::set_pins(std::vector<widgets::PinMark> pins) {
    pins_ = std::move(pins);
    for (auto* view : views_) view->set_pins(pins_);
}

void PictureTools::set_region(QSize size, const QRect& region) {
    region_size_ = region.isEmpty() ? QSize() : size;
    region_ = region;
    for (auto* view : views_) view->set_region(region_size_, region_);
    emit region_changed();
}

void PictureTools::save(projects::Json& memory) const {
    memory["region"] = to_json(region_size_, region_);
}

void PictureTools::load(const projects::Json& memory) {
    const auto [size, region] = region_from_json(member_or_null(memory, "region"));
    set_region(size, region);
}

}  // namespace ir::gui
