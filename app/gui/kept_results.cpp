#include "app/gui/kept_results.h"

#include <utility>

#include "projects/keep.h"
#include "projects/scene_files.h"

namespace ir::gui {
namespace {

namespace fs = std::filesystem;

constexpr int look_ms = 2000;

/// Tells whether the index may have changed, without reading it.
std::string stamp_of(const fs::path& folder) {
    const auto file = folder / "results" / "index.json";
    std::error_code missing;
    const auto time = fs::last_write_time(file, missing);
    if (missing) return "none";
    return std::to_string(time.time_since_epoch().count()) + " " +
           std::to_string(fs::file_size(file, missing));
}

}  // namespace

KeptResults::KeptResults(Session& session, QObject* parent) : QObject(parent), session_(session) {
    connect(&session_, &Session::project_replaced, this, &KeptResults::follow_session);
    connect(&session_, &Session::document_changed, this, &KeptResults::follow_session);
    // Commands keep results while the window stays as it is.
    looking_.setInterval(look_ms);
    connect(&looking_, &QTimer::timeout, this, &KeptResults::look);
    looking_.start();
}

KeptResults::~KeptResults() {
    if (thread_.joinable()) thread_.join();
}

/// A project that is opened, closed, or saved in another place.
void KeptResults::follow_session() {
    const fs::path folder = session_.has_project() ? session_.open_project().folder() : fs::path();
    if (folder == folder_) return;
    folder_ = folder;
    index_ = {};
    bytes_.clear();
    missing_.clear();
    stamp_.clear();
    error_.clear();
    is_known_ = folder.empty();
    look();
}

fs::path KeptResults::file(const projects::KeptResult& result, const std::string& role) const {
    const auto* found = projects::file_of(result, role);
    return found ? folder_ / "results" / found->path : fs::path();
}

std::uint64_t KeptResults::bytes(const std::string& key) const {
    const auto found = bytes_.find(key);
    return found == bytes_.end() ? 0 : found->second;
}

bool KeptResults::is_missing(const std::string& key) const {
    const auto found = missing_.find(key);
    return found != missing_.end() && found->second;
}

std::string KeptResults::state_file(const projects::Experiment& experiment) const {
    if (!session_.has_project() || entries().empty()) return {};
    const auto now = projects::with_contents(session_.document(), session_.open_project().contents());
    const auto* result = index_.find_state(projects::state_key(now, experiment, session_.registry()));
    return result ? file(*result, projects::state_role).string() : std::string();
}

KeptResults::Reading KeptResults::read(const fs::path& folder) {
    Reading reading;
    reading.stamp = stamp_of(folder);
    try {
        reading.index = projects::ResultIndex::load(folder);
    } catch (const std::exception& error) {
        reading.error = error.what();
    }
    for (const auto& entry : reading.index.entries())
        for (const auto& each : entry.files) {
            std::error_code missing;
            const auto size = fs::file_size(folder / "results" / each.path, missing);
            if (!missing) reading.bytes[entry.key] += size;
            if (missing && each.role == projects::main_role) reading.missing[entry.key] = true;
        }
    return reading;
}

void KeptResults::look() {
    if (folder_.empty() || (is_known_ && stamp_ == stamp_of(folder_))) return;
    if (is_busy_ && !waiting_.empty()) return;  // it will be read
    start([] {});
}

void KeptResults::remove(const std::vector<std::string>& keys) {
    if (folder_.empty() || keys.empty()) return;
    start([folder = folder_, keys] { projects::delete_results(folder, keys); });
}

void KeptResults::start(std::function<void()> before) {
    if (is_busy_) return waiting_.push_back(std::move(before));
    if (thread_.joinable()) thread_.join();
    is_busy_ = true;
    thread_ = std::thread([this, folder = folder_, before = std::move(before)] {
        std::string failure;
        try {
            before();
        } catch (const std::exception& error) {
            failure = error.what();
        }
        auto reading = folder.empty() ? Reading() : read(folder);
        QMetaObject::invokeMethod(
            this, [this, folder, reading, failure] { finish(folder, reading, failure); },
            Qt::QueuedConnection);
    });
}

void KeptResults::finish(const fs::path& folder, Reading reading, const std::string& failure) {
    is_busy_ = false;
    if (folder == folder_) {
        index_ = std::move(reading.index);
        bytes_ = std::move(reading.bytes);
        missing_ = std::move(reading.missing);
        stamp_ = std::move(reading.stamp);
        error_ = std::move(reading.error);
        is_known_ = true;
        if (error_.empty())
            session_.change(
                [this](projects::OpenProject& open) { return open.set_last_kept(index_.last_kept()); });
    }
    if (!waiting_.empty()) {
        auto next = std::move(waiting_.front());
        waiting_.erase(waiting_.begin());
        start(std::move(next));
    } else if (!folder_.empty() && !is_known_) {
        start([] {});
    }
    if (!failure.empty()) emit failed(QString::fromStdString(failure));
    emit changed();
}

}  // namespace ir::gui
