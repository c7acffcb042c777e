#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace ir {

/// A place for what a test writes. The same test in another process, such as another build's, has another.
inline std::filesystem::path own_folder(const std::string& name) {
    return std::filesystem::temp_directory_path() /
           ("interreflect-" + name + "-" + std::to_string(::getpid()));
}

}  // namespace ir
