#include "app/gui/analysis_runs.h"

#include "app/engine/thread_priority.h"
#include "app/gui/text_of.h"
#include "renderers/core/error.h"
#include "renderers/core/reason.h"

namespace ir::gui {

AnalysisRuns::AnalysisRuns(engine::AnalysisRunner runner, QObject* parent)
    : QObject(parent), runner_(runner ? std::move(runner) : engine::run_analysis_request) {}

AnalysisRuns::~AnalysisRuns() {
    cancel();
}

bool AnalysisRuns::start(engine::AnalysisRequest request) {
    if (is_running()) return false;
    token_ = std::make_shared<CancelToken>();
    job_.start([this, request = std::move(request), token = token_](const std::atomic<bool>&) {
        engine::give_way_to_others();
        return [this, tell = work(request, *token)] {
            token_.reset();
            tell();
        };
    });
    return true;
}

void AnalysisRuns::cancel() {
    if (token_) token_->cancel();
}

/// On the job's thread; what it returns tells the end.
std::function<void()> AnalysisRuns::work(const engine::AnalysisRequest& request, const CancelToken& token) {
    engine::AnalysisCallbacks told;
    told.cancel = &token;
    told.progress = [this](const std::string& what, double fraction) { keep_progress(what, fraction); };
    try {
        auto result = std::make_shared<const engine::AnalysisResult>(runner_(request, told));
        return [this, result] { emit finished(result); };
    } catch (const Cancelled&) {
        return [this] { emit failed({}, true); };
    } catch (const std::exception& error) {
        return [this, what = text_of(reason_of(error))] { emit failed(what, false); };
    }
}

/// Passes tell of themselves quicker than a window draws.
void AnalysisRuns::keep_progress(const std::string& what, double fraction) {
    {
        const std::lock_guard lock(mutex_);
        const bool is_told_soon = progress_.has_value();
        progress_ = {what, fraction};
        if (is_told_soon) return;
    }
    QMetaObject::invokeMethod(
        this,
        [this] {
            std::pair<std::string, double> newest;
            {
                const std::lock_guard lock(mutex_);
                newest = *std::exchange(progress_, std::nullopt);
            }
            if (is_running()) emit progressed(text_of(newest.first), newest.second);
        },
        Qt::QueuedConnection);
}

}  // namespace ir::gui
