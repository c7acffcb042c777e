#include "renderers/core/resources_path.h"

#include <cstdlib>

#include "renderers/core/error.h"

namespace ir {
namespace {

/// The folder that holds bin/ with the binary.
std::filesystem::path prefix() {
    std::error_code ignored;
    return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
}

}  // namespace

std::filesystem::path data_directory() {
    if (const char* chosen = std::getenv("INTERREFLECT_DATA")) return chosen;
    std::error_code ignored;
    const auto beside = prefix() / "share" / "interreflect";
    if (std::filesystem::is_directory(beside / "shaders", ignored)) return beside;
    throw Error("no shaders in " + beside.string() +
                "; set INTERREFLECT_DATA to the folder that holds shaders/ and samples/");
}

std::filesystem::path shader_directory() {
    return data_directory() / "shaders";
}
std::filesystem::path samples_directory() {
    return data_directory() / "samples";
}
std::filesystem::path module_directory() {
    return prefix() / "lib" / "interreflect";
}

}  // namespace ir
