#pragma once

#include <QObject>
#include <mutex>
#include <optional>

#include "app/engine/benchmark_thread.h"

namespace ir::gui {

/// Runs benchmarks as the window's thread sees it: every call returns at once, every answer is a signal on
/// the window's thread.
class BenchmarkRuns : public QObject {
    Q_OBJECT
  public:
    explicit BenchmarkRuns(engine::BenchmarkRunner runner, QObject* parent = nullptr);
    ~BenchmarkRuns() override;

    /// Whether it was started: not while one runs.
    bool start(engine::BenchmarkRequest request);
    void cancel();
    /// Until the end was told.
    bool is_running() const { return is_running_; }

  signals:
    void reported(const ir::engine::BenchmarkReport& report);
    void progressed(const ir::engine::BenchmarkProgress& progress);
    void finished(const ir::engine::BenchmarkReport& report);
    void failed(const QString& error, bool cancelled);

  private:
    engine::BenchmarkThread::Callbacks callbacks();
    template <class Function>
    void post(Function function);
    void keep_progress(engine::BenchmarkProgress progress);

    bool is_running_ = false;
    std::mutex mutex_;  ///< of the one below
    std::optional<engine::BenchmarkProgress> progress_;
    std::unique_ptr<engine::BenchmarkThread> thread_;
};

}  // namespace ir::gui
