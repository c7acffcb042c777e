#include "projects/hash_cache.h"

#include <sys/stat.h>

#include <chrono>

#include "projects/gltf_references.h"
#include "projects/hash.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

std::int64_t as_nanoseconds(const timespec& time) {
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

std::optional<HashCache::Stamp> HashCache::stamp_of(const fs::path& file) {
    struct stat info {};
    if (::stat(file.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
    return Stamp{info.st_dev, info.st_ino, static_cast<std::uint64_t>(info.st_size),
                 as_nanoseconds(info.st_mtim), as_nanoseconds(info.st_ctim)};
}

/// By the time of the status change, which no program can set at will.
bool HashCache::is_settled(const Stamp& stamp) const {
    using namespace std::chrono;
    const auto now = duration_cast<nanoseconds>(system_clock::now().time_since_epoch());
    return now.count() - stamp.changed_ns > duration_cast<nanoseconds>(settling_).count();
}

template <class Content, class Read>
Content HashCache::remembered(Memory<Content>& memory, const fs::path& file, Read read) {
    const auto before = stamp_of(file);
    {
        const std::lock_guard guard(mutex_);
        const auto found = memory.find(file.string());
        if (before && found != memory.end() && found->second.stamp == *before) return found->second.content;
        ++reads_;
    }
    Content content = read();
    if (before && is_settled(*before) && stamp_of(file) == before) {
        const std::lock_guard guard(mutex_);
        memory[file.string()] = {*before, content};
    }
    return content;
}

std::string HashCache::hash(const fs::path& file, const CancelToken* cancel) {
    return remembered(hashes_, file, [&] { return hash_file(file, cancel); });
}

std::vector<std::string> HashCache::references(const fs::path& file) {
    return remembered(references_, file, [&] { return gltf_references(file).read; });
}

double HashCache::animation_end(const fs::path& file) {
    return remembered(animation_ends_, file, [&] { return gltf_animation_end(file); });
}

std::uint64_t HashCache::reads() const {
    const std::lock_guard guard(mutex_);
    return reads_;
}

HashCache& shared_hash_cache() {
    static HashCache cache;
    return cache;
}

}  // namespace ir::projects
