#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QMenuBar>
#include <QMessageBox>
#include <QToolBar>

#include "app/engine/version.h"
#include "app/gui/main_window.h"
#include "widgets/panels/shortcuts_dialog.h"
#include "widgets/style/icons.h"

namespace ir::gui {

QAction* MainWindow::add_action(const QString& name, const QString& text, const char* icon_name,
                                const QList<QKeySequence>& keys, std::function<void()> run) {
    auto* action = new QAction(text, this);
    action->setObjectName(name);
    if (icon_name) action->setIcon(widgets::icon(icon_name));
    action->setShortcuts(keys);
    QString tip = text;
    tip.remove(QLatin1Char('&'));
    if (!keys.isEmpty()) tip += QStringLiteral(" (%1)").arg(keys.front().toString(QKeySequence::NativeText));
    action->setToolTip(tip);
    connect(action, &QAction::triggered, this, [run = std::move(run)] { run(); });
    addAction(action);
    actions_.insert(name, action);
    action_order_ << action;
    return action;
}

QAction* MainWindow::add_switch(const QString& name, const QString& text, const char* icon_name,
                                const QList<QKeySequence>& keys, bool on, std::function<void(bool)> run) {
    auto* action = add_action(name, text, icon_name, keys, [] {});
    action->setCheckable(true);
    action->setChecked(on);
    connect(action, &QAction::toggled, this, std::move(run));
    return action;
}

void MainWindow::make_file_actions() {
    add_action("new", tr("&New project from a scene …"), "new", {QKeySequence(Qt::CTRL | Qt::Key_N)},
               [this] { new_project(); });
    add_action("open", tr("&Open project …"), "open", {QKeySequence(Qt::CTRL | Qt::Key_O)},
               [this] { choose_project(); });
    add_action("save", tr("&Save"), "save", {QKeySequence(Qt::CTRL | Qt::Key_S)}, [this] { save(); });
    add_action("save-as", tr("Save &as …"), nullptr, {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S)},
               [this] { save_as(); });
    add_action("close", tr("&Close project"), nullptr, {QKeySequence(Qt::CTRL | Qt::Key_W)}, [this] {
        if (may_discard()) {
            store_view_memory();
            session_.close();
        }
    });
    add_action("quit", tr("&Quit"), nullptr, {QKeySequence(Qt::CTRL | Qt::Key_Q)}, [this] { close(); });
}

void MainWindow::make_edit_actions() {
    add_action("undo", tr("&Undo"), "undo", {QKeySequence(Qt::CTRL | Qt::Key_Z)},
               [this] { session_.undo(); });
    add_action("redo", tr("&Redo"), "redo",
               {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_Z), QKeySequence(Qt::CTRL | Qt::Key_Y)},
               [this] { session_.redo(); });
    add_action("experiment-add", tr("&Add experiment"), "add", {QKeySequence(Qt::CTRL | Qt::Key_E)},
               [this] { add_experiment(); });
    add_action("experiment-duplicate", tr("&Duplicate experiment"), "copy",
               {QKeySequence(Qt::CTRL | Qt::Key_D)}, [this] {
                   const std::string id = session_.experiment()->id;
                   const bool done = session_.edit([&](const projects::Project& project) {
                       return projects::edits::duplicate<projects::Experiment>(project, id);
                   });
                   if (!done) return;
                   const auto& list = session_.document().experiments;
                   const auto* original = projects::find_item(list, id);
                   session_.select_experiment((original + 1)->id);
               });
    add_action("experiment-rename", tr("Re&name experiment …"), nullptr, {QKeySequence(Qt::Key_F2)},
               [this] { rename_experiment(); });
    add_action("experiment-remove", tr("Re&move experiment"), "clear",
               {QKeySequence(Qt::CTRL | Qt::Key_Delete)}, [this] {
                   const std::string id = session_.experiment()->id;
                   session_.edit([&](const projects::Project& project) {
                       return projects::edits::remove<projects::Experiment>(project, id);
                   });
               });
}

