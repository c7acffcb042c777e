#include "renderers/core/error.h"
#include "renderers/gl/preprocessor.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/targets/target.h"

using namespace ir;

/// Three shaders, with zeros between them.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    for (const char* name : {"shaders/main.comp", "shaders/a.glsl", "shaders/lib/b.glsl"}) {
        std::size_t end = 0;
        while (end < size && data[end] != 0) ++end;
        fuzz::write_input(name, data, end);
        data += end < size ? end + 1 : end;
        size -= end < size ? end + 1 : end;
    }
    gl::FileStamps seen;
    const auto shaders = fuzz::folder() / "shaders";
    try {
        const auto stage = gl::preprocess(shaders, "main.comp", {{"N", "4"}}, "", {}, seen);
        fuzz::require(stage.place_of(1) != "", "a line that came from nowhere");
    } catch (const Error& error) {
        fuzz::require(*error.what() != 0, "a refusal without a reason");
    }
    for (const auto& [file, stamp] : seen)
        fuzz::require(*file.lexically_relative(shaders).begin() != "..", "looked outside: " + file.string());
    return 0;
}
