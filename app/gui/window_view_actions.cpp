#include <QActionGroup>

#include "app/gui/main_window.h"

namespace ir::gui {

using widgets::CompareView;
using widgets::ViewArea;
using widgets::ViewMode;
using K = QKeySequence;

void MainWindow::make_view_actions() {
    const auto in_view = [this](void (CompareView::*run)()) {
        return [this, run] { (workspace_.active_pane().compare().*run)(); };
    };
    add_action("fit", tr("&Fit picture"), "fit", {K(Qt::Key_F)}, [this] {
        auto& pane = workspace_.active_pane();
        if (pane.content() == widgets::ViewPane::Content::space) return pane.space().view().frame_all();
        pane.compare().fit();
    });
    add_action("actual", tr("&Actual pixels, 1:1"), "actual", {K(Qt::CTRL | Qt::Key_0)},
               in_view(&CompareView::actual_pixels));
    add_action("zoom-in", tr("Zoom &in"), "zoom-in",
               {K(Qt::CTRL | Qt::Key_Plus), K(Qt::CTRL | Qt::Key_Equal)}, in_view(&CompareView::zoom_in));
    add_action("zoom-out", tr("Zoom &out"), "zoom-out", {K(Qt::CTRL | Qt::Key_Minus)},
               in_view(&CompareView::zoom_out));
    add_switch("grid", tr("Pixel &grid and numbers"), "grid", {K(Qt::Key_G)}, true,
               [this](bool on) { workspace_.set_pixel_grid(on); });
    add_switch("legend", tr("&Legend"), nullptr, {K(Qt::SHIFT | Qt::Key_G)}, true,
               [this](bool on) { workspace_.set_legend(on); });
    add_action("buffer-main", tr("Show the main &result"), nullptr, {K(Qt::Key_R)},
               [this] { workspace_.show_output(""); });
    add_action("buffer-next", tr("Show the &next buffer"), nullptr, {K(Qt::Key_PageDown)},
               [this] { workspace_.step_output(1); });
    add_action("buffer-previous", tr("Show the &previous buffer"), nullptr, {K(Qt::Key_PageUp)},
               [this] { workspace_.step_output(-1); });
}

void MainWindow::make_display_actions() {
    const auto change = [this](auto edit) {
        return [this, edit] {
            auto display = workspace_.display();
            edit(display);
            workspace_.choose_display(display);
        };
    };
    add_action("brighter", tr("&Brighter by half a stop"), nullptr, {K(Qt::Key_BracketRight)},
               [this] { step_exposure(0.5); });
    add_action("darker", tr("&Darker by half a stop"), nullptr, {K(Qt::Key_BracketLeft)},
               [this] { step_exposure(-0.5); });
    add_action("display-reset", tr("Colours and range by &themselves"), "range", {K(Qt::Key_Backslash)},
               [this] { workspace_.choose_automatic(); });
    add_action("marks", tr("&Mark NaN, Inf and negative values"), "marks", {K(Qt::Key_M)},
               change([](widgets::Display& display) { display.mark_bad = !display.mark_bad; }));
    add_action("zebra", tr("&Zebra where values leave the range"), nullptr, {K(Qt::Key_Z)},
               change([](widgets::Display& display) { display.zebra = !display.zebra; }));
}

void MainWindow::make_arrangement_actions() {
    using A = ViewArea::Arrangement;
    const auto add = [this](const char* name, const QString& text, const char* icon, Qt::Key key, A a) {
        add_action(name, text, icon, {K(Qt::CTRL | Qt::ALT | key)},
                   [this, a] { workspace_.area().arrange(a); });
    };
    add("views-1", tr("&One view"), "views-1", Qt::Key_1, A::one);
    add("views-2", tr("&Two views side by side"), "views-2", Qt::Key_2, A::side_by_side);
    add("views-3", tr("T&hree views"), "views-3", Qt::Key_3, A::three);
    add("views-4", tr("&Four views"), "views-4", Qt::Key_4, A::four);
    add("views-2-stacked", tr("Two views, one &below the other"), "views-2-stacked", Qt::Key_5, A::stacked);
    add_action("view-open", tr("Open &another view"), nullptr, {K(Qt::CTRL | Qt::Key_T)}, [this] {
        const auto before = workspace_.active_state();
        const int view = workspace_.area().open_another();
        if (view >= 0) workspace_.set_state(view, before);
    });
    add_action("view-close", tr("&Close the view"), nullptr, {K(Qt::CTRL | Qt::SHIFT | Qt::Key_W)},
               [this] { workspace_.area().close_view(workspace_.area().active()); });
    add_action("view-next", tr("&Next view"), nullptr, {K(Qt::Key_F6)},
               [this] { workspace_.area().step_active(1); });
    add_action("view-previous", tr("&Previous view"), nullptr, {K(Qt::SHIFT | Qt::Key_F6)},
               [this] { workspace_.area().step_active(-1); });
}

void MainWindow::make_compare_actions() {
    const auto add = [this](const char* name, ViewMode mode, Qt::Key key) {
        add_action(name, widgets::mode_name(mode), nullptr, {K(Qt::ALT | key)},
                   [this, mode] { workspace_.set_mode(mode); });
    };
    add("mode-single", ViewMode::single, Qt::Key_1);
    add("mode-side-by-side", ViewMode::side_by_side, Qt::Key_2);
    add("mode-wipe", ViewMode::wipe, Qt::Key_3);
    add("mode-flip", ViewMode::flip, Qt::Key_4);
    add("mode-difference", ViewMode::difference, Qt::Key_5);
    add("mode-stages", ViewMode::stages, Qt::Key_6);
    auto* stages = add_action("stages", tr("Filter &stages"), "stages", {K(Qt::ALT | Qt::Key_7)},
                              [this] { workspace_.show_stages(); });
    stages->setData(
        tr("The stages that the method names in a row, with the differences between them (Alt+7)"));
    add_action("swap", tr("&Swap A and B"), "swap", {K(Qt::Key_X)}, [this] { workspace_.swap(); });
    auto* link = add_switch("link", tr("&Link zoom, place, camera and colours of all views"), "link",
                            {K(Qt::Key_L)}, true, [this](bool on) { workspace_.set_linked(on); });
    connect(&workspace_, &Workspace::linked_changed, link, &QAction::setChecked);
}

void MainWindow::make_inspect_actions() {
    add_action("explain", tr("&How did this pixel come about?"), "explain", {K(Qt::Key_H)},
               [this] { inspector_.explain_cursor(); });
    add_action("explain-nothing", tr("&Explain nothing any longer"), nullptr, {K(Qt::SHIFT | Qt::Key_H)},
               [this] { inspector_.explain_nothing(); });
    add_action("pin", tr("&Pin the pixel under the cursor"), nullptr, {K(Qt::Key_P)},
               [this] { inspector_.pin_cursor(); });
}

void MainWindow::make_tool_actions() {
    using Tool = widgets::ImageView::Tool;
    auto* group = new QActionGroup(this);
    const auto add = [&](const char* name, const QString& text, Qt::Key key, Tool tool) {
        auto* action = add_action(name, text, name, {K(key)}, [this, tool] { workspace_.set_tool(tool); });
        action->setCheckable(true);
        action->setChecked(tool == Tool::inspect);
        group->addAction(action);
        connect(&workspace_, &Workspace::tool_changed, action, [action, tool](Tool now) {
            if (now == tool) action->setChecked(true);
        });
    };
    add("inspect", tr("&Inspect: drag moves the picture, a click marks a pixel"), Qt::Key_I, Tool::inspect);
    add("orbit", tr("&Orbit: drag turns the camera about its target"), Qt::Key_O, Tool::orbit);
    add("rectangle", tr("Re&ctangle: drag draws what metrics measure"), Qt::Key_B, Tool::rectangle);
    add("fly", tr("F&ly: drag looks around, W A S D moves"), Qt::Key_T, Tool::fly);
}

}  // namespace ir::gui
