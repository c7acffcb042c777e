#pragma once

#include <QHash>
#include <QMainWindow>
#include <QSettings>
#include <map>

#include "app/gui/benchmark_dock.h"
#include "app/gui/document_dock.h"
#include "app/gui/exports.h"
#include "app/gui/known_projects.h"
#include "app/gui/metrics_dock.h"
#include "app/gui/pixel_inspector.h"
#include "app/gui/plots_dock.h"
#include "app/gui/references.h"
#include "app/gui/results_dock.h"
#include "app/gui/scene_shelf.h"
#include "app/gui/status_line.h"
#include "app/gui/timeline_dock.h"
#include "app/gui/workspace.h"
#include "widgets/inspect/display_panel.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/messages_panel.h"
#include "widgets/panels/rows_panel.h"
#include "widgets/panels/welcome_page.h"
#include "widgets/parameters/experiment_panel.h"
#include "widgets/parameters/parameter_panel.h"

class QLabel;
class QStackedWidget;

namespace ir::gui {

/// Bumped when docks are added or renamed, so that a remembered arrangement of other docks is not applied.
inline constexpr int dock_version = 7;

/// The window: menus, docks and the views in their middle. It joins parts that know nothing of each other and
/// decides nothing about pictures or documents.
class MainWindow : public QMainWindow {
    Q_OBJECT
  public:
    struct Options {
        bool remember = true;  ///< keeps geometry, docks and recent projects between runs
        widgets::ImageView::Surface surface = widgets::ImageView::Surface::best;
        engine::MachineOptions machine = {};            ///< of studies and benchmarks
        engine::StudyRunner study_runner = {};          ///< without one they are carried out by that machine
        engine::BenchmarkRunner benchmark_runner = {};  ///< as above
    };
    MainWindow(Renderer& renderer, const Registry& registry, const Options& options);
    ~MainWindow();

    Session& session() { return session_; }
    LivePictures& live() { return live_; }
    Workspace& workspace() { return workspace_; }
    PixelInspector& inspector() { return inspector_; }
    MetricsDock& metrics() { return metrics_; }
    DocumentDock& document() { return *document_; }
    ResultsDock& results() { return *results_; }
    PlotsDock& plots() { return *plots_; }
    BenchmarkDock& benchmarks() { return *benchmarks_; }
    Playback& playback() { return playback_; }
    TimelineDock& timeline() { return *timeline_; }
    References& references() { return references_; }
    KeptResults& kept() { return kept_; }
    Exports& exports() { return exports_; }
    /// The picture of the active view.
    widgets::ImageView& view() { return workspace_.active_pane().compare().main_view(); }
    widgets::BannerStack& banners() { return *banners_; }
    widgets::MessagesPanel& messages() { return *messages_; }
    QAction* action(const QString& name) const { return actions_.value(name); }

    /// A project, a scene file or builtin:NAME; failures become a banner and a message. Asks nothing. A
    /// sample is opened as a copy.
    bool open_path(const QString& path);
    /// Brings the plots forward, and one of them.
    void show_plot(const std::string& id);
    /// Throws UsageError that lists the known layouts.
    void apply_layout(const QString& name);
    static QStringList layout_names();
    /// Arranges the window for what a screen has for windows. One that has less than least_for_all_panels
    /// (window_geometry.h) has an arrangement of its own: the panels of both sides stand behind each other,
    /// so that four views of whatever project find room beside them.
    void fit(const QRect& available);
    void fit_screen();  ///< fit() for the screen that the window is on
    /// As closing, but asks nothing: Session::leave().
    void leave();
    /// Whether everything that is shown has arrived, or cannot. Workspace::missing() says what cannot.
    bool is_settled() const;

  protected:
    void closeEvent(QCloseEvent*) override;
    void changeEvent(QEvent*) override;
    void dragEnterEvent(QDragEnterEvent*) override;
    void dropEvent(QDropEvent*) override;

  private:
    // window_actions.cpp
    QAction* add_action(const QString& name, const QString& text, const char* icon_name,
                        const QList<QKeySequence>& keys, std::function<void()> run);
    QAction* add_switch(const QString& name, const QString& text, const char* icon_name,
                        const QList<QKeySequence>& keys, bool on, std::function<void(bool)> run);
    void make_file_actions();
    void make_export_actions();
    void make_edit_actions();
    void make_window_actions();
    void show_shortcuts();
    void show_about();

