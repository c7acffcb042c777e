#pragma once

#include <QTimer>
#include <QWidget>
#include <filesystem>
#include <map>
#include <string>

#include "app/gui/preferences.h"
#include "app/gui/session.h"
#include "app/gui/sweep_rows.h"
#include "app/gui/sweep_runs.h"
#include "widgets/models/newest_job.h"
#include "widgets/sweeps/sweep_panel.h"

namespace ir::gui {

/// The project's sweeps: runs one at a time into results/sweeps/ID of the project, shows what is there, also
/// what the command line has put into some other folder, and loads the setting of a variation into its
/// experiment.
class SweepsDock : public QWidget {
    Q_OBJECT
  public:
    /// Without a runner sweeps get machines of their own.
    SweepsDock(Session& session, const Preferences& preferences, engine::SweepRunner runner,
               QWidget* parent = nullptr);
    widgets::SweepPanel& panel() { return *panel_; }
    /// A dock that is not seen reads nothing.
    void set_visible_to_user(bool seen);

    std::string chosen() const;  ///< id of the sweep that is shown; empty: none
    void show_sweep(const std::string& id);
    void add_sweep();
    /// A parameter of the experiment that is worked on varies in the shown sweep, or in a new one where that
    /// is of another experiment.
    void sweep_parameter(const std::string& key);
    /// Why the chosen sweep cannot run; empty: it can.
    QString why_not_run() const;
    void run();
    void pause(bool pauses);
    void cancel();
    /// The setting of a variation becomes the experiment's.
    void load_variation(const QString& id);
    /// Where the chosen sweep's results are looked for; an empty path is the project's own place.
    void open_folder(const std::filesystem::path& folder);
    /// Reads what is there again: somebody else may have written it.
    void look();
    bool is_settled() const;
    void write_csv(const QString& file) const;

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    void said(const QString& text);  ///< for the status line
    void failed(const QString& error);
    void report_wanted(const QString& folder, const QString& title);
    /// The sweep is to be edited by all its values.
    void edit_wanted(const QString& sweep);
    /// An experiment has another setting now, and is to be seen.
    void loaded(const QString& experiment);

  private:
    using Run = widgets::SweepFields::Run;
    const projects::Sweep* sweep() const;
    const projects::Experiment* base() const;
    std::filesystem::path own_folder() const;
    std::filesystem::path folder() const;
    engine::SweepJob job() const;
    void connect_panel();
    void connect_runs();
    void add_first_axis();
    void add_axis(const std::string& sweep, const std::string& experiment, const std::string& key);
    void forget_all();
    void end_run(const QString& problem);
    void take(engine::SweepSheet sheet);
    void update();
    void show_rows();
    /// Until another sweep or folder is read.
    void clear_sheet();
    widgets::SweepLine line(std::size_t row) const;
    bool shows_run() const;  ///< whether the chosen sweep's run is under way
    widgets::SweepFields fields() const;
    void fill_foot(widgets::SweepFields& fields) const;
    QString doing() const;
    void export_csv();
    void ask_for_folder();

    Session& session_;
    const Preferences& preferences_;
    SweepRuns runs_;
    widgets::SweepPanel* panel_;
    QTimer redraw_;  ///< rows and progress may come quicker than they can be drawn
    std::string chosen_, plot_, quantity_;
    std::map<std::string, std::filesystem::path> opened_;  ///< folders of results, by sweep
    engine::SweepSheet sheet_;
    SweepColumns columns_;
    bool judges_ = true, seen_ = false, outdated_ = true;
    std::string running_;  ///< id of the sweep that runs
    std::filesystem::path running_folder_;
    engine::SweepSheet run_sheet_;  ///< of the sweep that runs or ran last, whichever is shown
    Run run_ = Run::none;
    std::size_t at_ = 0;  ///< the row that is being rendered
    QString doing_, problem_;
    double fraction_ = 0;
    widgets::NewestJob reader_;  // last member: its thread uses the others
};

}  // namespace ir::gui
