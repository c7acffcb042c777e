#include "tests/fuzz/scene/attempts.h"
#include "tests/fuzz/targets/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ir::fuzz::loads_scene(ir::fuzz::write_input("a.gltf", data, size));
    return 0;
}
