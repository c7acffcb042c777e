#include "app/gui/studies.h"

#include <algorithm>
#include <utility>

#include "renderers/core/reason.h"

namespace ir::gui {

Studies::Studies(engine::StudyRunner runner, QObject* parent)
    : QObject(parent),
      thread_(runner ? std::make_unique<engine::StudyThread>(std::move(runner), callbacks())
                     : std::make_unique<engine::StudyThread>(callbacks())) {}

Studies::~Studies() {
    thread_.reset();  // no callback comes after this
    if (reader_.joinable()) reader_.join();
}

/// Calls on the window's thread, unless the study is not wanted any more by then.
template <class Function>
void Studies::post(const std::string& plot, std::uint64_t serial, Function function) {
    QMetaObject::invokeMethod(
        this,
        [this, plot, serial, function = std::move(function)] {
            const auto found = wanted_.find(plot);
            if (found != wanted_.end() && found->second == serial) function();
        },
        Qt::QueuedConnection);
}

engine::StudyThread::Callbacks Studies::callbacks() {
    engine::StudyThread::Callbacks c;
    c.on_point = [this](std::string plot, std::uint64_t serial, engine::ErrorPoint point) {
        post(plot, serial, [this, plot, point = std::move(point)] { emit point_arrived(plot, point); });
    };
    c.on_progress = [this](std::string plot, std::uint64_t serial, std::string what, double fraction) {
        study_progress(plot, serial, {QString::fromStdString(what), fraction});
    };
    c.on_finished = [this](std::string plot, std::uint64_t serial, engine::ErrorStudy study) {
        const auto error = study_keep(plot, serial, study);
        post(plot, serial, [this, plot, error, study = std::move(study)] {
            wanted_.erase(plot);
            emit finished(plot, study, error);
        });
    };
    c.on_failure = [this](std::string plot, std::uint64_t serial, std::string error, bool cancelled) {
        post(plot, serial, [this, plot, error = QString::fromStdString(error), cancelled] {
            wanted_.erase(plot);
            emit failed(plot, error, cancelled);
        });
    };
    return c;
}

/// Passes tell of themselves quicker than a window draws: only the newest waits in the event queue.
void Studies::study_progress(const std::string& plot, std::uint64_t serial, Progress progress) {
    {
        const std::lock_guard lock(mutex_);
        if (!progress_.insert_or_assign(plot, std::move(progress)).second) return;
    }
    QMetaObject::invokeMethod(
        this,
        [this, plot, serial] {
            Progress newest;
            {
                const std::lock_guard lock(mutex_);
                newest = progress_[plot];
                progress_.erase(plot);
            }
            const auto found = wanted_.find(plot);
            if (found != wanted_.end() && found->second == serial)
                emit progressed(plot, newest.what, newest.fraction);
        },
        Qt::QueuedConnection);
}

/// Reads and hashes files: not for the window's thread. Returns why the numbers were not written.
QString Studies::study_keep(const std::string& plot, std::uint64_t serial, const engine::ErrorStudy& study) {
    engine::StudyRequest request;
    {
        const std::lock_guard lock(mutex_);
        const auto found = to_keep_.find(plot);
        if (found == to_keep_.end() || found->second.serial != serial) return {};
        request = std::move(found->second);
        to_keep_.erase(found);
    }
    try {
        engine::keep_study(request.project, request.plot, request.folder, study);
    } catch (const std::exception& error) {
        return QString::fromStdString(reason_of(error));
    }
    return {};
}

void Studies::run(engine::StudyRequest request, bool keep) {
    const auto plot = request.tag;
    // Held while the serial becomes known: the study's thread looks for it when it has finished.
    const std::lock_guard lock(mutex_);
    to_keep_.erase(plot);
    if (!keep) {
        wanted_[plot] = thread_->request(std::move(request));
        return;
    }
    auto copy = request;
    copy.serial = wanted_[plot] = thread_->request(std::move(request));
    to_keep_[plot] = std::move(copy);
}

void Studies::cancel(const std::string& plot) {
    thread_->cancel(plot);
}

void Studies::release(const std::string& plot) {
    wanted_.erase(plot);
    thread_->release(plot);
}

void Studies::read(const std::filesystem::path& folder, const std::string& plot) {
    const Place place{folder, plot};
    if (std::find(to_read_.begin(), to_read_.end(), place) != to_read_.end()) return;
    if (is_reading_) return to_read_.push_back(place);
    start_reading(place);
}

void Studies::start_reading(const Place& place) {
    if (reader_.joinable()) reader_.join();
    is_reading_ = true;
    reader_ = std::thread([this, place] {
        std::shared_ptr<const engine::KeptStudy> kept;
        QString error;
        try {
            if (auto found = engine::load_study(place.folder, place.plot))
                kept = std::make_shared<const engine::KeptStudy>(std::move(*found));
        } catch (const std::exception& failure) {
            error = QString::fromStdString(reason_of(failure));
        }
        QMetaObject::invokeMethod(
            this,
            [this, place, kept, error] {
                is_reading_ = false;
                if (!to_read_.empty()) {
                    const auto next = to_read_.front();
                    to_read_.erase(to_read_.begin());
                    start_reading(next);
                }
                emit read_done(place.folder.string(), place.plot, kept, error);
            },
            Qt::QueuedConnection);
    });
}

}  // namespace ir::gui
