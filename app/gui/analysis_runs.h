#pragma once

#include <QObject>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "app/engine/analysis/kept_analysis.h"
#include "widgets/models/newest_job.h"

namespace ir::gui {

/// Carries out an analysis as the window's thread sees it: every call returns at once, every answer is a
/// signal on the window's thread. It has a thread and a machine of its own, which gives way to the window's.
class AnalysisRuns : public QObject {
    Q_OBJECT
  public:
    explicit AnalysisRuns(engine::AnalysisRunner runner, QObject* parent = nullptr);
    ~AnalysisRuns() override;  ///< cancels and waits

    /// Whether it was started: not while one runs.
    bool start(engine::AnalysisRequest request);
    void cancel();
    bool is_running() const { return token_ != nullptr; }

  signals:
    void progressed(const QString& what, double fraction);
    void finished(std::shared_ptr<const ir::engine::AnalysisResult> result);
    void failed(const QString& error, bool cancelled);

  private:
    std::function<void()> work(const engine::AnalysisRequest& request, const CancelToken& token);
    void keep_progress(const std::string& what, double fraction);

    const engine::AnalysisRunner runner_;
    std::shared_ptr<CancelToken> token_;                      ///< of what runs
    std::mutex mutex_;                                        ///< of progress_
    std::optional<std::pair<std::string, double>> progress_;  ///< that nobody has heard of
    widgets::NewestJob job_;                                  // last member: its thread uses the others
};

}  // namespace ir::gui
