#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <ostream>
#include <string>

#include "renderers/core/progress.h"

namespace ir::projects {

/// Writes a POSIX ustar archive of plain files. Equal contents give equal bytes: no dates, no owners.
class TarWriter {
  public:
    /// Whether all could be written is for the owner of the stream to see.
    explicit TarWriter(std::ostream& out, const CancelToken* cancel = nullptr) : out_(out), cancel_(cancel) {}
    void add_text(const std::string& name, const std::string& text);
    /// Throws Error when `source` cannot be read or its size changes meanwhile, and Cancelled.
    void add_file(const std::string& name, const std::filesystem::path& source);
    void finish();  ///< writes the end

  private:
    void header(const std::string& name, std::uint64_t size);
    void pad(std::uint64_t size);
    std::ostream& out_;
    const CancelToken* cancel_;
};

/// Calls `read(name, content, size)` for every plain file, which may read up to `size` bytes of `content`.
/// Throws InputError for what is no such archive, for links and for names that leave the archive's folder.
void read_tar(
    const std::filesystem::path& file,
    const std::function<void(const std::string& name, std::istream& content, std::uint64_t size)>& read);

}  // namespace ir::projects
