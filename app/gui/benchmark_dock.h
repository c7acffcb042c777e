#pragma once

#include <QTimer>
#include <QWidget>
#include <map>
#include <set>
#include <string>

#include "app/gui/benchmark_runs.h"
#include "app/gui/preferences.h"
#include "app/gui/session.h"
#include "widgets/benchmarks/benchmark_panel.h"

namespace ir::gui {

/// Benchmarks of this build: runs one at a time, in its own scene or at the chosen experiment's place, and
/// keeps the last numbers of each until it runs again. They are no part of the project.
class BenchmarkDock : public QWidget {
    Q_OBJECT
  public:
    /// Without a runner benchmarks get machines of their own.
    BenchmarkDock(Session& session, const Preferences& preferences, engine::BenchmarkRunner runner,
                  QWidget* parent = nullptr);
    widgets::BenchmarkPanel& panel() { return *panel_; }

    void choose(const std::string& benchmark);
    /// Why the chosen one cannot run; empty: it can.
    QString why_not_run() const;
    void run();
    void cancel();
    bool is_settled() const { return !runs_.is_running(); }
    /// The numbers of the chosen one; null: there are none.
    const engine::BenchmarkReport* report() const;
    void write_csv(const QString& file) const;
    void write_json(const QString& file) const;

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    void said(const QString& text);  ///< for the status line
    void failed(const QString& error);

  private:
    const engine::NamedBenchmark& chosen() const;
    std::vector<std::string> chosen_variants() const;
    bool runs_at_experiment() const;
    std::optional<engine::BenchmarkRequest::Place> place() const;
    void connect_panel();
    void connect_runs();
    void update();
    widgets::BenchmarkFields fields() const;
    widgets::BenchmarkTable table() const;
    widgets::BenchmarkLine line(const std::string& label, bool is_peer) const;
    void put_numbers(widgets::BenchmarkTable& table) const;
    QString doing() const;
    void show_foot(widgets::BenchmarkFields& fields) const;
    void export_to(const QString& suffix, const QString& filter,
                   void (BenchmarkDock::*write)(const QString&) const);

    Session& session_;
    const Preferences& preferences_;
    BenchmarkRuns runs_;
    widgets::BenchmarkPanel* panel_;
    QTimer redraw_;  ///< progress may come quicker than it can be drawn
    std::string chosen_;
    bool at_experiment_ = false;
    int repeats_ = 5;
    std::map<std::string, std::set<std::string>> skipped_;  ///< variants that are not checked, by benchmark
    std::map<std::string, engine::BenchmarkReport> reports_;
    std::map<std::string, QString> problems_;  ///< how the last run of each ended, where not well
    std::string running_;
    engine::BenchmarkProgress progress_;
};

}  // namespace ir::gui
