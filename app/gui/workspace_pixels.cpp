#include <utility>

#include "app/gui/pixel_places.h"
#include "app/gui/workspace.h"

/// Pixels that are inspected, explained, marked and pinned.
namespace ir::gui {

QSize Workspace::main_size(const std::string& owner) const {
    const auto result = live_.result(owner);
    const auto* main = result ? find_resource(result->report, pictures_.key_of({owner, {}})) : nullptr;
    return main ? QSize(main->width, main->height) : QSize();
}

QPoint Workspace::pixel_of_result(int view, const widgets::Picture* picture, QPoint pixel) const {
    const QSize main = main_size(state(view).a.owner);
    if (pixel.x() < 0 || !picture || !picture->has_image()) return {-1, -1};
    if (main.isEmpty()) return pixel;
    const auto place = widgets::locate(*picture, pixel);
    QSize size = picture->size();
    for (const auto& tile : picture->atlas.tiles)
        if (tile.level == place.level && tile.layer == place.layer) size = {tile.width, tile.height};
    return pixel_of_main(main, size, place.pixel);
}

QPoint Workspace::pointed_pixel_of_result(int view, QPoint pixel) const {
    return pixel_of_result(view, pane(view)->compare().pointed_picture().get(), pixel);
}

/// What is explained is marked, also when it was chosen elsewhere. A mark on that pixel already stays: on a
/// coarser level several of its pixels are the same one.
void Workspace::mark_explained(int view) {
    const auto& now = inspection(state(view).a.owner);
    if (!pane(view) || !now.has_pixel()) return;
    const QPoint explained(now.x, now.y);
    auto& compare = pane(view)->compare();
    for (const auto* each : compare.views())
        if (pixel_of_result(view, each->picture().get(), each->picked()) == explained) return;
    const auto picture = pane(view)->picture_at(0);
    const QSize main = main_size(state(view).a.owner);
    if (!picture || !picture->has_image() || picture->atlas.tiles.empty() || main.isEmpty())
        return compare.set_picked(explained, main);
    const auto& first = picture->atlas.tiles.front();
    const QPoint mark = pixel_of_level(main, {first.width, first.height}, explained);
    compare.set_picked(mark.x() < 0 ? mark : mark + QPoint(first.x, first.y), picture->size());
}

void Workspace::set_inspection(const std::string& experiment, const Inspection& inspection) {
    const auto before = std::exchange(inspections_[experiment], inspection);
    send_wants();
    update_all();
    if (before.x == inspection.x && before.y == inspection.y) return;
    for (const int view : area_->open_views())
        if (state(view).a.owner == experiment) mark_explained(view);
}

const Inspection& Workspace::inspection(const std::string& experiment) const {
    static const Inspection none;
    const auto found = inspections_.find(experiment);
    return found == inspections_.end() ? none : found->second;
}

void Workspace::set_pins(std::vector<widgets::PinMark> pins) {
    pins_ = std::move(pins);
    for (auto* pane : panes_)
        if (pane) pane->compare().set_pins(pins_);
}

}  // namespace ir::gui
