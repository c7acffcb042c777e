#pragma once

#include <stdlib.h>

#include <filesystem>

#include "renderers/core/error.h"

namespace ir::cli {

/// A folder that goes with it. Throws Error.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        auto name = (std::filesystem::temp_directory_path() / "interreflect-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw Error(name + ": the folder cannot be made");
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace ir::cli
