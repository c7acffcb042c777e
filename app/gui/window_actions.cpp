#include <QApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QMessageBox>

#include "app/engine/version.h"
#include "app/gui/dialog_folder.h"
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
        document_->commit();
        if (may_discard()) {
            store_memory();
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
               [this] { document_->add_experiment(); });
    add_action("experiment-duplicate", tr("&Duplicate experiment"), "copy",
               {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_D)}, [this] {
                   const std::string id = session_.experiment()->id;
                   const bool done = session_.edit([&](const projects::Project& project) {
                       return projects::edits::duplicate<projects::Experiment>(project, id);
                   });
                   if (!done) return;
                   const auto& list = session_.document().experiments;
                   const auto* original = projects::find_item(list, id);
                   session_.select_experiment((original + 1)->id);
               });
    add_action("experiment-rename", tr("Re&name experiment …"), nullptr,
               {QKeySequence(Qt::SHIFT | Qt::Key_F2)}, [this] {
                   findChild<QDockWidget*>(QStringLiteral("project"))->raise();
                   document_->select(
                       {widgets::ItemKind::experiment, QString::fromStdString(session_.experiment()->id)});
                   document_->editor().setFocus();
               });
    add_action("experiment-remove", tr("Re&move experiment"), "clear",
               {QKeySequence(Qt::CTRL | Qt::Key_Delete)}, [this] {
                   const std::string id = session_.experiment()->id;
                   session_.edit([&](const projects::Project& project) {
                       return projects::edits::remove<projects::Experiment>(project, id);
                   });
               });
    add_action("scene-add", tr("Add s&cene …"), nullptr, {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_S)},
               [this] { document_->add_scene(); });
    add_action("image-add", tr("Add &image of another renderer …"), nullptr,
               {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_I)}, [this] { document_->add_image(); });
    add_action("bookmark", tr("&Bookmark the view"), "bookmark", {QKeySequence(Qt::CTRL | Qt::Key_B)},
               [this] { session_.bookmark_camera(); });
    add_action("comparison-add", tr("Keep the view as a com&parison"), nullptr,
               {QKeySequence(Qt::CTRL | Qt::Key_K)}, [this] { document_->add_comparison(); });
}

void MainWindow::export_to(const QString& suffix, const QString& filter,
                           void (Exports::*save)(const QString&) const) {
    QString file =
        QFileDialog::getSaveFileName(this, tr("Export"), export_proposal(exports_.title(), suffix), filter);
    if (file.isEmpty()) return;
    remember_export(file);
    if (!file.endsWith(suffix, Qt::CaseInsensitive)) file += suffix;
    if (run_file_step([&] { (exports_.*save)(file); }, tr("Cannot export")))
        status_->say(tr("Wrote %1").arg(file));
}

void MainWindow::make_export_actions() {
    using K = QKeySequence;
    add_action("export-view", tr("View as shown, with labels and legend (&PNG) …"), "export",
               {K(Qt::CTRL | Qt::SHIFT | Qt::Key_P)},
               [this] { export_to(".png", tr("PNG (*.png)"), &Exports::save_view); });
    add_action("export-buffer", tr("Buffer (&EXR) …"), nullptr, {K(Qt::CTRL | Qt::SHIFT | Qt::Key_E)},
               [this] { export_to(".exr", tr("OpenEXR (*.exr)"), &Exports::save_buffer); });
    add_action("export-values", tr("&Values (CSV) …"), nullptr, {K(Qt::CTRL | Qt::SHIFT | Qt::Key_V)},
               [this] { export_to(".csv", tr("Comma-separated values (*.csv)"), &Exports::save_values); });
    add_action("export-all", tr("&All buffers in one file (EXR) …"), nullptr,
               {K(Qt::CTRL | Qt::SHIFT | Qt::Key_A)},
               [this] { export_to(".exr", tr("OpenEXR (*.exr)"), &Exports::save_all_buffers); });
}

void MainWindow::make_window_actions() {
    using K = QKeySequence;
    add_action("cancel", tr("&Cancel rendering"), "cancel", {K(Qt::Key_Escape)}, [this] { live_.cancel(); });
    add_action("rerun", tr("Render &again"), "rerun", {K(Qt::Key_F5)}, [this] { live_.render_again(); });
    add_action("shaders", tr("Reload &shaders"), nullptr, {K(Qt::SHIFT | Qt::Key_F5)},
               [this] { renderer_.reload_shaders(); });
    add_action("layout-default", tr("Restore Default &Layout"), nullptr,
               {K(Qt::CTRL | Qt::SHIFT | Qt::Key_L)}, [this] { restore_default_layout(); });
    add_switch("full-screen", tr("F&ull screen"), nullptr, {K(Qt::Key_F11)}, false,
               [this](bool on) { setWindowState(windowState().setFlag(Qt::WindowFullScreen, on)); });
    add_action("shortcuts", tr("&Keyboard shortcuts …"), nullptr, {K(Qt::Key_F1)},
               [this] { show_shortcuts(); });
    add_action("about", tr("&About Interreflect"), nullptr, {}, [this] { show_about(); });
}

void MainWindow::show_shortcuts() {
    const QList<QPair<QString, QString>> gestures = {
        {tr("Zoom the picture about the cursor"), tr("Wheel")},
        {tr("Move the picture"), tr("Middle drag, Space+drag")},
        {tr("Mark a pixel (Inspect)"), tr("Click")},
        {tr("Explain a pixel (Inspect)"), tr("Shift+click")},
        {tr("See one of several pictures (Wipe, Flip, Difference)"), tr("Hold 1 … 9")},
        {tr("Choose two of a row to be compared (Stages)"), tr("1 … 9, 0 for none")},
        {tr("Go on to the next picture (Flip)"), tr("Tab")},
        {tr("Move the divider (Wipe)"), tr("Drag it")},
        {tr("Move, resize the rectangle (Rectangle)"), tr("Drag, arrows; Shift+arrows")},
        {tr("Clear the rectangle (Rectangle)"), tr("Esc, Del")},
        {tr("Turn, slide, approach, frame (3D)"), tr("Drag, Shift+drag, wheel, double click")},
        {tr("Choose what an element stands for (3D, sphere)"), tr("Click it")},
        {tr("Turn the camera about its target (Orbit)"), tr("Drag")},
        {tr("Look around (Fly)"), tr("Drag")},
        {tr("Slide the camera (Orbit, Fly)"), tr("Shift+drag, right drag")},
        {tr("Camera nearer or farther (Orbit, Fly)"), tr("Ctrl+wheel")},
        {tr("Move the camera (Fly)"), tr("W A S D, Q E; Shift is faster")},
        {tr("Load a point's setting (Plots)"), tr("Click, Enter")},
        {tr("Walk through points (Plots)"), tr("Arrows, Home, End")},
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
