#include "app/gui/main_window.h"

#include <QCloseEvent>
#include <QDesktopServices>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QUrl>
#include <QVBoxLayout>

#include "app/engine/version.h"
#include "app/gui/display_dock.h"
#include "app/gui/gestures.h"
#include "app/gui/json_fields.h"
#include "app/gui/patient_files.h"
#include "app/gui/text_of.h"
#include "widgets/panels/shortcuts_dialog.h"
#include "widgets/style/icons.h"

namespace ir::gui {
namespace {

/// In lower windows, logical pixels, notes open folded: the pictures need the room.
constexpr int min_height_for_notes = 850;

/// Its size is asked neither of the panels that share its place nor of the window.
QScrollArea* scrolled(QWidget* panel) {
    auto* scroll = new QScrollArea;
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidget(panel);
    scroll->setWidgetResizable(true);
    return scroll;
}

}  // namespace

MainWindow::MainWindow(Renderer& renderer, const Registry& registry, const Options& options)
    : remember_(options.remember),
      renderer_(renderer),
      preferences_(options.remember, options.machine, options.theme),
      session_(registry),
      kept_(session_),
      live_(session_, renderer, images_, kept_),
      playback_(session_, live_),
      scenes_(renderer),
      workspace_(session_, live_, renderer, images_, kept_, options.surface),
      inspector_(session_, live_, renderer, workspace_),
      metrics_(session_, live_, workspace_),
      profile_(session_, workspace_),
      banners_(new widgets::BannerStack),
      references_(session_, live_, views(), *banners_),
      exports_(session_, live_, renderer, workspace_),
      welcome_(new widgets::WelcomePage),
      notes_(new widgets::NotesStrip),
      pages_(new QStackedWidget),
      messages_(new widgets::MessagesPanel),
      display_(new widgets::DisplayPanel),
      status_(new StatusLine(session_, live_)),
      device_label_(new QLabel(tr("starting …"))),
      notices_(*status_, *messages_, *banners_),
      document_(new DocumentDock(session_, scenes_, workspace_)),
      results_(new ResultsDock(session_, live_, renderer_, views(), kept_)),
      plots_(new PlotsDock(session_, preferences_, options.study_runner)),
      sweeps_(new SweepsDock(session_, preferences_, options.sweep_runner)),
      analyses_(new AnalysesDock(session_, preferences_, options.analysis_runner, options.surface)),
      benchmarks_(new BenchmarkDock(session_, preferences_, options.benchmark_runner)),
      parameters_(new ParameterDock(session_, scenes_, notices_)),
      scene_(new SceneDock(session_, scenes_)),
      shaders_(new ShaderDock(renderer_, options.machine)),
      lists_(session_, preferences_, live_, workspace_),
      actions_(*this),
      docks_(*this, workspace_.area(), actions_),
      files_(*this, session_, workspace_, notices_, *welcome_, actions_, options.remember),
      export_(*this, session_, renderer_, workspace_, exports_, notices_, actions_),
      report_(*this, session_, live_, renderer_, *document_, notices_, actions_),
      set_ups_(*this, session_, live_, workspace_, actions_),
      layouts_(*this, docks_, workspace_, actions_, remember_),
      film_(*this, session_, live_, workspace_, preferences_, notices_, actions_),
      frames_(*this, session_, live_, workspace_, notices_, actions_),
      figure_(*this, session_, workspace_, notices_, actions_),
      edits_(session_, *document_, actions_),
      result_actions_(session_, live_, playback_, views(), references_, *results_, *document_, actions_),
      timeline_(new TimelineDock(session_, live_, playback_, actions_)),
      camera_path_(*this, session_, live_, playback_, workspace_, notices_, actions_),
      space_marker_(*this, session_, live_, renderer_, workspace_, inspector_, camera_path_, playback_,
                    notices_, actions_),
      view_actions_(session_, live_, playback_, scenes_, workspace_, inspector_, *display_, actions_),
      pipeline_(session_, live_, views(), inspector_, lists_, notices_, actions_),
      shader_copies_(*this, session_, live_, *shaders_, pipeline_, notices_, actions_),
      preference_actions_(*this, preferences_, renderer_, live_, actions_, options.drafts),
      project_banners_(*this, session_, live_, *banners_),
      surfaces_(session_, live_, renderer_, workspace_, inspector_, *document_, docks_, notices_, actions_),
      lights_(session_, live_, renderer_, scenes_, workspace_, inspector_, actions_),
      light_mover_(session_, workspace_, *document_, docks_, actions_),
      light_offer_(session_, scenes_, lights_, *banners_),
      finder_(*this, session_, scenes_, workspace_, *document_, *parameters_, docks_, layouts_, files_,
              actions_),
      note_links_(*notes_, session_, workspace_, inspector_, docks_, finder_, notices_) {
    setObjectName(QStringLiteral("main"));
    setWindowIcon(widgets::icon("app"));
    setAcceptDrops(true);
    add_actions();
    make_centre(options.surface == widgets::ImageView::Surface::best);
    make_docks();
    make_status_bar();
    make_menus();
    make_toolbar();
    join_session();
    join_pictures();
    join_panels();
    resize(1440, 900);
    docks_.restore_default();
    if (remember_) docks_.restore();
    update_frame();
}

void MainWindow::add_actions() {
    using K = QKeySequence;
    auto* cancel = actions_.add("cancel", tr("&Cancel rendering"), "cancel", {K(Qt::Key_Escape)},
                                [this] { live_.cancel(); });
    const auto update_cancel = [this, cancel] { cancel->setEnabled(!live_.is_settled()); };
    connect(&live_, &LivePictures::state_changed, &joins_, update_cancel);
    follow(session_, &joins_, update_cancel);
    update_cancel();
    enable_with_experiment(session_, {actions_.add("rerun", tr("Render &again"), "rerun", {K(Qt::Key_F5)},
                                                   [this] { live_.render_again(); })});
    actions_.add("shaders", tr("Reload &shaders"), nullptr, {K(Qt::SHIFT | Qt::Key_F5)},
                 [this] { renderer_.reload_shaders(); });
    actions_.add_switch("full-screen", tr("F&ull screen"), nullptr, {K(Qt::SHIFT | Qt::Key_F11)}, false,
                        [this](bool on) { setWindowState(windowState().setFlag(Qt::WindowFullScreen, on)); });
    actions_.add("shortcuts", tr("&Keyboard shortcuts …"), nullptr, {K(Qt::Key_F1)},
                 [this] { show_shortcuts(); });
    actions_.add("manual", tr("&Manual"), nullptr, {ParameterDock::explain_key()},
                 [this] { parameters_->explain(); });
    actions_.add("about", tr("&About Interreflect"), nullptr, {}, [this] { show_about(); });
}

void MainWindow::make_centre(bool wants_opengl) {
    auto* centre = new QWidget;
    auto* layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(banners_);
    layout->addWidget(notes_);
    layout->addWidget(pages_, 1);
    pages_->addWidget(welcome_);
    pages_->addWidget(&workspace_.area());
    setCentralWidget(centre);
    if (wants_opengl && !widgets::has_opengl())
        banners_->show_banner(QStringLiteral("opengl"), widgets::BannerStack::Kind::note,
                              tr("This screen offers no OpenGL 3.3; pictures are painted by the processor. "
                                 "All functions work, only slower."));
}

void MainWindow::make_docks() {
    using K = QKeySequence;
    display_->setMinimumWidth(300);
    docks_.add("parameters", tr("&Parameters"), parameters_, K(Qt::CTRL | Qt::Key_1));
    docks_.add("project", tr("Pro&ject"), document_, K(Qt::CTRL | Qt::Key_2));
    docks_.add("display", tr("&Display"), new DisplayDock(display_, workspace_, views()),
               K(Qt::CTRL | Qt::Key_3));
    docks_.add("scene", tr("&Scene"), scene_, K(Qt::CTRL | Qt::Key_4));
    docks_.add("buffers", tr("Buffers"), &lists_.buffers(), K(Qt::CTRL | Qt::Key_5));
    docks_.add("inspector", tr("&Inspector"), &inspector_.panel(), K(Qt::CTRL | Qt::Key_6));
    docks_.add("explain", tr("E&xplain"), &inspector_.explain_panel(), K(Qt::CTRL | Qt::Key_7));
    docks_.add("metrics", tr("&Metrics"), &metrics_.panel(), K(Qt::CTRL | Qt::SHIFT | Qt::Key_M));
    docks_.add("timings", tr("Timin&gs"), &lists_.timings(), K(Qt::CTRL | Qt::Key_8));
    docks_.add("messages", tr("Messages"), messages_, K(Qt::CTRL | Qt::Key_9));
    docks_.add("results", tr("&Results"), results_, K(Qt::CTRL | Qt::SHIFT | Qt::Key_R));
    docks_.add("plots", tr("Plots"), scrolled(plots_), K(Qt::CTRL | Qt::SHIFT | Qt::Key_G));
    docks_.add("sweeps", tr("S&weeps"), sweeps_, K(Qt::CTRL | Qt::SHIFT | Qt::Key_X));
    docks_.add("analyses", tr("Anal&yses"), analyses_, K(Qt::CTRL | Qt::SHIFT | Qt::Key_Y));
    docks_.add("timeline", tr("Timeline"), scrolled(timeline_), K(Qt::CTRL | Qt::SHIFT | Qt::Key_T));
    docks_.add("frames", tr("Last frames"), &frames_.panel(), K(Qt::CTRL | Qt::SHIFT | Qt::Key_J));
    docks_.add("benchmarks", tr("Benchmar&ks"), benchmarks_, K(Qt::CTRL | Qt::SHIFT | Qt::Key_B));
    docks_.add("profile", tr("Profile"), &profile_.panel(), K(Qt::CTRL | Qt::SHIFT | Qt::Key_N));
    docks_.add("pipeline", tr("Pipeline"), &pipeline_.panel(), K(Qt::CTRL | Qt::SHIFT | Qt::Key_F));
    docks_.add("shaders", tr("Shaders"), shaders_, K(Qt::CTRL | Qt::SHIFT | Qt::Key_O));
    // Panels behind tabs and closed ones ask for nothing.
    connect(&docks_, &DockLayout::seen_changed, &joins_, [this] {
        inspector_.set_visible(docks_.is_seen("inspector"), docks_.is_seen("explain"));
        inspector_.set_thumbnails_wanted(docks_.is_seen("buffers") || docks_.is_seen("pipeline"));
        pipeline_.set_visible(docks_.is_seen("pipeline"));
        results_->set_visible_to_user(docks_.is_seen("results"));
        plots_->set_visible_to_user(docks_.is_seen("plots"));
        sweeps_->set_visible_to_user(docks_.is_seen("sweeps"));
        analyses_->set_visible_to_user(docks_.is_seen("analyses"));
        metrics_.set_visible(docks_.is_seen("metrics"));
        profile_.set_visible(docks_.is_seen("profile"), docks_.is_seen("metrics"));
    });
}

void MainWindow::make_status_bar() {
    connect(status_, &StatusLine::cancel_wanted, &joins_, [this] { live_.cancel(); });
    device_label_->setObjectName(QStringLiteral("device"));
    statusBar()->addWidget(status_, 1);
    statusBar()->addPermanentWidget(device_label_);
}

void MainWindow::make_menus() {
    const auto add_menu = [this](const QString& title, const char* names) {
        auto* menu = menuBar()->addMenu(title);
        actions_.fill(menu, names);
        return menu;
    };
    auto* file = add_menu(tr("&File"), "new open");
    file->addMenu(files_.recent_menu());
    actions_.fill(file, "| save save-as |");
    actions_.fill(file->addMenu(tr("&Export")),
                  "copy-view export-view export-buffer export-values | export-all film | show-in-tev");
    actions_.fill(file, "report figure | close quit");
    file->setToolTipsVisible(true);
    add_menu(
        tr("&Edit"),
        "undo redo find | experiment-add experiment-duplicate experiment-rename experiment-remove match | "
        "scene-add image-add bookmark comparison-add | camera-key-add camera-key-set camera-key-remove "
        "camera-key-previous camera-key-next | light-here light-camera headlight | edit-material edit-object | "
        "preferences")
        ->setToolTipsVisible(true);
    auto* set_up = menuBar()->addMenu(tr("&Set up"));
    actions_.fill(set_up, "set-ups | set-up-occlusion set-up-light match set-up-space stages");
    set_up->setToolTipsVisible(true);
    auto* experiment = new QMenu(this);
    actions_.fill(experiment,
                  "experiment-add experiment-duplicate experiment-rename experiment-remove | "
                  "match keep");
    experiment->setToolTipsVisible(true);
    parameters_->set_menu(experiment);
    add_menu(
        tr("&View"),
        "inspect orbit fly rectangle line | fit actual zoom-in zoom-out | grid legend light-handles marks zebra | "
        "brighter darker display-reset | buffer-main buffer-next buffer-previous stages | "
        "explain explain-nothing trace-pixel whole-frame pin fly-to-pin");
    add_menu(tr("&Compare"),
             "mode-single mode-side-by-side mode-wipe mode-lens mode-flip mode-difference mode-stages | "
             "swap link | comparison-add");
    picture_menu_ = new QMenu(this);
    actions_.fill(picture_menu_,
                  "edit-material edit-object | light-here light-camera headlight | explain trace-pixel pin "
                  "fly-to-pin | rectangle line | bookmark camera-key-add | "
                  "fit actual | copy-view export-view export-buffer show-in-tev");
    picture_menu_->setToolTipsVisible(true);
    add_menu(
        tr("&Render"),
        "cancel rerun shaders edit-shader | play step-forward step-back | past-older past-newer past-now past-keep | match keep")
        ->setToolTipsVisible(true);
    auto* window = add_menu(tr("&Window"),
                            "views-1 views-2 views-2-stacked views-3 views-4 | "
                            "view-open view-close view-next view-previous |");
    docks_.fill(window);
    window->addSeparator();
    window->addMenu(layouts_.menu());
    actions_.fill(window, "pictures-alone full-screen");
    add_menu(tr("&Help"), "manual shortcuts about");
}

void MainWindow::make_toolbar() {
    auto* bar = addToolBar(tr("Main tools"));
    bar->setObjectName(QStringLiteral("toolbar"));
    bar->setIconSize(QSize(18, 18));
    bar->setMovable(false);
    bar->setContextMenuPolicy(Qt::PreventContextMenu);
    actions_.fill(
        bar,
        "new open save | undo redo | inspect orbit fly rectangle line | fit actual zoom-in zoom-out "
        "grid | views-1 views-2 views-3 views-4 link | stages explain bookmark | rerun cancel");
}

void MainWindow::join_session() {
    connect(&session_, &Session::project_replaced, &joins_, [this] {
        if (!session_.has_project()) scenes_.clear();
        notices_.forget_project();
        update_frame();  // before the views, which want to be seen and have the focus
        load_memory();
        project_banners_.update();
    });
    connect(&session_, &Session::document_changed, &joins_, [this] { update_frame(); });
    connect(&session_.files(), &ProjectFiles::memory_wanted, &joins_, [this] { save_memory(); });
    connect(&files_, &FileController::ending, &joins_, [this] { document_->commit(); });
    connect(&project_banners_, &ProjectBanners::save_as_wanted, &files_, &FileController::save_as);
    connect(&project_banners_, &ProjectBanners::shaders_wanted, &joins_, [this] { docks_.raise("shaders"); });
}

void MainWindow::join_pictures() {
    connect(&live_, &LivePictures::composition_resolved, &joins_,
            [this](const std::vector<scene::Part>& parts) {
                scenes_.set_place("scene:" + session_.experiment()->scene);
                scenes_.choose(parts);
            });
    connect(&session_, &Session::message, &notices_, &Notices::add);
    connect(&live_, &LivePictures::message, &notices_, &Notices::add);
    connect(&scenes_, &SceneShelf::message, &notices_, &Notices::add);
    connect(&renderer_, &Renderer::messages_arrived, &joins_, [this](const std::vector<Message>& messages) {
        for (const auto& each : messages) notices_.add(each);
    });
    connect(&renderer_, &Renderer::ready, &joins_,
            [this](const std::string& backend, const std::string& device) {
                device_label_->setText(
                    QStringLiteral("%1 · %2").arg(text_of(backend).toUpper(), text_of(device)));
                banners_->hide_banner(QStringLiteral("device"));
            });
    connect(&renderer_, &Renderer::no_device, &joins_, [this](const std::string& error) {
        device_label_->setText(tr("no device"));
        notices_.fail(QStringLiteral("device"), "gl", text_of(error));
    });
}

void MainWindow::join_panels() {
    connect(&preferences_, &Preferences::maps_changed, &workspace_, &Workspace::show_displays);
    connect(messages_, &widgets::MessagesPanel::go_to, &joins_,
            [this](const Message& message) { go_to(message); });
    connect(&workspace_, &Workspace::menu_wanted, &joins_,
            [this](QPoint position) { picture_menu_->popup(position); });
    connect(&lights_, &LightController::said, &notices_, &Notices::say);
    connect(&inspector_, &PixelInspector::said, &notices_, &Notices::say);
    connect(&lights_, &LightController::added, &joins_, [this](const widgets::ItemRef& light) {
        docks_.raise("project");
        document_->select(light);
    });
    connect(&lists_, &FrameLists::export_wanted, action("export-buffer"), &QAction::trigger);
    lists_.add_actions({action("pin"), action("explain")});
    connect(&pipeline_, &PipelineDock::wanted, &joins_, [this] { docks_.raise("pipeline"); });
    connect(&profile_, &ProfileDock::drawn, &joins_, [this] { docks_.raise("profile"); });
    connect(&profile_, &ProfileDock::emptied, &joins_, [this] { docks_.hide("profile"); });
    connect(shaders_, &ShaderDock::wanted, &joins_, [this] { docks_.raise("shaders"); });
    connect(shaders_, &ShaderDock::emptied, &joins_, [this] { docks_.hide("shaders"); });
    preference_actions_.follow(shaders_->panel(), inspector_.explain_panel(), *banners_);
    connect(&finder_, &Finder::page_wanted, &joins_, [this](const QString& file) { show_page(file); });
    connect(parameters_, &ParameterDock::page_wanted, &joins_,
            [this](const QString& file, const QString& key) { show_page(file, key); });
    connect(parameters_, &ParameterDock::sweep_wanted, &joins_, [this] { docks_.raise("sweeps"); });
    connect(parameters_, &ParameterDock::sweep_wanted, sweeps_, &SweepsDock::sweep_parameter);
    connect(scene_, &SceneDock::camera_chosen, parameters_, &ParameterDock::use_scene_camera);
    connect(&edits_, &EditController::edit_wanted, &joins_, [this] { edit_in_document(); });
    connect(&document_->tree(), &widgets::ProjectPanel::item_activated, &joins_,
            [this](const widgets::ItemRef& item) {
                const auto id = item.id.toStdString();
                if (item.kind == widgets::ItemKind::plot) show_plot(id);
                if (item.kind == widgets::ItemKind::sweep) docks_.raise("sweeps"), sweeps_->show_sweep(id);
                if (item.kind == widgets::ItemKind::analysis)
                    docks_.raise("analyses"), analyses_->show_analysis(id);
            });
    const auto select = [this](const QString& id) { session_.select_experiment(id.toStdString()); };
    connect(plots_, &PlotsDock::loaded, &joins_, select);
    connect(sweeps_, &SweepsDock::loaded, &joins_, select);
    connect(sweeps_, &SweepsDock::report_wanted, &report_, &ReportController::ask_for_sweep);
    const auto edit = [this](widgets::ItemKind kind) {
        return [this, kind](const QString& id) {
            document_->select({kind, id});
            edit_in_document();
        };
    };
    connect(plots_, &PlotsDock::edit_wanted, &joins_, edit(widgets::ItemKind::plot));
    connect(sweeps_, &SweepsDock::edit_wanted, &joins_, edit(widgets::ItemKind::sweep));
    connect(analyses_, &AnalysesDock::edit_wanted, &joins_, edit(widgets::ItemKind::analysis));
    connect(&frames_, &FramesDock::analysis_added, &joins_, [this] { docks_.raise("analyses"); });
    connect(analyses_, &AnalysesDock::shown, &notices_, [this] { notices_.forget("analyses"); });
    connect(analyses_, &AnalysesDock::shown, document_, &DocumentDock::follow_analysis);
    notices_.follow(*results_, "results");
    notices_.follow(*plots_, "plots");
    notices_.follow(*sweeps_, "sweeps");
    notices_.follow(*analyses_, "analyses");
    notices_.follow(*benchmarks_, "benchmarks");
    notices_.follow(*shaders_, "shaders");
}

/// What is remembered of a project beside it.
template <typename Do>
void MainWindow::with_remembered(Do&& each) {
    each(workspace_);
    each(inspector_);
    each(metrics_);
    each(profile_);
    each(pipeline_);
    each(figure_);
    each(frames_);
    each(*plots_);
    each(*sweeps_);
    each(*analyses_);
    each(*benchmarks_);
    each(playback_);
}

void MainWindow::save_memory() {
    auto& memory = session_.files().memory();
    with_remembered([&](auto& part) { part.save(memory); });
    memory["notes"] = {{"folded", notes_->is_folded()}};
}

void MainWindow::load_memory() {
    const auto& memory = session_.files().memory();
    with_remembered([&](auto& part) { part.load(memory); });
    notes_->set_folded(field_or(member_or_null(memory, "notes"), "folded", height() < min_height_for_notes));
}

/// The page, and the title.
void MainWindow::update_frame() {
    const bool has_project = session_.has_project();
    pages_->setCurrentIndex(has_project ? 1 : 0);
    docks_.show(has_project);
    notes_->set_notes(has_project ? text_of(session_.document().notes) : QString());
    if (!has_project) return setWindowModified(false), setWindowTitle(tr("Interreflect"));
    const auto& project = session_.open_project();
    const QString name = text_of(session_.document().name.empty() ? "untitled" : session_.document().name);
    const QString place =
        project.folder().empty() ? tr("not saved yet") : text_of(project.folder().filename().string());
    setWindowTitle(tr("%1[*] (%2)%3 – Interreflect")
                       .arg(name, place, project.is_read_only() ? tr(", read-only") : QString()));
    setWindowModified(project.is_dirty());
}

void MainWindow::edit_in_document() {
    docks_.raise("project");
    document_->editor().setFocus();
}

void MainWindow::show_plot(const std::string& id) {
    docks_.raise("plots");
    plots_->set_visible_to_user(true);
    plots_->show_plot(id);
}

/// From a message to where it can be mended: a file's line, an item of the project, a buffer.
void MainWindow::go_to(const Message& message) {
    if (message.source == "shader") return docks_.raise("shaders");
    const QString place = text_of(message.place);
    const QFileInfo file(place.section(QLatin1Char(':'), 0, 0));
    if (file.exists()) return void(QDesktopServices::openUrl(QUrl::fromLocalFile(file.absoluteFilePath())));
    if (const auto item = widgets::ItemRef::from_key(place); item.is_valid()) {
        docks_.raise("project");
        if (item.kind == widgets::ItemKind::experiment) session_.select_experiment(item.id.toStdString());
        return document_->select(item);
    }
    const auto* chosen = session_.experiment();
    const auto result = chosen ? live_.result(chosen->id) : nullptr;
    if (result && find_resource(result->report, message.place)) return views().show_output(message.place);
    docks_.raise("timings");
}

bool MainWindow::is_settled() const {
    return !patient_files().is_waiting() && live_.is_settled() && !images_.is_reading() && !kept_.is_busy() &&
           workspace_.is_settled() && metrics_.is_settled() && profile_.is_settled() &&
           pipeline_.is_settled() && figure_.is_settled() && plots_->is_settled() && sweeps_->is_settled() &&
           analyses_->is_settled() && benchmarks_->is_settled();
}

void MainWindow::end_work() {
    benchmarks_->cancel();
    sweeps_->cancel();
    analyses_->cancel();
    profile_.leave();
    layouts_.end_pictures_alone();
    if (remember_) docks_.remember();
}

void MainWindow::closeEvent(QCloseEvent* event) {
    document_->commit();
    if (!files_.may_discard()) return event->ignore();
    end_work();
    session_.files().close();
    event->accept();
}

void MainWindow::leave() {
    document_->commit();
    end_work();
    session_.files().leave();
}

void MainWindow::changeEvent(QEvent* event) {
    QMainWindow::changeEvent(event);
    // Whoever comes back may have changed files elsewhere.
    if (event->type() != QEvent::ActivationChange || !isActiveWindow()) return;
    session_.files().look_at_files();
    kept_.look();
    plots_->look();
    sweeps_->look();
    analyses_->look();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls() && event->mimeData()->urls().front().isLocalFile())
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    event->acceptProposedAction();
    files_.take(event->mimeData()->urls().front().toLocalFile());
}

void MainWindow::show_shortcuts() {
    auto* dialog = new widgets::ShortcutsDialog(actions_.in_order(), gestures(), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
}

void MainWindow::show_page(const QString& file, const QString& key) {
    if (!manual_) manual_ = new widgets::ManualWindow(this);
    manual_->show_page(file, key);
}

void MainWindow::show_about() {
    QMessageBox::about(
        this, tr("About Interreflect"),
        tr("<b>Interreflect %1</b><p>A workbench for research on interactive global illumination.</p>")
            .arg(QString::fromStdString(engine::version_and_commit())));
}

}  // namespace ir::gui
