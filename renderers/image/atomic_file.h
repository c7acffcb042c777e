#pragma once

#include <filesystem>

namespace ir {

/// A file that appears under its name only when it is complete: written beside it as a temporary, then
/// renamed. Without commit() the temporary is removed.
class AtomicFile {
  public:
    /// Creates the temporary. Throws Error, naming the file, where the folder cannot be written.
    explicit AtomicFile(std::filesystem::path file);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    const std::filesystem::path& temporary() const { return temporary_; }
    /// Syncs and renames. Throws Error.
    void commit();

  private:
    std::filesystem::path file_, temporary_;
    bool committed_ = false;
};

}  // namespace ir
