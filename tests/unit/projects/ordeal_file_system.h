#pragma once

#include <atomic>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>

#include "renderers/core/file_system.h"
#include "tests/unit/projects/memory_file_system.h"

namespace ir::projects::testing {

/// The machine's files below one folder, which can stop at any step: the process is killed there, or the step
/// fails as on a full disk. A model of what had reached the disk is kept beside, so that a power cut can be
/// played out afterwards. Any thread.
class OrdealFileSystem final : public FileSystem {
  public:
    explicit OrdealFileSystem(std::filesystem::path root) : root_(std::move(root)) { settle(); }

    int steps = 0;
    int kill_at = -1;            ///< the step at which Killed is thrown, there and for ever after
    double torn = 0.5;           ///< the part of its bytes that a write leaves when it stops
    int fail_at = -1;            ///< the step that fails
    bool keeps_failing = false;  ///< and all later ones
    bool is_dead() const { return dead_; }
    bool died_writing() const { return died_writing_; }

    bool exists(const std::filesystem::path& path) override { return real().exists(path); }
    std::string read(const std::filesystem::path& file, std::size_t limit) override {
        return real().read(file, limit);
    }
    std::vector<std::filesystem::path> list(const std::filesystem::path& folder) override {
        return real().list(folder);
    }
    std::int64_t modified(const std::filesystem::path& file) override { return real().modified(file); }

    /// Two steps: bytes, then their sync.
    void write(const std::filesystem::path& file, const std::filesystem::path& target,
               const Fill& fill) override {
        const std::lock_guard guard(mutex_);
        std::ostringstream filled;
        fill(filled);
        const auto bytes = filled.str();
        const bool fails = next_step_fails();
        const bool dies = steps - 1 == kill_at;
        if (dead_ && !dies) throw Killed{};
        const auto part = static_cast<std::size_t>(static_cast<double>(bytes.size()) * torn);
        real().write(file, target, fill_with(fails || dies ? bytes.substr(0, part) : bytes));
        auto& node = names_[file.string()];
        if (!node) node = std::make_shared<Node>();
        node->modified = std::filesystem::last_write_time(file);
        died_writing_ = died_writing_ || dies;
        if (dies) throw Killed{};
        if (fails) throw Error(target.string() + ": cannot be written: No space left on device");
        step(target, "sync");
        node->durable = bytes;
    }
    void pour(const std::filesystem::path& file, std::ostream& out) override { real().pour(file, out); }
    void sync_directory(const std::filesystem::path& folder) override {
        const std::lock_guard guard(mutex_);
        step(folder, "sync");
        const auto is_inside = [&](const auto& entry) {
            return std::filesystem::path(entry.first).parent_path() == folder;
        };
        std::erase_if(durable_names_, is_inside);
        for (const auto& entry : names_)
            if (is_inside(entry)) durable_names_.insert(entry);
    }
    void rename(const std::filesystem::path& from, const std::filesystem::path& to) override {
        const std::lock_guard guard(mutex_);
        step(to, "replace");
        real().rename(from, to);
        names_[to.string()] = names_.at(from.string());
        names_.erase(from.string());
    }
    void remove(const std::filesystem::path& file) override {
        const std::lock_guard guard(mutex_);
        step(file, "remove");
        real().remove(file);
        names_.erase(file.string());
    }
    void remove_all(const std::filesystem::path& folder) override {
        const std::lock_guard guard(mutex_);
        if (dead_) throw Killed{};
        real().remove_all(folder);
    }
    void create_directories(const std::filesystem::path& folder) override {
        const std::lock_guard guard(mutex_);
        step(folder, "create");
        real().create_directories(folder);
    }

    /// The power went: only what was synced is left. Names that changed since their folder was synced may be
    /// the old or the new ones.
    void lose_unsynced(bool newest_names) {
        const auto left = newest_names ? names_ : durable_names_;
        for (const auto& [name, node] : names_)
            if (left.count(name) == 0) real().remove(name);
        for (const auto& [name, node] : left) {
            std::error_code ignored;
            std::filesystem::create_directories(std::filesystem::path(name).parent_path(), ignored);
            std::ofstream(name, std::ios::binary) << node->durable;
            std::filesystem::last_write_time(name, node->modified);
        }
    }

    /// Everything is on the disk, as after a while without changes; steps are counted from here.
    void settle() {
        const std::lock_guard guard(mutex_);
        names_.clear();
        for (const auto& file : real().list(root_)) {
            if (file.filename().string().rfind(".lock", 0) == 0) continue;
            auto node = std::make_shared<Node>();
            node->durable = real().read(root_ / file, 1u << 30);
            node->modified = std::filesystem::last_write_time(root_ / file);
            names_[(root_ / file).string()] = node;
        }
        durable_names_ = names_;
        steps = 0;
    }

  private:
    struct Node {
        std::string durable;
        std::filesystem::file_time_type modified;
    };
    static FileSystem& real() { return real_file_system(); }
    bool next_step_fails() {
        const int step = steps++;
        if (step == kill_at) dead_ = true;
        return fail_at >= 0 && (step == fail_at || (keeps_failing && step > fail_at));
    }
    void step(const std::filesystem::path& file, const char* action) {
        const bool fails = next_step_fails();
        if (dead_) throw Killed{};
        if (fails) throw Error(file.string() + ": cannot " + action + ": No space left on device");
    }
    const std::filesystem::path root_;
    std::mutex mutex_;
    std::atomic<bool> dead_ = false, died_writing_ = false;
    std::map<std::string, std::shared_ptr<Node>> names_, durable_names_;
};

}  // namespace ir::projects::testing
