#pragma once

#include <QMainWindow>

#include "app/gui/analyses_dock.h"
#include "app/gui/benchmark_dock.h"
#include "app/gui/dock_layout.h"
#include "app/gui/edit_controller.h"
#include "app/gui/export_controller.h"
#include "app/gui/figure_controller.h"
#include "app/gui/file_controller.h"
#include "app/gui/film_controller.h"
#include "app/gui/finder.h"
#include "app/gui/frame_lists.h"
#include "app/gui/frames_dock.h"
#include "app/gui/layout_controller.h"
#include "app/gui/light_controller.h"
#include "app/gui/light_mover.h"
#include "app/gui/light_offer.h"
#include "app/gui/metrics_dock.h"
#include "app/gui/note_links.h"
#include "app/gui/parameter_dock.h"
#include "app/gui/pipeline_dock.h"
#include "app/gui/plots_dock.h"
#include "app/gui/preferences.h"
#include "app/gui/profile_dock.h"
#include "app/gui/project_banners.h"
#include "app/gui/report_controller.h"
#include "app/gui/result_controller.h"
#include "app/gui/scene_dock.h"
#include "app/gui/set_up_controller.h"
#include "app/gui/shader_controller.h"
#include "app/gui/space_marker.h"
#include "app/gui/surface_picker.h"
#include "app/gui/sweeps_dock.h"
#include "app/gui/timeline_dock.h"
#include "app/gui/view_controller.h"
#include "widgets/panels/manual_window.h"

class QLabel;
class QStackedWidget;

namespace ir::gui {

/// The window: menus, docks and the views in their middle. It joins parts that know nothing of each other and
/// decides nothing about pictures or documents.
class MainWindow : public QMainWindow {
    Q_OBJECT
  public:
    struct Options {
        bool remember = true;  ///< keeps geometry, docks, preferences and recent projects between runs
        widgets::ImageView::Surface surface = widgets::ImageView::Surface::best;
        bool drafts = true;                             ///< where the preferences want them
        std::string theme = {};                         ///< of the command line
        engine::MachineFlags machine = {};              ///< of the command line
        engine::StudyRunner study_runner = {};          ///< without one they get machines of their own
        engine::BenchmarkRunner benchmark_runner = {};  ///< as above
        engine::SweepRunner sweep_runner = {};          ///< as above
        engine::AnalysisRunner analysis_runner = {};    ///< as above
    };
    MainWindow(Renderer& renderer, const Registry& registry, const Options& options);

    Session& session() { return session_; }
    LivePictures& live() { return live_; }
    Workspace& workspace() { return workspace_; }
    ViewModel& views() { return workspace_.views(); }
    PixelInspector& inspector() { return inspector_; }
    MetricsDock& metrics() { return metrics_; }
    ProfileDock& profile() { return profile_; }
    DocumentDock& document() { return *document_; }
    ResultsDock& results() { return *results_; }
    PlotsDock& plots() { return *plots_; }
    BenchmarkDock& benchmarks() { return *benchmarks_; }
    Playback& playback() { return playback_; }
    TimelineDock& timeline() { return *timeline_; }
    References& references() { return references_; }
    ExportController& export_controller() { return export_; }
    ReportController& reports() { return report_; }
    DockLayout& docks() { return docks_; }
    /// The picture of the active view.
    widgets::ImageView& view() { return workspace_.active_pane().compare().main_view(); }
    widgets::BannerStack& banners() { return *banners_; }
    widgets::MessagesPanel& messages() { return *messages_; }
    QAction* action(const QString& name) const { return actions_.find(name); }

    bool open_path(const QString& path) { return files_.open(path); }
    /// Brings the plots forward, and one of them.
    void show_plot(const std::string& id);
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
    void add_actions();
    void make_centre(bool wants_opengl);
    void make_docks();
    void make_status_bar();
    void make_menus();
    void make_toolbar();
    void join_session();
    void join_pictures();
    void join_panels();
    template <typename Do>
    void with_remembered(Do&& each);
    void save_memory();
    void load_memory();
    void update_frame();
    void edit_in_document();
    void go_to(const Message& message);
    void end_work();
    void show_page(const QString& file, const QString& key = {});
    void show_shortcuts();
    void show_about();

    bool remember_;
    Renderer& renderer_;
    Preferences preferences_;
    Session session_;
    ImageLoader images_;
    KeptResults kept_;
    LivePictures live_;
    Playback playback_;
    SceneShelf scenes_;
    Workspace workspace_;
    PixelInspector inspector_;
    MetricsDock metrics_;
    ProfileDock profile_;
    widgets::BannerStack* banners_;  ///< as all widgets the window's
    References references_;
    Exports exports_;
    widgets::WelcomePage* welcome_;
    widgets::NotesStrip* notes_;
    QStackedWidget* pages_;
    widgets::MessagesPanel* messages_;
    widgets::DisplayPanel* display_;
    StatusLine* status_;
    QLabel* device_label_;
    QMenu* picture_menu_ = nullptr;
    Notices notices_;
    DocumentDock* document_;
    ResultsDock* results_;
    PlotsDock* plots_;
    SweepsDock* sweeps_;
    AnalysesDock* analyses_;
    BenchmarkDock* benchmarks_;
    ParameterDock* parameters_;
    SceneDock* scene_;
    ShaderDock* shaders_;
    FrameLists lists_;
    Actions actions_;
    DockLayout docks_;
    FileController files_;
    ExportController export_;
    ReportController report_;
    SetUpController set_ups_;
    LayoutController layouts_;
    FilmController film_;
    FramesDock frames_;
    FigureController figure_;
    EditController edits_;
    ResultController result_actions_;
    TimelineDock* timeline_;
    CameraPath camera_path_;
    SpaceMarker space_marker_;
    ViewController view_actions_;
    PipelineDock pipeline_;
    ShaderController shader_copies_;
    PreferencesController preference_actions_;
    ProjectBanners project_banners_;
    SurfacePicker surfaces_;
    LightController lights_;
    LightMover light_mover_;
    LightOffer light_offer_;
    Finder finder_;
    NoteLinks note_links_;
    widgets::ManualWindow* manual_ = nullptr;
    QObject joins_;  ///< ends the connections between parts before the first of them goes
};

}  // namespace ir::gui
