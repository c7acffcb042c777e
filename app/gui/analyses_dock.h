#pragma once

#include <QTimer>
#include <QWidget>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "app/gui/analysis_runs.h"
#include "app/gui/preferences.h"
#include "app/gui/session.h"
#include "widgets/analysis/analysis_panel.h"
#include "widgets/models/newest_job.h"

namespace ir::gui {

/// The project's analyses: runs one at a time, keeps its answer in results/analyses/ID of the project, and
/// shows what is kept there, also what the command line has found.
class AnalysesDock : public QWidget {
    Q_OBJECT
  public:
    /// Without a runner analyses get machines of their own.
    AnalysesDock(Session& session, const Preferences& preferences, engine::AnalysisRunner runner,
                 widgets::ImageView::Surface surface, QWidget* parent = nullptr);
    widgets::AnalysisPanel& panel() { return *panel_; }
    /// A dock that is not seen reads nothing.
    void set_visible_to_user(bool seen);

    std::string chosen() const;  ///< id of the analysis that is shown; empty: none
    void show_analysis(const std::string& id);
    /// A question of this kind about the experiment that is worked on.
    void add_analysis(const std::string& kind);
    /// Why the chosen analysis cannot be carried out; empty: it can.
    QString why_not_run() const;
    void run();
    void cancel() { runs_.cancel(); }
    /// Reads what is kept again: somebody else may have written it.
    void look();
    bool is_settled() const { return !runs_.is_running() && !reader_.is_running(); }

    // Files; throw Error with one line.
    void write_csv(const QString& file) const;
    void write_svg(const QString& file) const;

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    void said(const QString& text);  ///< for the status line
    void failed(const QString& error);
    /// The analysis is to be edited by all its values.
    void edit_wanted(const QString& analysis);
    /// Another one than before is shown, or this one is asked again; empty: none is shown.
    void shown(const QString& analysis);

  private:
    /// What is known of an analysis.
    struct Answer {
        std::shared_ptr<const engine::KeptAnalysis> kept;
        std::filesystem::file_time_type written = {};  ///< of the file that it was read from; 0: of none
        std::vector<widgets::AnswerPicture> pictures = {};
        QString problem = {};
    };
    const projects::Analysis* analysis() const;
    std::filesystem::path folder() const;
    void connect_panel();
    void connect_runs();
    void follow_document();
    void forget_all();
    void take(const std::string& id, std::shared_ptr<const engine::KeptAnalysis> kept);
    void read();
    void update();
    widgets::AnalysisFields fields() const;
    void fill_foot(widgets::AnalysisFields& fields, const Answer& answer) const;
    QString empty_text() const;
    template <class Write>
    void export_to(const QString& suffix, const QString& filter, Write write);

    Session& session_;
    const Preferences& preferences_;
    AnalysisRuns runs_;
    widgets::AnalysisPanel* panel_;
    QTimer redraw_;  ///< progress may come quicker than it can be drawn
    std::string chosen_, running_;
    std::string told_;                        ///< which one is shown
    std::string running_key_, running_kind_;  ///< what is asked
    QString picture_;                         ///< that is shown once its answer is there; empty: any
    QString doing_;
    double fraction_ = 0;
    std::map<std::string, Answer> answers_;  ///< by analysis
    std::size_t count_ = 0;                  ///< of the project's analyses
    bool seen_ = false, outdated_ = true;
    widgets::NewestJob reader_;  // last member: its thread uses the others
};

}  // namespace ir::gui
