#include "app/gui/benchmark_runs.h"

#include <utility>

namespace ir::gui {

BenchmarkRuns::BenchmarkRuns(engine::BenchmarkRunner runner, QObject* parent)
    : QObject(parent), thread_(std::make_unique<engine::BenchmarkThread>(std::move(runner), callbacks())) {}

BenchmarkRuns::~BenchmarkRuns() {
    thread_.reset();  // no callback comes after this
}

template <class Function>
void BenchmarkRuns::post(Function function) {
    QMetaObject::invokeMethod(this, std::move(function), Qt::QueuedConnection);
}

engine::BenchmarkThread::Callbacks BenchmarkRuns::callbacks() {
    engine::BenchmarkThread::Callbacks c;
    c.on_report = [this](engine::BenchmarkReport report) {
        post([this, report = std::move(report)] { emit reported(report); });
    };
    c.on_progress = [this](engine::BenchmarkProgress progress) { keep_progress(std::move(progress)); };
    c.on_finished = [this](engine::BenchmarkReport report) {
        post([this, report = std::move(report)] {
            is_running_ = false;
            emit finished(report);
        });
    };
    c.on_failure = [this](const std::string& error, bool cancelled) {
        post([this, error = QString::fromStdString(error), cancelled] {
            is_running_ = false;
            emit failed(error, cancelled);
        });
    };
    return c;
}

/// Passes tell of themselves quicker than a window draws: only the newest waits in the event queue.
void BenchmarkRuns::keep_progress(engine::BenchmarkProgress progress) {
    {
        const std::lock_guard lock(mutex_);
        const bool waits = progress_.has_value();
        progress_ = std::move(progress);
        if (waits) return;
    }
    post([this] {
        std::optional<engine::BenchmarkProgress> newest;
        {
            const std::lock_guard lock(mutex_);
            newest.swap(progress_);
        }
        if (newest && is_running_) emit progressed(*newest);
    });
}

bool BenchmarkRuns::start(engine::BenchmarkRequest request) {
    if (is_running_ || !thread_->start(std::move(request))) return false;
    return is_running_ = true;
}

void BenchmarkRuns::cancel() {
    thread_->cancel();
}

}  // namespace ir::gui
