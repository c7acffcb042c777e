// The least outermost depths over windows of texels: of texels, or of blocks of texels where a window is
// large. Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include "renderers/passes/ldm/host/lanes.inl"
#include "renderers/passes/ldm/host/streamed_map.h"

#if defined(IR_LDM_HOST_WINDOWS) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_WINDOWS
#undef IR_LDM_HOST_WINDOWS
#else
#define IR_LDM_HOST_WINDOWS
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

/// Finds the blocks of a level, each of which holds the lesser halves of what is in it.
[[maybe_unused]] void find_level(StreamedMap& map, int level, std::vector<std::uint32_t>& line) {
    constexpr int side = StreamedMap::block_side;
    const auto from = map.levels[level - 1], to = map.levels[level];
    const auto* const cells = reinterpret_cast<const std::int32_t*>(map.outermost.data() + from.begin);
    auto* block = map.outermost.data() + to.begin;
    const auto largest = hn::Set(n, -1);
    for (int row = 0; row < to.rows; ++row) {
        line.assign(static_cast<std::size_t>(to.columns) * side + lanes, ~0u);
        auto* const least = reinterpret_cast<std::int32_t*>(line.data());
        for (int y = row * side; y < std::min((row + 1) * side, from.rows); ++y)
            for (int x = 0; x < from.columns; x += lanes) {
                const auto is_there = hn::FirstN(n, static_cast<std::size_t>(from.columns - x));
                const auto cell = hn::LoadU(n, cells + static_cast<std::size_t>(y) * from.columns + x);
                hn::StoreU(min_of_halves(hn::LoadU(n, least + x), hn::IfThenElse(is_there, cell, largest)), n,
                           least + x);
            }
        for (int column = 0; column < to.columns; ++column) {
            std::uint32_t far = 0xffff, near = 0xffff;
            for (int x = column * side; x < (column + 1) * side; ++x) {
                far = std::min(far, line[x] >> 16);
                near = std::min(near, line[x] & 0xffffu);
            }
            *block++ = far << 16 | near;
        }
    }
}
[[maybe_unused]] void find_blocks(StreamedMap& map, std::vector<std::uint32_t>& line) {
    for (int level = 1; level < StreamedMap::level_count; ++level) find_level(map, level, line);
}

/// Texels from the first to the last one.
struct Window {
    Floats left, right, top, bottom;
};

/// Calls `visit(cell, which, column, row)` for the cells that hold some windows: of the first level, from
/// `level` on, of which `most` a side are enough, their numbers counted from the window's first cell. Returns
/// the windows for which there is one. `first_level`: those that got cells of `level` itself.
template <int most, class Visit>
HWY_INLINE Mask visit_window(const StreamedMap& map, Window window, Mask which, int level, Visit visit) {
    const auto rough = [](Floats texel, float per_block) {
        return hn::Floor(hn::Mul(texel, hn::Set(f, per_block)));
    };
    const auto shrink = [&](const Window& w, float per_block) {
        return Window{rough(w.left, per_block), rough(w.right, per_block), rough(w.top, per_block),
                      rough(w.bottom, per_block)};
    };
    const auto is_small = [](const Window& w) {
        return hn::Lt(hn::Max(hn::Sub(w.right, w.left), hn::Sub(w.bottom, w.top)),
                      hn::Set(f, static_cast<float>(most)));
    };
    if (level > 0) window = shrink(window, 1.0f / StreamedMap::block_side);
    auto begin = hn::Set(f, static_cast<float>(map.levels[level].begin)),
         columns = hn::Set(f, static_cast<float>(map.levels[level].columns));
    auto known = hn::And(which, is_small(window));
    while (++level < StreamedMap::level_count) {
        const auto others = hn::AndNot(known, which);
        if (hn::AllFalse(f, others)) break;
        const auto larger = shrink(window, 1.0f / StreamedMap::block_side);
        window = {hn::IfThenElse(others, larger.left, window.left),
                  hn::IfThenElse(others, larger.right, window.right),
                  hn::IfThenElse(others, larger.top, window.top),
                  hn::IfThenElse(others, larger.bottom, window.bottom)};
        begin = hn::IfThenElse(others, hn::Set(f, static_cast<float>(map.levels[level].begin)), begin);
        columns = hn::IfThenElse(others, hn::Set(f, static_cast<float>(map.levels[level].columns)), columns);
        known = hn::And(which, is_small(window));
    }
    if (hn::AllFalse(f, known)) return known;
    const auto* const cells = reinterpret_cast<const std::int32_t*>(map.outermost.data());
    const auto width = hn::Sub(window.right, window.left), height = hn::Sub(window.bottom, window.top);
    auto place = hn::ConvertTo(
        n, hn::IfThenElseZero(known, hn::Add(begin, hn::MulAdd(window.top, columns, window.left))));
    const auto next_row = hn::ConvertTo(n, columns);
    auto in_rows = known;
    for (int y = 0;;) {
        auto in_both = in_rows;
        for (int x = 0;;) {
            const auto shifted =
                hn::Add(place, hn::IfThenElseZero(hn::RebindMask(n, in_both), hn::Set(n, x)));
            visit(hn::GatherIndex(n, cells, shifted), hn::RebindMask(n, in_both), x, y);
            if (++x == most) break;
            in_both = hn::And(in_rows, hn::Ge(width, hn::Set(f, static_cast<float>(x))));
            if (hn::AllFalse(f, in_both)) break;
        }
        if (++y == most) break;
        in_rows = hn::And(in_rows, hn::Ge(height, hn::Set(f, static_cast<float>(y))));
        if (hn::AllFalse(f, in_rows)) break;
        place = hn::Add(place, hn::IfThenElseZero(hn::RebindMask(n, in_rows), next_row));
    }
    return known;
}

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
