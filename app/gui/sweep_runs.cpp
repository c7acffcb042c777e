#include "app/gui/sweep_runs.h"

#include "app/engine/thread_priority.h"
#include "app/gui/text_of.h"
#include "renderers/core/error.h"
#include "renderers/core/reason.h"

namespace ir::gui {

SweepRuns::SweepRuns(engine::SweepRunner runner, QObject* parent)
    : QObject(parent), runner_(runner ? std::move(runner) : engine::run_sweep_request) {}

SweepRuns::~SweepRuns() {
    cancel();
    if (thread_.joinable()) thread_.join();
}

template <class Function>
void SweepRuns::post(Function function) {
    QMetaObject::invokeMethod(this, std::move(function), Qt::QueuedConnection);
}

bool SweepRuns::start(engine::SweepRequest request) {
    if (is_running_) return false;
    if (thread_.joinable()) thread_.join();  // has told its end
    token_.reset();
    pauses_ = false;
    is_running_ = true;
    thread_ = std::thread([this, request = std::move(request)] {
        engine::give_way_to_others();
        sweep_run(request);
    });
    return true;
}

void SweepRuns::cancel() {
    {
        const std::lock_guard lock(mutex_);
        token_.cancel();
    }
    changed_.notify_all();
}

void SweepRuns::pause(bool pauses) {
    {
        const std::lock_guard lock(mutex_);
        pauses_ = pauses;
    }
    changed_.notify_all();
}

void SweepRuns::wait_while_paused() {
    std::unique_lock lock(mutex_);
    if (pauses_ && !token_.is_cancelled()) post([this] { emit paused(); });
    changed_.wait(lock, [this] { return !pauses_ || token_.is_cancelled(); });
    token_.check();
}

engine::SweepCallbacks SweepRuns::callbacks() {
    engine::SweepCallbacks told;
    told.frame.cancel = &token_;
    told.frame.progress = [this](const std::string& what, double fraction) { keep_progress(what, fraction); };
    told.note = [this](const std::string& note) { post([this, note] { emit noted(text_of(note)); }); };
    told.planned = [this](const engine::SweepTable& table, std::size_t) {
        post([this, table] { emit planned(table); });
    };
    told.begun = [this](std::size_t row, const projects::SweepPoint&) {
        wait_while_paused();
        post([this, row] { emit begun(row); });
    };
    told.ended = [this](std::size_t row, const engine::SweepRow& outcome, bool) { keep_row(row, outcome); };
    return told;
}

/// Small variations end quicker than a window draws.
void SweepRuns::keep_row(std::size_t row, const engine::SweepRow& outcome) {
    {
        const std::lock_guard lock(mutex_);
        rows_.emplace_back(row, outcome);
        if (rows_.size() > 1) return;
    }
    post([this] {
        Rows rows;
        {
            const std::lock_guard lock(mutex_);
            rows.swap(rows_);
        }
        emit rows_arrived(rows);
    });
}

void SweepRuns::keep_progress(const std::string& what, double fraction) {
    {
        const std::lock_guard lock(mutex_);
        const bool is_told_soon = progress_.has_value();
        progress_ = {what, fraction};
        if (is_told_soon) return;
    }
    post([this] {
        std::pair<std::string, double> newest;
        {
            const std::lock_guard lock(mutex_);
            newest = *std::exchange(progress_, std::nullopt);
        }
        if (is_running_) emit progressed(text_of(newest.first), newest.second);
    });
}

void SweepRuns::sweep_run(const engine::SweepRequest& request) {
    const auto fail = [this](const std::string& error, bool is_cancelled) {
        post([this, error, is_cancelled] {
            is_running_ = false;
            emit failed(text_of(error), is_cancelled);
        });
    };
    try {
        runner_(request, callbacks());
        post([this] {
            is_running_ = false;
            emit finished();
        });
    } catch (const Cancelled&) {
        fail("cancelled", true);
    } catch (const std::exception& error) {
        fail(reason_of(error), false);
    }
}

}  // namespace ir::gui
