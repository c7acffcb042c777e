#include "app/engine/stored_state.h"
#include "renderers/core/error.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/targets/target.h"

using namespace ir;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto file = fuzz::write_input("state.exr", data, size);
    try {
        engine::load_state(file);
    } catch (const InputError& error) {
        fuzz::require_one_line(error.what(), file + ": ");
    }
    return 0;
}
