#include "app/gui/view_controller.h"

#include <QActionGroup>
#include <algorithm>

#include "app/gui/stage_chain.h"

namespace ir::gui {

using widgets::Display;
using widgets::ViewArea;
using widgets::ViewMode;
using K = QKeySequence;

ViewController::ViewController(Session& session, LivePictures& live, Playback& playback, SceneShelf& scenes,
                               Workspace& workspace, PixelInspector& inspector,
                               widgets::DisplayPanel& display, Actions& actions)
    : session_(session),
      scenes_(scenes),
      workspace_(workspace),
      views_(workspace.views()),
      inspector_(inspector),
      display_(display),
      actions_(actions) {
    add_view_actions();
    add_display_actions();
    add_arrangement_actions();
    add_compare_actions();
    add_inspect_actions();
    add_tool_actions();
    enable_with_experiment(session_, all_);
    follow(session_, this, &ViewController::update_stages);
    connect(&live, &LivePictures::state_changed, this, &ViewController::update_stages);
    update_stages();
    connect(&views_, &ViewModel::active_changed, this, &ViewController::update_display);
    connect(&workspace_, &Workspace::picture_shown, this, &ViewController::update_display);
    using Panel = widgets::DisplayPanel;
    connect(&display_, &Panel::display_chosen, &workspace_, &Workspace::choose_display);
    connect(&display_, &Panel::automatic_chosen, this, [this] { views_.choose_display({}); });
    connect(&scenes_, &SceneShelf::changed, this, [this] {
        const auto* scene = scenes_.current();
        session_.camera().set_scene_cameras(scene ? scene->camera_values : std::vector<scene::Camera>());
        update_cameras();
    });
    connect(&views_, &ViewModel::active_changed, this, &ViewController::update_cameras);
    connect(&playback, &Playback::changed, this, &ViewController::update_cameras);
    follow(session_, this, &ViewController::update_cameras);
}

QAction* ViewController::add(const char* name, const QString& text, const char* icon,
                             const QList<QKeySequence>& keys, std::function<void()> run) {
    return all_.emplace_back(actions_.add(name, text, icon, keys, std::move(run)));
}

void ViewController::add_view_actions() {
    const auto zoom = [this](int steps) {
        return [this, steps] { workspace_.active_pane().compare().active_view().zoom(steps); };
    };
    add("fit", tr("&Fit picture"), "fit", {K(Qt::Key_F)}, [this] {
        auto& pane = workspace_.active_pane();
        if (pane.content() == widgets::ViewPane::Content::space) return pane.space().view().frame_all();
        pane.compare().active_view().fit();
    });
    add("actual", tr("&Actual pixels, 1:1"), "actual", {K(Qt::CTRL | Qt::Key_0)},
        [this] { workspace_.active_pane().compare().active_view().actual_pixels(); });
    add("zoom-in", tr("&Zoom in"), "zoom-in", {K(Qt::CTRL | Qt::Key_Plus), K(Qt::CTRL | Qt::Key_Equal)},
        zoom(1));
    add("zoom-out", tr("Zoom o&ut"), "zoom-out", {K(Qt::CTRL | Qt::Key_Minus)}, zoom(-1));
    all_ << actions_.add_switch("grid", tr("Pixel &grid and numbers"), "grid", {K(Qt::Key_G)}, true,
                                [this](bool on) { workspace_.tools().set_pixel_grid(on); });
    all_ << actions_.add_switch("legend", tr("L&egend"), nullptr, {K(Qt::SHIFT | Qt::Key_G)}, true,
                                [this](bool on) { workspace_.tools().set_legend(on); });
    add("buffer-main", tr("Show the main &result"), nullptr, {K(Qt::Key_R)},
        [this] { views_.show_output(""); });
    add("buffer-next", tr("Show the ne&xt buffer"), nullptr, {K(Qt::Key_PageDown)},
        [this] { step_output(1); });
    add("buffer-previous", tr("Show the pre&vious buffer"), nullptr, {K(Qt::Key_PageUp)},
        [this] { step_output(-1); });
}

void ViewController::step_output(int step) {
    const auto& pictures = views_.pictures();
    const auto outputs = pictures.outputs(views_.active_state().a.owner);
    if (outputs.empty()) return;
    const auto* now = pictures.find(outputs, views_.shown_key());
    const int count = int(outputs.size()), at = now ? int(now - outputs.data()) : 0;
    views_.show_output(outputs[std::size_t((at + step + count) % count)].key);
}

void ViewController::change_display(const std::function<void(Display&)>& change) {
    auto display = workspace_.display();
    change(display);
    workspace_.choose_display(display);
}

void ViewController::add_display_actions() {
    const auto expose = [this](double stops) {
        change_display(
            [&](Display& display) { display.exposure = std::clamp(display.exposure + stops, -40.0, 40.0); });
    };
    add("brighter", tr("&Brighter by half a stop"), nullptr, {K(Qt::Key_BracketRight)},
        [expose] { expose(0.5); });
    add("darker", tr("&Darker by half a stop"), nullptr, {K(Qt::Key_BracketLeft)},
        [expose] { expose(-0.5); });
    add("display-reset", tr("Au&tomatic colours and range"), "range", {K(Qt::Key_Backslash)},
        [this] { views_.choose_display({}); });
    // Called as in the panel.
    const auto add_switch = [this](const char* name, const QString& text, const char* icon, Qt::Key key,
                                   bool Display::*member) {
        auto* action = add(name, text, icon, {K(key)}, [this, member] {
            change_display([member](Display& display) { display.*member = !(display.*member); });
            update_switches();  // also where nothing has changed
        });
        action->setCheckable(true);
        action->setChecked(Display().*member);
        switches_.emplace_back(action, member);
    };
    add_switch("marks", tr("&Mark NaN and Inf"), "marks", Qt::Key_M, &Display::mark_bad);
    add_switch("zebra", tr("Stripes beyond the range"), nullptr, Qt::Key_Z, &Display::zebra);
}

void ViewController::add_arrangement_actions() {
    using A = ViewArea::Arrangement;
    auto& area = workspace_.area();
    const auto add_arrangement = [&](const char* name, const QString& text, Qt::Key key, A arrangement,
                                     const char* icon) {
        add(name, text, icon, {K(Qt::CTRL | Qt::ALT | key)},
            [&area, arrangement] { area.arrange(arrangement); });
    };
    add_arrangement("views-1", tr("&One view"), Qt::Key_1, A::one, "views-1");
    add_arrangement("views-2", tr("&Two views side by side"), Qt::Key_2, A::side_by_side, "views-2");
    add_arrangement("views-3", tr("T&hree views"), Qt::Key_3, A::three, "views-3");
    add_arrangement("views-4", tr("&Four views"), Qt::Key_4, A::four, "views-4");
    add_arrangement("views-2-stacked", tr("Two views, one &below the other"), Qt::Key_5, A::stacked,
                    "views-2-stacked");
    add("view-open", tr("Open &another view"), nullptr, {K(Qt::CTRL | Qt::Key_T)}, [this] {
        const auto before = views_.active_state();
        const int view = workspace_.area().open_another();
        if (view >= 0) views_.set_state(view, before);
    });
    add("view-close", tr("&Close the view"), nullptr, {K(Qt::CTRL | Qt::SHIFT | Qt::Key_W)},
        [&area] { area.close_view(area.active()); });
    add("view-next", tr("&Next view"), nullptr, {K(Qt::Key_F6)}, [&area] { area.step_active(1); });
    add("view-previous", tr("Pre&vious view"), nullptr, {K(Qt::SHIFT | Qt::Key_F6)},
        [&area] { area.step_active(-1); });
}

void ViewController::add_compare_actions() {
    const auto add_mode = [this](const char* name, ViewMode mode, Qt::Key key) {
        add(name, widgets::mode_entry(mode), nullptr, {K(Qt::ALT | key)},
            [this, mode] { workspace_.set_mode(mode); });
    };
    add_mode("mode-single", ViewMode::single, Qt::Key_1);
    add_mode("mode-side-by-side", ViewMode::side_by_side, Qt::Key_2);
    add_mode("mode-wipe", ViewMode::wipe, Qt::Key_3);
    add_mode("mode-lens", ViewMode::lens, Qt::Key_8);
    add_mode("mode-flip", ViewMode::flip, Qt::Key_4);
    add_mode("mode-difference", ViewMode::difference, Qt::Key_5);
    add_mode("mode-stages", ViewMode::stages, Qt::Key_6);
    auto* stages = actions_.add("stages", tr("Filter &stages"), "stages", {K(Qt::ALT | Qt::Key_7)},
                                [this] { show_stages(); });
    stages->setData(
        tr("The stages that the method names in a row, with the differences between them (Alt+7)"));
    add("swap", tr("&Swap A and B"), "swap", {K(Qt::Key_X)},
        [this] { workspace_.active_pane().compare().swap(); });
    auto* link = actions_.add_switch("link", tr("&Link zoom, place, camera and colours of all views"), "link",
                                     {K(Qt::Key_L)}, true, [this](bool on) { views_.set_linked(on); });
    all_ << link;
    connect(&views_, &ViewModel::linked_changed, link, &QAction::setChecked);
}

void ViewController::show_stages() {
    auto state = views_.active_state();
    state.mode = ViewMode::stages;
    state.as_table = false;
    state.chain = true;
    views_.set_active_state(std::move(state));
}

void ViewController::add_inspect_actions() {
    add("explain", tr("&How did this pixel come about?"), "explain", {K(Qt::Key_H)},
        [this] { inspector_.explain_cursor(); });
    add("explain-nothing", tr("Stop explaining"), nullptr, {K(Qt::SHIFT | Qt::Key_H)},
        [this] { inspector_.explain_nothing(); });
    add("pin", tr("&Pin the pixel under the cursor"), nullptr, {K(Qt::Key_P)},
        [this] { inspector_.pin_cursor(); });
}

void ViewController::add_tool_actions() {
    using Tool = widgets::ImageView::Tool;
    auto* group = new QActionGroup(this);
    const auto add_tool = [&](const char* name, const QString& text, Qt::Key key, Tool tool) {
        auto* action = add(name, text, name, {K(key)}, [this, tool] { workspace_.tools().set_tool(tool); });
        action->setCheckable(true);
        action->setChecked(tool == Tool::inspect);
        group->addAction(action);
        connect(&workspace_.tools(), &PictureTools::tool_changed, action, [action, tool](Tool now) {
            if (now == tool) action->setChecked(true);
        });
    };
    add_tool("inspect", tr("&Inspect: drag moves the picture, a click marks a pixel"), Qt::Key_I,
             Tool::inspect);
    add_tool("orbit", tr("&Orbit: drag turns the camera about its target"), Qt::Key_O, Tool::orbit);
    add_tool("rectangle", tr("Re&ctangle: drag draws what metrics and profile measure"), Qt::Key_B,
             Tool::rectangle);
    add_tool("line", tr("Li&ne: drag draws where values of all shown pictures are plotted"), Qt::Key_N,
             Tool::line);
    add_tool("fly", tr("F&ly: drag looks around, W A S D moves"), Qt::Key_T, Tool::fly);
}

void ViewController::update_display() {
    if (!session_.has_project() || !workspace_.pane(workspace_.area().active())) return;
    const bool picture = workspace_.active_pane().content() == widgets::ViewPane::Content::picture;
    const auto shown = picture ? workspace_.display_picture() : nullptr;
    if (shown && !shown->draft.isEmpty()) return;  // its values are not those of the picture
    display_.set_picture(shown);
    if (!shown || !shown->has_image()) return;
    display_.set_display(workspace_.display(), workspace_.is_automatic());
    update_switches();
}

void ViewController::update_switches() {
    const auto display = workspace_.display();
    for (const auto& [action, member] : switches_) action->setChecked(display.*member);
}

void ViewController::update_stages() {
    auto* action = actions_.find("stages");
    action->setEnabled(has_stages(session_, views_.active_state().a.owner));
    action->setToolTip(action->data().toString() +
                       (action->isEnabled() ? QString() : tr(".\nThis method names none.")));
}

void ViewController::update_cameras() {
    const auto pose = session_.camera().pose();
    const auto* scene = scenes_.current();
    for (const int number : workspace_.area().open_views()) {
        auto* pane = workspace_.pane(number);
        if (!pane) continue;
        const bool worked_on =
            session_.experiment() && views_.state(number).a.owner == session_.experiment()->id;
        if (pose && worked_on) pane->compare().set_camera(*pose);
        if (!scene) continue;
        // Crossing the scene takes about six seconds.
        pane->compare().panes().set_fly_speed(std::max(0.05, double(scene->bounds.radius()) / 3));
        if (pane->content() == widgets::ViewPane::Content::space)
            pane->space().view().set_bounds({glm::dvec3(scene->bounds.min), glm::dvec3(scene->bounds.max)});
    }
}

}  // namespace ir::gui
