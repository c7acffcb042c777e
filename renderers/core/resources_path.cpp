#include "renderers/core/resources_path.h"

#include <dlfcn.h>
#include <link.h>

#include <cstdlib>

#include "renderers/core/error.h"

namespace ir {
namespace {

namespace fs = std::filesystem;

/// What this code is in: the program, or a library that another program has loaded.
fs::path own_file() {
    Dl_info info;
    link_map* library = nullptr;
    const auto found = dladdr1(reinterpret_cast<const void*>(&data_directory), &info,
                               reinterpret_cast<void**>(&library), RTLD_DL_LINKMAP);
    std::error_code ignored;
    if (found == 0 || library->l_name[0] == '\0') return fs::read_symlink("/proc/self/exe", ignored);
    return fs::canonical(library->l_name, ignored);
}

/// The folder that holds bin/ with the program, or lib/ with the library somewhere below.
fs::path prefix() {
    const auto file = own_file();
    for (auto folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
        if (folder.filename() == "bin" || folder.filename() == "lib") return folder.parent_path();
    return file.parent_path().parent_path();
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
