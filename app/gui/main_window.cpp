#include "app/gui/main_window.h"

#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QMimeData>
#include <QUrl>

#include "widgets/style/icons.h"

namespace ir::gui {

MainWindow::MainWindow(Renderer& renderer, const Registry& registry, const Options& options)
    : options_(options), session_(renderer, registry), renderer_(renderer) {
    setObjectName(QStringLiteral("main"));
    setWindowIcon(widgets::icon("app"));
    setAcceptDrops(true);
    setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
    setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    make_centre();
    make_docks();
    make_status_bar();
    make_file_actions();
    make_edit_actions();
    make_view_actions();
    make_tool_actions();
    make_menus();
    make_toolbar();
    connect_session();
    connect_panels();
    connect_view();
    restore_window();
    update_document();
    update_state();
}

MainWindow::~MainWindow() {
    // The session's last words would reach half-destroyed widgets.
    session_.disconnect(this);
    renderer_.disconnect(this);
}

bool MainWindow::is_settled() const {
    const auto state = session_.state();
    return state != Session::State::rendering;
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!may_discard()) return event->ignore();
    if (options_.remember) {
        QSettings settings;
        settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
        settings.setValue(QStringLiteral("window/docks"),
                          hidden_docks_.isEmpty() ? saveState(dock_version) : hidden_docks_);
    }
    store_view_memory();
    session_.close();
    event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls() && event->mimeData()->urls().front().isLocalFile())
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    const QString path = event->mimeData()->urls().front().toLocalFile();
    event->acceptProposedAction();
    const bool is_scene = path.endsWith(QStringLiteral(".gltf"), Qt::CaseInsensitive) ||
                          path.endsWith(QStringLiteral(".glb"), Qt::CaseInsensitive);
    if (is_scene && session_.has_project() && !session_.open_project().is_read_only())
        return void(run_file_step([&] { session_.add_scene(path.toStdString()); }, tr("Add scene")));
    if (may_discard()) open_path(path);
}

}  // namespace ir::gui
