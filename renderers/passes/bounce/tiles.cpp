#include "renderers/passes/bounce/tiles.h"

#include <algorithm>

namespace ir::passes::bounce {
namespace {

constexpr std::int64_t tile_side = 8;
constexpr std::int64_t max_groups = 65535;  // of a dispatch, on every device

/// Constants of tiles.glsl.
struct Tiles {
    int first_tile, tiles_across;
    IR_FIELDS(first_tile, tiles_across)
};

std::int64_t tiles(std::int64_t pixels) {
    return (pixels + tile_side - 1) / tile_side;
}

}  // namespace

void compute_by_tiles(graph::PassBuilder& pass, const graph::GraphBuilder& builder,
                      const gl::ProgramSource& source, graph::Constants constants) {
    const auto across = tiles(builder.inputs().view.width),
               count = across * tiles(builder.inputs().view.height);
    pass.execute_sliced(
        count,
        [=](graph::PassContext& context, graph::Slice slice) {
            const auto& program = context.use(source);
            constants.give(context, program);
            for (auto first = slice.begin; first < slice.end; first += max_groups) {
                program.set(Tiles{static_cast<int>(first), static_cast<int>(across)});
                program.dispatch(tile_side * std::min(max_groups, slice.end - first), tile_side);
            }
        },
        std::max<std::int64_t>(1, count / 8));
}

}  // namespace ir::passes::bounce
