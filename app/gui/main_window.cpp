#include "app/gui/main_window.h"

#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QMimeData>
#include <QUrl>

#include "widgets/style/icons.h"

namespace ir::gui {

MainWindow::MainWindow(Renderer& renderer, const Registry& registry, const Options& options)
    : options_(options),
      recent_(options.remember),
      samples_(options.remember),
      renderer_(renderer),
      session_(registry),
      kept_(session_),
      live_(session_, renderer, images_, kept_),
      playback_(session_, live_),
      scenes_(renderer),
      workspace_(session_, live_, renderer, images_, kept_, options.surface),
      inspector_(session_, live_, renderer, workspace_),
      metrics_(session_, live_, workspace_),
      references_(session_, live_, workspace_),
      exports_(session_, live_, renderer, workspace_) {
    setObjectName(QStringLiteral("main"));
    setWindowIcon(widgets::icon("app"));
    setAcceptDrops(true);
    setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
    setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    make_centre();
    make_docks();
    make_status_bar();
    make_file_actions();
    make_export_actions();
    make_edit_actions();
    make_result_actions();
    make_timeline_actions();
    make_view_actions();
    make_display_actions();
    make_arrangement_actions();
    make_compare_actions();
    make_inspect_actions();
    make_tool_actions();
    make_window_actions();
    make_menus();
    make_toolbar();
    connect_session();
    connect_panels();
    connect_views();
    connect_results();
    connect_plots();
    connect_benchmarks();
    connect_timeline();
    restore_window();
    update_document();
}

MainWindow::~MainWindow() {
    // Last words of the parts would reach half-destroyed widgets.
    for (QObject* part :
         {static_cast<QObject*>(&session_), static_cast<QObject*>(&renderer_), static_cast<QObject*>(&live_),
          static_cast<QObject*>(&workspace_), static_cast<QObject*>(&inspector_),
          static_cast<QObject*>(&kept_), static_cast<QObject*>(results_), static_cast<QObject*>(plots_),
          static_cast<QObject*>(benchmarks_), static_cast<QObject*>(&metrics_),
          static_cast<QObject*>(&scenes_), static_cast<QObject*>(&playback_)})
        part->disconnect(this);
}

bool MainWindow::is_settled() const {
    return live_.is_settled() && !images_.is_reading() && !kept_.is_busy() && workspace_.is_settled() &&
           metrics_.is_settled() && plots_->is_settled() && benchmarks_->is_settled();
}

void MainWindow::closeEvent(QCloseEvent* event) {
    document_->commit();
    if (!may_discard()) return event->ignore();
    benchmarks_->cancel();
    remember_window();
    store_memory();
    session_.close();
    event->accept();
}

void MainWindow::leave() {
    document_->commit();
    benchmarks_->cancel();
    remember_window();
    store_memory();
    session_.leave();
}

void MainWindow::changeEvent(QEvent* event) {
    QMainWindow::changeEvent(event);
    // Whoever comes back may have changed files elsewhere.
    if (event->type() != QEvent::ActivationChange || !isActiveWindow()) return;
    session_.look_at_files();
    kept_.look();
    plots_->look();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls() && event->mimeData()->urls().front().isLocalFile())
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    const QString path = event->mimeData()->urls().front().toLocalFile();
    event->acceptProposedAction();
    const auto ends_with = [&](std::initializer_list<const char*> suffixes) {
        for (const char* suffix : suffixes)
            if (path.endsWith(QLatin1String(suffix), Qt::CaseInsensitive)) return true;
        return false;
    };
    const bool writable = session_.has_project() && !session_.open_project().is_read_only();
    if (writable && ends_with({".gltf", ".glb"}))
        return void(run_file_step([&] { session_.add_scene(path.toStdString()); }, tr("Add scene")));
    if (writable && ends_with({".exr", ".png", ".hdr", ".jpg", ".jpeg", ".tif", ".tiff"}))
        return void(run_file_step([&] { session_.add_image(path.toStdString()); }, tr("Add image")));
    if (may_discard()) open_path(path);
}

}  // namespace ir::gui