void MainWindow::make_view_actions() {
    using K = QKeySequence;
    add_action("fit", tr("&Fit picture"), "fit", {K(Qt::Key_F)}, [this] { view_->fit(); });
    add_action("actual", tr("&Actual pixels, 1:1"), "actual", {K(Qt::Key_1)},
               [this] { view_->actual_pixels(); });
    add_action("zoom-in", tr("Zoom &in"), "zoom-in",
               {K(Qt::CTRL | Qt::Key_Plus), K(Qt::CTRL | Qt::Key_Equal)}, [this] { view_->zoom_in(); });
    add_action("zoom-out", tr("Zoom &out"), "zoom-out", {K(Qt::CTRL | Qt::Key_Minus)},
               [this] { view_->zoom_out(); });
    add_switch("grid", tr("Pixel &grid and numbers"), "grid", {K(Qt::Key_G)}, true,
               [this](bool on) { view_->set_pixel_grid(on); });
    add_switch("marks", tr("&Mark NaN, Inf and negative values"), "marks", {K(Qt::Key_M)}, true,
               [this](bool on) {
                   mark_bad_ = on;
                   update_display();
               });
    add_action("brighter", tr("&Brighter by half a stop"), nullptr, {K(Qt::Key_BracketRight)},
               [this] { step_exposure(0.5); });
    add_action("darker", tr("&Darker by half a stop"), nullptr, {K(Qt::Key_BracketLeft)},
               [this] { step_exposure(-0.5); });
    add_action("exposure-reset", tr("&Reset exposure"), nullptr, {K(Qt::Key_Backslash)},
               [this] { step_exposure(-exposure_); });
    add_action("buffer-main", tr("Show the main &result"), nullptr, {K(Qt::Key_R)},
               [this] { session_.show_buffer(""); });
    add_action("buffer-next", tr("Show the &next buffer"), nullptr, {K(Qt::Key_PageDown)},
               [this] { step_buffer(1); });
    add_action("buffer-previous", tr("Show the &previous buffer"), nullptr, {K(Qt::Key_PageUp)},
               [this] { step_buffer(-1); });
    add_action("cancel", tr("&Cancel rendering"), "cancel", {K(Qt::Key_Escape)},
               [this] { session_.cancel(); });
    add_action("rerun", tr("Render &again"), "rerun", {K(Qt::Key_F5)}, [this] { session_.render_again(); });
    add_action("shaders", tr("Reload &shaders"), nullptr, {K(Qt::SHIFT | Qt::Key_F5)},
               [this] { session_.reload_shaders(); });
    add_action("layout-default", tr("Restore Default &Layout"), nullptr,
               {K(Qt::CTRL | Qt::SHIFT | Qt::Key_L)}, [this] { restore_default_layout(); });
    add_switch("full-screen", tr("F&ull screen"), nullptr, {K(Qt::Key_F11)}, false,
               [this](bool on) { setWindowState(windowState().setFlag(Qt::WindowFullScreen, on)); });
    add_action("shortcuts", tr("&Keyboard shortcuts …"), nullptr, {K(Qt::Key_F1)},
               [this] { show_shortcuts(); });
    add_action("about", tr("&About Interreflect"), nullptr, {}, [this] { show_about(); });
}

void MainWindow::make_tool_actions() {
    using Tool = widgets::ImageView::Tool;
    auto* group = new QActionGroup(this);
    const auto add = [&](const char* name, const QString& text, Qt::Key key, Tool tool) {
        auto* action =
            add_action(name, text, name, {QKeySequence(key)}, [this, tool] { view_->set_tool(tool); });
        action->setCheckable(true);
        action->setChecked(tool == Tool::inspect);
        group->addAction(action);
        connect(view_, &widgets::ImageView::tool_changed, action, [action, tool](Tool now) {
            if (now == tool) action->setChecked(true);
        });
    };
    add("inspect", tr("&Inspect: drag moves the picture, a click marks a pixel"), Qt::Key_I, Tool::inspect);
    add("orbit", tr("&Orbit: drag turns the camera about its target"), Qt::Key_O, Tool::orbit);
    add("fly", tr("F&ly: drag looks around, W A S D moves"), Qt::Key_L, Tool::fly);
}

