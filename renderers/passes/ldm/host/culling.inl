// Finds what outermost depths that are there already hide.
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include "renderers/passes/ldm/host/lanes.inl"
#include "renderers/passes/ldm/host/streamed_map.h"

#if defined(IR_LDM_HOST_CULLING) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_CULLING
#undef IR_LDM_HOST_CULLING
#else
#define IR_LDM_HOST_CULLING
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

/// Side of the blocks of texels that hidden things are found by.
constexpr int cull_side = 4;

/// What outermost depths that are there already hide.
class Culling {
  public:
    Culling(const Meshlets& meshlets, const StreamedMap& map, BuildScratch& scratch)
        : meshlets_(meshlets), map_(map), scratch_(scratch) {}

    /// Whether find_hidden was called.
    bool knows_blocks() const { return knows_blocks_; }

    /// Which things lie wholly between outermost depths that are there already: texels `left` … `right` and
    /// `top` … `bottom` of the band, depths `least` … `most`. Larger ones than so many blocks are not looked
    /// at.
    Mask hidden(Floats left, Floats right, Floats top, Floats bottom, Floats least, Floats most, Mask which,
                int most_blocks) const {
        const auto per_block = hn::Set(f, 1.0f / cull_side);
        left = hn::Floor(hn::Mul(left, per_block)), right = hn::Floor(hn::Mul(right, per_block));
        top = hn::Floor(hn::Mul(top, per_block)), bottom = hn::Floor(hn::Mul(bottom, per_block));
        const auto columns = hn::Sub(right, left), rows = hn::Sub(bottom, top);
        const auto known =
            hn::And(which, hn::Lt(hn::Max(columns, rows), hn::Set(f, static_cast<float>(most_blocks))));
        if (hn::AllFalse(f, known)) return known;
        const int side = block_side();
        const auto base = hn::ConvertTo(
            n, hn::IfThenElseZero(known, hn::MulAdd(top, hn::Set(f, static_cast<float>(side)), left)));
        auto far = hn::Set(n, 0xffff), near = far;
        for (int y = 0; y < most_blocks; ++y) {
            const auto in_rows = hn::And(known, hn::Ge(rows, hn::Set(f, static_cast<float>(y))));
            if (hn::AllFalse(f, in_rows)) break;
            for (int x = 0; x < most_blocks; ++x) {
                const auto in_both = hn::And(in_rows, hn::Ge(columns, hn::Set(f, static_cast<float>(x))));
                if (hn::AllFalse(f, in_both)) break;
                const auto place =
                    hn::Add(base, hn::IfThenElseZero(hn::RebindMask(n, in_both), hn::Set(n, y * side + x)));
                const auto block = hn::GatherIndex(n, scratch_.blocks.data(), place);
                far = hn::Min(far, upper_half(block));
                near = hn::Min(near, lower_half(block));
            }
        }
        // By more than what rounding to quanta may add.
        return hn::And(known, hn::And(hn::Lt(hn::Add(most, hn::Set(f, 1)), hn::ConvertTo(f, far)),
                                      hn::Lt(hn::Sub(hn::Set(f, 65536), least), hn::ConvertTo(f, near))));
    }

    /// Finds meshlets that need not be rasterised.
    void find_hidden(std::size_t first, std::size_t end) {
        find_blocks();
        const auto zero = hn::Zero(f), first_row = hn::Set(f, static_cast<float>(map_.first_row));
        const auto last_column = hn::Set(f, static_cast<float>(map_.resolution - 1)),
                   last_row = hn::Set(f, static_cast<float>(map_.rows - 1));
        const auto all = hn::FirstN(f, static_cast<std::size_t>(lanes));
        for (auto i = first; i < end; i += lanes) {
            const auto u = range_of(i, map_.frame.u), v = range_of(i, map_.frame.v),
                       depth = range_of(i, map_.frame.depth);
            const auto left = hn::Min(hn::Max(u.least, zero), last_column),
                       right = hn::Min(hn::Max(u.most, zero), last_column),
                       top = hn::Min(hn::Max(hn::Sub(v.least, first_row), zero), last_row),
                       bottom = hn::Min(hn::Max(hn::Sub(v.most, first_row), zero), last_row);
            auto bits = bits_of(hidden(left, right, top, bottom, depth.least, depth.most, all, 4));
            for (; bits != 0; bits &= bits - 1)
                scratch_.hidden[i + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)] = 1;
        }
    }

  private:
    int block_side() const { return (map_.resolution + cull_side - 1) / cull_side; }

    /// The least of a block's outermost depths on either side, of all blocks: packed as texels are.
    void find_blocks() {
        const int side = block_side(), block_rows = (map_.rows + cull_side - 1) / cull_side;
        const auto width = static_cast<std::size_t>(side) * cull_side;
        scratch_.row_far.resize(width);
        scratch_.row_near.resize(width);
        auto *HWY_RESTRICT far = scratch_.row_far.data(), *HWY_RESTRICT near = scratch_.row_near.data();
        scratch_.blocks.resize(static_cast<std::size_t>(side) * block_rows);
        for (int row = 0; row < block_rows; ++row) {
            std::fill(far, far + width, 65535);
            std::fill(near, near + width, 65535);
            for (int y = row * cull_side; y < std::min((row + 1) * cull_side, map_.rows); ++y) {
                const auto* HWY_RESTRICT texel =
                    map_.outermost.data() + static_cast<std::size_t>(y) * map_.resolution;
                for (int x = 0; x < map_.resolution; ++x) {
                    far[x] = std::min(far[x], static_cast<std::int32_t>(texel[x] >> 16));
                    near[x] = std::min(near[x], static_cast<std::int32_t>(texel[x] & 0xffffu));
                }
            }
            for (int block = 0; block < side; ++block) {
                std::int32_t block_far = 65535, block_near = 65535;
                for (int x = cull_side * block; x < cull_side * (block + 1); ++x) {
                    block_far = std::min(block_far, far[x]);
                    block_near = std::min(block_near, near[x]);
                }
                scratch_.blocks[static_cast<std::size_t>(row) * side + block] = static_cast<std::int32_t>(
                    static_cast<std::uint32_t>(block_far) << 16 | static_cast<std::uint32_t>(block_near));
            }
        }
        knows_blocks_ = true;
    }

    struct Range {
        Floats least, most;
    };
    /// Of the boxes of meshlets first … first + lanes - 1 along a row of the frame.
    Range range_of(std::size_t first, const glm::vec4& row) const {
        auto middle = hn::Set(f, row.w), reach = hn::Set(f, 0.01f);  // for rounding
        for (int axis = 0; axis < 3; ++axis) {
            middle = hn::MulAdd(hn::LoadU(f, meshlets_.centre[axis].data() + first), hn::Set(f, row[axis]),
                                middle);
            reach = hn::MulAdd(hn::LoadU(f, meshlets_.half[axis].data() + first),
                               hn::Set(f, std::abs(row[axis])), reach);
        }
        return {hn::Sub(middle, reach), hn::Add(middle, reach)};
    }

    const Meshlets& meshlets_;
    const StreamedMap& map_;
    BuildScratch& scratch_;
    bool knows_blocks_ = false;
};

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
