#include "app/gui/picture_tools.h"

#include <utility>

#include "app/gui/json_fields.h"
#include "app/gui/view_memory.h"

namespace ir::gui {

void PictureTools::add(widgets::PaneBoard& panes) {
    boards_.push_back(&panes);
    panes.set_tool(tool_);
    panes.set_hinted(!is_known(tool_));
    panes.set_pixel_grid(grid_);
    panes.set_legend(legend_);
    panes.set_pins(pins_);
    panes.set_region(region_size_, region_);
    panes.set_line(line_size_, line_);
    connect(&panes, &widgets::PaneBoard::tool_changed, this, &PictureTools::set_tool);
    connect(&panes, &widgets::PaneBoard::tool_used, this, &PictureTools::note_use);
    connect(&panes, &widgets::PaneBoard::region_changed, this, &PictureTools::set_region);
    connect(&panes, &widgets::PaneBoard::line_changed, this, &PictureTools::set_line);
    connect(&panes, &widgets::PaneBoard::shape_drawn, this, &PictureTools::shape_drawn);
    connect(&panes, &widgets::PaneBoard::light_moved, this, &PictureTools::light_moved);
    connect(&panes, &widgets::PaneBoard::light_turned, this, &PictureTools::light_turned);
    connect(&panes, &widgets::PaneBoard::light_gesture_finished, this, &PictureTools::light_gesture_finished);
}

void PictureTools::set_tool(Tool tool) {
    if (tool == tool_) return;
    tool_ = tool;
    for (auto* each : boards_) {
        each->set_hinted(!is_known(tool));
        each->set_tool(tool);
    }
    emit tool_changed(tool);
}

void PictureTools::note_use() {
    if (known_.insert(tool_).second)
        for (auto* each : boards_) each->set_hinted(false);
}

void PictureTools::set_pixel_grid(bool on) {
    grid_ = on;
    for (auto* each : boards_) each->set_pixel_grid(on);
}

void PictureTools::set_legend(bool on) {
    legend_ = on;
    for (auto* each : boards_) each->set_legend(on);
}

void PictureTools::set_pins(std::vector<widgets::PinMark> pins) {
    pins_ = std::move(pins);
    for (auto* each : boards_) each->set_pins(pins_);
}

void PictureTools::set_region(QSize size, const QRect& region) {
    region_size_ = region.isEmpty() ? QSize() : size;
    region_ = region;
    for (auto* each : boards_) each->set_region(region_size_, region_);
    emit region_changed();
}

void PictureTools::set_line(QSize size, const QLine& line) {
    line_size_ = line.isNull() ? QSize() : size;
    line_ = line;
    for (auto* each : boards_) each->set_line(line_size_, line_);
    emit line_changed();
}

void PictureTools::save(projects::Json& memory) const {
    memory["region"] = to_json(region_size_, region_);
    memory["line"] = to_json(line_size_, line_);
}

void PictureTools::load(const projects::Json& memory) {
    const auto [size, region] = region_from_json(member_or_null(memory, "region"));
    set_region(size, region);
    const auto [line_size, line] = line_from_json(member_or_null(memory, "line"));
    set_line(line_size, line);
}

}  // namespace ir::gui
