#include "projects/last_picture.h"
#include "projects/pack.h"
#include "renderers/core/error.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/targets/target.h"

using namespace ir;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    namespace fs = std::filesystem;
    const auto file = fuzz::write_input("a.tar", data, size);
    const auto inside = fuzz::folder() / "inside";
    fs::create_directories(inside);
    try {
        projects::unpack_project(file, inside);
    } catch (const Error& error) {
        fuzz::require_one_line(error.what());
        fuzz::require(fs::is_empty(inside), "something is left behind");
    }
    fs::remove_all(inside);
    try {
        projects::copy_last_picture(file, fuzz::folder() / "picture.exr");
    } catch (const Error& error) {
        fuzz::require_one_line(error.what());
    }
    for (const auto& entry : fs::directory_iterator(fuzz::folder())) {
        const auto name = entry.path().filename();
        fuzz::require(name == "a.tar" || name == "picture.exr" || name == "picture.exr.list",
                      "something is written outside: " + name.string());
    }
    return 0;
}
