#pragma once

#include <QObject>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/engine/sweep_job.h"

namespace ir::gui {

/// Runs a sweep as the window's thread sees it: every call returns at once, every answer is a signal on the
/// window's thread. It has a thread and a machine of its own, which gives way to the window's.
class SweepRuns : public QObject {
    Q_OBJECT
  public:
    using Rows = std::vector<std::pair<std::size_t, engine::SweepRow>>;

    explicit SweepRuns(engine::SweepRunner runner, QObject* parent = nullptr);
    ~SweepRuns() override;  ///< cancels and joins

    /// Whether it was started: not while one runs.
    bool start(engine::SweepRequest request);
    void cancel();
    /// A run waits before its next variation.
    void pause(bool pauses);
    /// Until the end was told.
    bool is_running() const { return is_running_; }

  signals:
    /// All rows, before the first is rendered.
    void planned(const ir::engine::SweepTable& table);
    void begun(std::size_t row);
    void rows_arrived(const ir::gui::SweepRuns::Rows& rows);
    /// Of the variation that is being rendered.
    void progressed(const QString& what, double fraction);
    void paused();  ///< it waits now
    void noted(const QString& note);
    void finished();
    void failed(const QString& error, bool cancelled);

  private:
    engine::SweepCallbacks callbacks();
    template <class Function>
    void post(Function function);
    void wait_while_paused();
    void sweep_run(const engine::SweepRequest& request);
    void keep_progress(const std::string& what, double fraction);
    void keep_row(std::size_t row, const engine::SweepRow& outcome);

    const engine::SweepRunner runner_;
    bool is_running_ = false;
    CancelToken token_;
    std::mutex mutex_;  ///< of pauses_, rows_ and progress_
    bool pauses_ = false;
    Rows rows_;
    std::optional<std::pair<std::string, double>> progress_;  ///< that nobody has heard of
    std::condition_variable changed_;
    std::thread thread_;
};

}  // namespace ir::gui
