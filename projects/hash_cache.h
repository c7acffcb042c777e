#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/progress.h"

namespace ir::projects {

/// Content hashes of files that were read before, so that asking again costs one look at the file's status
/// (size, times, inode) and no reading. A file that changed shortly before it was read is read again: its
/// time may not tell the next change. Any thread.
class HashCache {
  public:
    /// Two seconds are the coarsest times that file systems keep (FAT).
    explicit HashCache(std::chrono::milliseconds settling = std::chrono::seconds(2)) : settling_(settling) {}
    /// As hash_file.
    std::string hash(const std::filesystem::path& file, const CancelToken* cancel = nullptr);
    /// As gltf_references.
    std::vector<std::string> references(const std::filesystem::path& file);
    /// As gltf_animation_end.
    double animation_end(const std::filesystem::path& file);
    /// How often a file's content had to be read.
    std::uint64_t reads() const;

  private:
    struct Stamp {
        std::uint64_t device = 0, inode = 0, size = 0;
        std::int64_t modified_ns = 0, changed_ns = 0;
        bool operator==(const Stamp&) const = default;
    };
    template <class Content>
    struct Known {
        Stamp stamp;
        Content content;
    };
    template <class Content>
    using Memory = std::map<std::string, Known<Content>>;

    static std::optional<Stamp> stamp_of(const std::filesystem::path& file);
    bool is_settled(const Stamp& stamp) const;
    template <class Content, class Read>
    Content remembered(Memory<Content>& memory, const std::filesystem::path& file, Read read);

    const std::chrono::milliseconds settling_;
    mutable std::mutex mutex_;
    Memory<std::string> hashes_;
    Memory<std::vector<std::string>> references_;
    Memory<double> animation_ends_;
    std::uint64_t reads_ = 0;
};

/// The process's own, behind scene_hash() and status().
HashCache& shared_hash_cache();

}  // namespace ir::projects
