#include "projects/scene_hasher.h"

#include <utility>

#include "projects/hash_cache.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

/// Moves what was found into what is known; returns whether that was news.
template <class Known>
bool take_over(Known& found, Known& known) {
    bool is_news = false;
    for (const auto& [source, value] : std::exchange(found, {})) {
        const auto [place, is_new] = known.emplace(source, value);
        is_news = is_news || is_new || place->second != value;
        place->second = value;
    }
    return is_news;
}

/// The file behind a source and until when it animates something; no file of a built-in scene.
std::pair<std::string, double> animation_end(const std::string& source, const std::filesystem::path& folder) {
    if (is_builtin(source)) return {};
    try {
        const auto file = resolve(source, folder);
        return {file.string(), shared_hash_cache().animation_end(file)};
    } catch (const std::exception&) {
        return {};  // no folder to begin with
    }
}

}  // namespace

SceneHasher::SceneHasher(std::function<void()> on_news)
    : on_news_(std::move(on_news)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

SceneHasher::~SceneHasher() {
    thread_.request_stop();
    const std::lock_guard guard(mutex_);
    waiting_.clear();
    reading_cancelled_->cancel();
}

void SceneHasher::set_on_news(std::function<void()> on_news) {
    const std::lock_guard guard(mutex_);
    on_news_ = std::move(on_news);
    if (on_news_ && !(found_.empty() && found_ends_.empty())) on_news_();
}

void SceneHasher::request(std::set<std::string> sources, const std::filesystem::path& project_folder) {
    {
        const std::lock_guard guard(mutex_);
        ++request_;
        reading_cancelled_->cancel();
        reading_cancelled_ = std::make_shared<CancelToken>();
        folder_ = project_folder;
        waiting_.assign(sources.begin(), sources.end());
        found_.clear();
        found_ends_.clear();
    }
    changed_.notify_all();
}

bool SceneHasher::take(ContentHashes& hashes) {
    const std::lock_guard guard(mutex_);
    return take_over(found_, hashes);
}

bool SceneHasher::take(AnimationEnds& ends) {
    const std::lock_guard guard(mutex_);
    return take_over(found_ends_, ends);
}

bool SceneHasher::is_busy() const {
    const std::lock_guard guard(mutex_);
    return reading_ || !waiting_.empty();
}

void SceneHasher::wait() {
    std::unique_lock guard(mutex_);
    changed_.wait(guard, [this] { return !reading_ && waiting_.empty(); });
}

void SceneHasher::run(const std::stop_token& thread_stops) {
    std::unique_lock guard(mutex_);
    while (changed_.wait(guard, thread_stops, [this] { return !waiting_.empty(); })) {
        const std::string source = std::move(waiting_.front());
        waiting_.pop_front();
        reading_ = true;
        const auto folder = folder_;
        const auto request = request_;
        const auto cancel = reading_cancelled_;
        guard.unlock();
        const auto [file, end] = animation_end(source, folder);
        guard.lock();
        const auto is_wanted = [&] { return request == request_ && !thread_stops.stop_requested(); };
        if (is_wanted() && !file.empty()) found_ends_[file] = end;
        if (end > 0 && is_wanted() && on_news_) on_news_();
        guard.unlock();
        std::string hash;
        try {
            hash = scene_hash(source, folder, cancel.get());
        } catch (const std::exception&) {
            // Missing, unreadable or no longer wanted.
        }
        guard.lock();
        reading_ = false;
        if (is_wanted()) found_[source] = std::move(hash);
        changed_.notify_all();
        if (is_wanted() && on_news_) on_news_();
    }
}

}  // namespace ir::projects
