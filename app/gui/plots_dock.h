#pragma once

#include <QTimer>
#include <QWidget>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "app/engine/study_plot.h"
#include "app/gui/preferences.h"
#include "app/gui/session.h"
#include "app/gui/studies.h"
#include "widgets/document/edit_maker.h"
#include "widgets/plot/plot_panel.h"

namespace ir::gui {

/// The project's plots of the error: carries them out, shows what is kept of them at once and points as they
/// are measured, and loads the setting of a point into its experiment.
class PlotsDock : public QWidget {
    Q_OBJECT
  public:
    /// Without a runner studies get a machine of their own.
    PlotsDock(Session& session, const Preferences& preferences, engine::StudyRunner runner,
              QWidget* parent = nullptr);
    widgets::PlotPanel& panel() { return *panel_; }
    /// A dock that is not seen reads and draws nothing.
    void set_visible_to_user(bool seen);

    std::string chosen() const;  ///< id of the plot that is shown; empty: none
    void show_plot(const std::string& id);
    void add_plot();
    /// Why the chosen plot cannot be carried out; empty: it can.
    QString why_not_run() const;
    void run();
    /// Runs the chosen plot unless its kept numbers are current.
    void run_if_needed();
    void cancel();
    /// The setting of a point becomes the experiment's.
    void load_point(const QString& id);
    /// Reads what is kept again: somebody else may have written it.
    void look();
    /// Whether no study runs and nothing is being read.
    bool is_settled() const;

    // Files; throw Error with one line.
    void write_picture(const QString& file, const QSize& size, int scale, bool on_paper) const;
    void write_numbers(const QString& file) const;

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    void said(const QString& text);  ///< for the status line
    void failed(const QString& error);
    /// The plot is to be edited by all its values.
    void edit_wanted(const QString& plot);
    /// An experiment has another setting now, and is to be seen.
    void loaded(const QString& experiment);

  private:
    /// What is known of a plot.
    struct State {
        std::shared_ptr<const engine::KeptStudy> numbers;
        bool was_read = false;  ///< whether the disk was looked at
        /// While it runs, and after that until numbers replace it: `numbers` with the points so far.
        std::shared_ptr<engine::KeptStudy> running;
        bool is_running = false;
        QString doing, problem;
        double fraction = -1;
    };
    State& state() { return states_[chosen()]; }
    const projects::ErrorPlot* plot() const;
    const projects::ErrorPlot* plot(const std::string& id) const;
    std::shared_ptr<const engine::KeptStudy> shown_numbers() const;
    engine::PlotLook look_of(const engine::KeptStudy& numbers) const;
    void connect_panel();
    void connect_studies();
    void forget_all();
    void follow_document();
    void update();
    void read_if_needed();
    void show_empty();
    void show_header(const engine::DrawnStudy& drawn);
    widgets::PlotChoices plot_lists() const;
    QString waiting_text() const;
    QString stale_text() const;
    void change(const widgets::EditMaker& make);
    void finish(const std::string& id, const engine::ErrorStudy& study, const QString& keep_error);
    void fail(const std::string& id, const QString& error, bool cancelled);
    void export_picture(int scale, bool on_paper, bool to_clipboard);
    void export_numbers(bool to_clipboard);
    /// `words`: what the proposed name says beside the plot's.
    QString ask_for_file(const QString& words, const QString& suffix, const QString& filter);
    engine::ErrorStudy study_with_front() const;

    Session& session_;
    const Preferences& preferences_;
    Studies studies_;
    widgets::PlotPanel* panel_;
    QTimer redraw_;  ///< points may come quicker than they can be drawn
    std::filesystem::path folder_;
    std::string chosen_;
    std::map<std::string, State> states_;
    bool log_x_ = true, log_y_ = true;
    bool seen_ = false, outdated_ = true, runs_when_read_ = false;
};

}  // namespace ir::gui