void MainWindow::make_menus() {
    const auto fill = [this](QMenu* menu, std::initializer_list<const char*> names) {
        for (const char* name : names)
            *name ? menu->addAction(actions_.value(QLatin1String(name))) : void(menu->addSeparator());
    };
    auto* file = menuBar()->addMenu(tr("&File"));
    fill(file, {"new", "open"});
    recent_menu_ = file->addMenu(tr("Open &recent"));
    fill(file, {"", "save", "save-as", "", "close", "quit"});
    auto* edit = menuBar()->addMenu(tr("&Edit"));
    fill(edit, {"undo", "redo", "", "experiment-add", "experiment-duplicate", "experiment-rename",
                "experiment-remove"});
    experiment_menu_ = new QMenu(this);
    fill(experiment_menu_,
         {"experiment-add", "experiment-duplicate", "experiment-rename", "experiment-remove"});
    experiment_panel_->set_menu(experiment_menu_);
    auto* view = menuBar()->addMenu(tr("&View"));
    fill(view,
         {"inspect", "orbit", "fly", "", "fit", "actual", "zoom-in", "zoom-out", "", "grid", "marks", "",
          "brighter", "darker", "exposure-reset", "", "buffer-main", "buffer-next", "buffer-previous"});
    auto* render = menuBar()->addMenu(tr("&Render"));
    fill(render, {"cancel", "rerun", "shaders"});
    docks_menu_ = menuBar()->addMenu(tr("&Window"));
    for (auto* dock : findChildren<QDockWidget*>()) {
        docks_menu_->addAction(dock->toggleViewAction());
        action_order_ << dock->toggleViewAction();
    }
    fill(docks_menu_, {"", "layout-default", "full-screen"});
    auto* help = menuBar()->addMenu(tr("&Help"));
    fill(help, {"shortcuts", "about"});
    update_recent();
}

void MainWindow::make_toolbar() {
    auto* bar = addToolBar(tr("Main tools"));
    bar->setObjectName(QStringLiteral("toolbar"));
    bar->setIconSize(QSize(18, 18));
    bar->setMovable(false);
    bar->setContextMenuPolicy(Qt::PreventContextMenu);
    for (const char* name :
         {"new", "open", "save",   "",        "undo",     "redo", "",      "inspect", "orbit", "fly",
          "",    "fit",  "actual", "zoom-in", "zoom-out", "grid", "marks", "",        "rerun", "cancel"})
        *name ? bar->addAction(actions_.value(QLatin1String(name))) : void(bar->addSeparator());
}

void MainWindow::show_shortcuts() {
    const QList<QPair<QString, QString>> gestures = {
        {tr("Zoom the picture about the cursor"), tr("Wheel")},
        {tr("Move the picture"), tr("Middle drag, Space+drag")},
        {tr("Mark a pixel (Inspect)"), tr("Click")},
        {tr("Turn the camera about its target (Orbit)"), tr("Drag")},
        {tr("Look around (Fly)"), tr("Drag")},
        {tr("Slide the camera (Orbit, Fly)"), tr("Shift+drag, right drag")},
        {tr("Camera nearer or farther (Orbit, Fly)"), tr("Ctrl+wheel")},
        {tr("Move the camera (Fly)"), tr("W A S D, Q E; Shift is faster")},
    };
    auto* dialog = new widgets::ShortcutsDialog(action_order_, gestures, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
}

void MainWindow::show_about() {
    QMessageBox::about(
        this, tr("About Interreflect"),
        tr("<b>Interreflect %1</b><p>A workbench for research on interactive global illumination.</p>")
            .arg(QString::fromStdString(engine::version())));
}

}  // namespace ir::gui
