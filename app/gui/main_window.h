#pragma once

#include <QHash>
#include <QMainWindow>
#include <QSettings>
#include <map>

#include "app/gui/session.h"
#include "widgets/image/image_view.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/display_bar.h"
#include "widgets/panels/messages_panel.h"
#include "widgets/panels/rows_panel.h"
#include "widgets/panels/value_strip.h"
#include "widgets/panels/welcome_page.h"
#include "widgets/parameters/experiment_panel.h"
#include "widgets/parameters/parameter_panel.h"

class QLabel;
class QProgressBar;
class QStackedWidget;
class QToolButton;

namespace ir::gui {

/// Bumped when docks are added or renamed, so that a remembered arrangement of other docks is not applied.
inline constexpr int dock_version = 1;

/// The window: docks around one view, joined to a session. It shows what the session says and turns gestures
/// into the session's edits; it decides nothing about pictures or documents.
class MainWindow : public QMainWindow {
    Q_OBJECT
  public:
    struct Options {
        bool remember = true;  ///< keeps geometry, docks and recent projects between runs
        widgets::ImageView::Surface surface = widgets::ImageView::Surface::best;
    };
    MainWindow(Renderer& renderer, const Registry& registry, const Options& options);
    ~MainWindow() override;

    Session& session() { return session_; }
    widgets::ImageView& view() { return *view_; }
    widgets::BannerStack& banners() { return *banners_; }
    widgets::MessagesPanel& messages() { return *messages_; }
    QAction* action(const QString& name) const { return actions_.value(name); }

    /// A project, a scene file or builtin:NAME; failures become a banner and a message. Asks nothing.
    bool open_path(const QString& path);
    /// Throws UsageError that lists the known layouts.
    void apply_layout(const QString& name);
    static QStringList layout_names();
    /// Whether everything that is shown has arrived, or cannot.
    bool is_settled() const;

  signals:
    void settled();

  protected:
    void closeEvent(QCloseEvent*) override;
    void dragEnterEvent(QDragEnterEvent*) override;
    void dropEvent(QDropEvent*) override;

  private:
    // window_actions.cpp
    QAction* add_action(const QString& name, const QString& text, const char* icon_name,
                        const QList<QKeySequence>& keys, std::function<void()> run);
    QAction* add_switch(const QString& name, const QString& text, const char* icon_name,
                        const QList<QKeySequence>& keys, bool on, std::function<void(bool)> run);
    void make_file_actions();
    void make_edit_actions();
    void make_view_actions();
    void make_tool_actions();
    void make_menus();
    void make_toolbar();
    void show_shortcuts();
    void show_about();

    // window_docks.cpp
    void make_docks();
    QDockWidget* add_dock(const QString& name, const QString& title, QWidget* content,
                          Qt::DockWidgetArea area, const QKeySequence& key);
    void make_parameter_dock();
    void make_status_bar();
    void restore_default_layout();
    void restore_window();
    /// The welcome page stands alone; with a project the docks come back as they were.
    void show_docks(bool shown);

    // window_files.cpp
    bool run_file_step(const std::function<void()>& work, const QString& what);
    bool save();
    bool save_as();
    bool may_discard();
    void new_project();
    void choose_project();
    void add_recent(const QString& path);
    QStringList recent() const;
    void update_recent();
    void update_project_banners();
    void update_scene_banner();
    void locate_scene(std::size_t part);
    void accept_scene();

    // window_document.cpp
    void connect_session();
    void connect_panels();
    void update_document();
    void update_experiment_panel();
    void update_title();
    void update_edit_actions();
    void choose_camera(const QString& id);
    void use_scene_camera(const QString& name);
    void add_experiment();
    void rename_experiment();

    // window_view.cpp
    void make_centre();
    void connect_view();
    void show_picture(std::shared_ptr<const engine::LiveResult> result);
    void update_display();
    void choose_display(const widgets::Display& display);
    void update_lists(const engine::LiveResult& result);
    void update_scene_tree();
    void update_state();
    void update_camera();
    void step_exposure(double stops);
    void step_buffer(int step);
    void restore_view_memory();
    void store_view_memory();

    Options options_;
    Session session_;
    Renderer& renderer_;
    QHash<QString, QAction*> actions_;
    QList<QAction*> action_order_;
    QMenu *recent_menu_ = nullptr, *experiment_menu_ = nullptr, *docks_menu_ = nullptr;
    QStackedWidget* pages_ = nullptr;
    widgets::WelcomePage* welcome_ = nullptr;
    widgets::BannerStack* banners_ = nullptr;
    widgets::DisplayBar* display_bar_ = nullptr;
    widgets::ImageView* view_ = nullptr;
    widgets::ValueStrip* values_ = nullptr;
    widgets::ExperimentPanel* experiment_panel_ = nullptr;
    widgets::ParameterPanel* parameter_panel_ = nullptr;
    widgets::RowsPanel *scene_tree_ = nullptr, *buffers_ = nullptr, *timings_ = nullptr, *counters_ = nullptr;
    widgets::MessagesPanel* messages_ = nullptr;
    QLabel *state_label_ = nullptr, *device_label_ = nullptr;
    QProgressBar* progress_ = nullptr;
    QToolButton* cancel_button_ = nullptr;
    std::map<std::string, QImage> thumbnails_;
    std::map<std::string, widgets::Display> chosen_displays_;  ///< by buffer; absent: automatic
    QByteArray hidden_docks_;  ///< the arrangement while the welcome page is shown
    double exposure_ = 0;
    bool mark_bad_ = true;
};

}  // namespace ir::gui