    // window_view_actions.cpp
    void make_view_actions();
    void make_display_actions();
    void make_arrangement_actions();
    void make_compare_actions();
    void make_inspect_actions();
    void make_tool_actions();

    // window_menus.cpp
    void make_menus();
    void make_toolbar();
    void update_actions();

    // window_docks.cpp
    void make_centre();
    void make_docks();
    QDockWidget* add_dock(const QString& name, const QString& title, QWidget* content,
                          const QKeySequence& key);
    QWidget* make_parameter_dock();
    QWidget* make_timings_dock();
    void make_status_bar();
    void watch_docks();
    void restore_default_layout();
    void arrange_docks();
    QByteArray docks() const;  ///< the arrangement, as it is with a project
    void set_cramped(bool cramped);
    void restore_window();
    void remember_window() const;
    /// The welcome page stands alone; with a project the docks come back as they were.
    void show_docks(bool shown);

    // window_results.cpp
    void make_result_actions();
    void connect_results();
    void update_result_actions();

    // window_plots.cpp
    void connect_plots();
    void connect_benchmarks();

    // window_timeline.cpp
    void make_timeline_actions();
    void connect_timeline();

    // window_files.cpp
    bool run_file_step(const std::function<void()>& work, const QString& what);
    bool save();
    bool save_as();
    bool may_discard();
    void new_project();
    void choose_project();
    void save_thumbnail();
    void update_recent();
    void say_copy(const QString& sample, const projects::SampleCopy& copy);
    void begin_sample_afresh(const QString& sample, const projects::SampleCopy& copy);
    void store_memory();

    // window_banners.cpp
    void update_project_banners();
    void update_scene_banner();
    void update_state_banner();
    void locate_scene(const std::string& scene, std::size_t part);
    void accept_scene(const std::string& scene);

    // window_document.cpp
    void connect_session();
    void connect_panels();
    void update_document();
    void update_experiment_panel();
    void update_title();
    void choose_camera(const QString& id);
    void use_scene_camera(const QString& name);

    // window_panels.cpp
    void connect_views();
    void update_display_panel();
    void update_lists();
    void update_scene_tree();
    void update_camera();
    void step_exposure(double stops);
    void choose_item_of_element(const std::string& owner, const std::string& buffer, qint64 element);
    void go_to(const Message& message);
    void export_to(const QString& suffix, const QString& filter, void (Exports::*save)(const QString&) const);

    Options options_;
    RecentProjects recent_;
    Samples samples_;
    Renderer& renderer_;
    Session session_;
    ImageLoader images_;
    KeptResults kept_;
    LivePictures live_;
    Playback playback_;
    SceneShelf scenes_;
    Workspace workspace_;
    PixelInspector inspector_;
    MetricsDock metrics_;
    References references_;
    Exports exports_;
    QHash<QString, QAction*> actions_;
    QList<QAction*> action_order_;
    QMenu *recent_menu_ = nullptr, *experiment_menu_ = nullptr;
    QStackedWidget* pages_ = nullptr;
    widgets::WelcomePage* welcome_ = nullptr;
    widgets::BannerStack* banners_ = nullptr;
    widgets::ExperimentPanel* experiment_panel_ = nullptr;
    widgets::ParameterPanel* parameter_panel_ = nullptr;
    DocumentDock* document_ = nullptr;
    ResultsDock* results_ = nullptr;
    PlotsDock* plots_ = nullptr;
    BenchmarkDock* benchmarks_ = nullptr;
    TimelineDock* timeline_ = nullptr;
    widgets::DisplayPanel* display_ = nullptr;
    widgets::RowsPanel *scene_tree_ = nullptr, *buffers_ = nullptr, *timings_ = nullptr, *counters_ = nullptr;
    widgets::MessagesPanel* messages_ = nullptr;
    StatusLine* status_ = nullptr;
    QLabel* device_label_ = nullptr;
    std::map<std::string, QImage> thumbnails_;
    QByteArray hidden_docks_;  ///< the arrangement while the welcome page is shown
    QByteArray other_docks_;   ///< that of small screens on a large one, and the other way round
    bool has_hidden_docks_ = false, is_cramped_ = false;
};

}  // namespace ir::gui
