#include "tests/fuzz/projects/attempts.h"
#include "tests/fuzz/targets/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ir::fuzz::changes_shaders(ir::fuzz::text_of(data, size));
    return 0;
}
