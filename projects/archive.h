#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "renderers/core/progress.h"

struct archive;

namespace ir::projects {

/// That an archive may hold, folders included: what a project keeps is some files for each picture.
inline constexpr int max_packed_files = 100'000;
/// Folders within each other, below that of the project.
inline constexpr int max_packed_depth = 64;

/// Writes an uncompressed tar archive of plain files. Equal contents give equal bytes: no dates, no owners.
class ArchiveWriter {
  public:
    /// Whether all could be written is for the owner of the stream to see.
    explicit ArchiveWriter(std::ostream& out, const CancelToken* cancel = nullptr);
    void add_text(const std::string& name, const std::string& text);
    /// Throws Error when `source` cannot be read or its size changes meanwhile, and Cancelled.
    void add_file(const std::string& name, const std::filesystem::path& source);
    void finish();  ///< writes the end

  private:
    void header(const std::string& name, std::uint64_t size);
    void put(const char* data, std::size_t size);
    std::ostream& out_;
    const CancelToken* cancel_;
    int files_ = 0;
    std::unique_ptr<archive, int (*)(archive*)> archive_;
};

/// Writes the content of a file of an archive into a stream.
using CopyContent = std::function<void(std::ostream& out)>;

/// Calls `read(name, copy)`, until it says false, for every plain file of a tar archive, also of one that
/// gzip, xz or zstd made smaller once. Throws InputError for what is no such archive, for what unpacks
/// without end, for links and for names that leave the archive's folder, and Cancelled.
void read_archive(const std::filesystem::path& file,
                  const std::function<bool(const std::string& name, const CopyContent& copy)>& read,
                  const CancelToken* cancel = nullptr);

}  // namespace ir::projects
