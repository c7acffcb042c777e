#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "projects/scene_files.h"

namespace ir::projects {

/// Reads and hashes the files of a project on a thread of its own, so that no window waits for large scenes.
class SceneHasher {
  public:
    /// `on_news` is called on the hasher's thread after each source; it may only pass the word on.
    explicit SceneHasher(std::function<void()> on_news = {});
    ~SceneHasher();  ///< drops what waits; stops within one block of a file
    /// Says at once what was found before.
    void set_on_news(std::function<void()> on_news);

    /// Hashes all of `sources`, again where they were hashed before (unchanged files cost one look). Replaces
    /// what waits; hashes of an earlier request are no longer handed out.
    void request(std::set<std::string> sources, const std::filesystem::path& project_folder);
    /// Puts what was found since the last call into `hashes`; returns whether that was anything.
    bool take(ContentHashes& hashes);
    bool take(AnimationEnds& ends);  ///< known before the file's hash is
    bool is_busy() const;
    void wait();  ///< until nothing waits

  private:
    void run(const std::stop_token& thread_stops);
    mutable std::mutex mutex_;
    std::condition_variable_any changed_;
    std::function<void()> on_news_;
    std::filesystem::path folder_;
    std::deque<std::string> waiting_;
    ContentHashes found_;
    AnimationEnds found_ends_;
    bool reading_ = false;
    std::size_t request_ = 0;
    std::shared_ptr<CancelToken> reading_cancelled_ = std::make_shared<CancelToken>();
    std::jthread thread_;
};

}  // namespace ir::projects
