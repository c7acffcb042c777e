#include "widgets/image/tool_hint.h"

namespace ir::widgets {
namespace {

QString hint_of(ImageView::Tool tool) {
    using Tool = ImageView::Tool;
    switch (tool) {
        case Tool::orbit:
            return ImageView::tr("Orbit: drag to turn  ·  Shift-drag to slide  ·  Ctrl+wheel for distance");
        case Tool::fly:
            return ImageView::tr(
                "Fly: drag to look  ·  W A S D to move, Q E down and up  ·  Shift is faster");
        case Tool::rectangle:
            return ImageView::tr("Rectangle: drag to draw, move or resize  ·  arrows nudge  ·  Esc clears");
        case Tool::line:
            return ImageView::tr("Line: drag to draw, move it or an end  ·  arrows nudge  ·  Esc clears");
        case Tool::inspect:
            break;
    }
    return {};
}

}  // namespace

QString tool_hint(ImageView::Tool tool, const CanvasState& state, QSize view) {
    constexpr QSize least(320, 170);
    const bool has_room =
        state.has_image() && view.width() >= least.width() && view.height() >= least.height();
    const bool is_told = state.marks.hinted && has_room && state.light_handle == LightHandle::none;
    return is_told ? hint_of(tool) : QString();
}

}  // namespace ir::widgets
