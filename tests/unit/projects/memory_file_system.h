#pragma once

#include <map>
#include <sstream>
#include <string>

#include "renderers/core/error.h"
#include "renderers/core/file_system.h"

namespace ir::projects::testing {

/// The process or machine ended at this step.
struct Killed {};

/// Files in memory that can stop at any step and then show what a disk might hold. Bytes are durable once
/// synced, names once their folder is synced; what is not may or may not have reached the disk.
class MemoryFileSystem final : public FileSystem {
  public:
    int steps = 0;
    int kill_at = -1;  ///< the step at which Killed is thrown; a write stops half way
    int fail_at = -1;  ///< the step from which on writing fails as on a full disk
    bool disk_is_full = false;
    bool forgets_to_sync = false;  ///< what a write must not

    bool exists(const std::filesystem::path& path) override { return names_.count(path.string()) != 0; }

    std::string read(const std::filesystem::path& file, std::size_t limit) override {
        const auto found = names_.find(file.string());
        if (found == names_.end()) throw InputError(file.string(), "", "cannot be opened");
        if (found->second->now.size() > limit) throw InputError(file.string(), "", "too long");
        return found->second->now;
    }

    void write(const std::filesystem::path& file, const std::filesystem::path& target,
               const Fill& fill) override {
        std::ostringstream filled;
        fill(filled);
        const auto bytes = filled.str();
        auto& node = names_[file.string()];
        if (!node) node = std::make_shared<Node>();
        node->now.clear();
        node->changed = ++clock_;
        if (is_killed()) {
            node->now = bytes.substr(0, bytes.size() / 2);
            throw Killed{};
        }
        if (disk_is_full || (fail_at >= 0 && steps > fail_at)) {
            node->now = bytes.substr(0, bytes.size() / 3);
            throw Error(target.string() + ": cannot be written: No space left on device");
        }
        node->now = bytes;
        step();
        if (!forgets_to_sync) node->durable = node->now;
    }

    void sync_directory(const std::filesystem::path&) override {
        step();
        durable_names_ = names_;
    }

    void rename(const std::filesystem::path& from, const std::filesystem::path& to) override {
        step();
        names_[to.string()] = names_.at(from.string());
        names_.erase(from.string());
    }

    void remove(const std::filesystem::path& file) override {
        step();
        names_.erase(file.string());
    }

    void create_directories(const std::filesystem::path&) override { step(); }

    void pour(const std::filesystem::path& file, std::ostream& out) override {
        out << names_.at(file.string())->now;
    }

    std::vector<std::filesystem::path> list(const std::filesystem::path& folder) override {
        std::vector<std::filesystem::path> found;
        for (const auto& [name, node] : names_)
            if (name.rfind(folder.string() + "/", 0) == 0)
                found.push_back(std::filesystem::path(name).lexically_relative(folder));
        return found;
    }

    void remove_all(const std::filesystem::path& folder) override {
        for (const auto& file : list(folder)) remove(folder / file);
    }

    std::int64_t modified(const std::filesystem::path& file) override {
        return names_.at(file.string())->changed;
    }

    /// After a crash of the machine: only what was synced. Names that were renamed and not yet synced may be
    /// old or new: `newest_names` chooses.
    void lose_unsynced(bool newest_names) {
        if (!newest_names) names_ = durable_names_;
        for (auto& [name, node] : names_) node->now = node->durable;
        kill_at = fail_at = -1;
    }
    void survive() { kill_at = fail_at = -1; }

    /// Everything is on the disk, as after a while without changes.
    void settle() {
        for (auto& [name, node] : names_) node->durable = node->now;
        durable_names_ = names_;
        steps = 0;
    }

    std::vector<std::string> list() const {
        std::vector<std::string> result;
        for (const auto& [name, node] : names_) result.push_back(name);
        return result;
    }

  private:
    struct Node {
        std::string now, durable;
        std::int64_t changed = 0;
    };
    bool is_killed() { return steps++ == kill_at; }
    void step() {
        if (is_killed()) throw Killed{};
    }
    std::map<std::string, std::shared_ptr<Node>> names_, durable_names_;
    std::int64_t clock_ = 0;
};

}  // namespace ir::projects::testing
