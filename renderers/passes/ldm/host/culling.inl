// Finds what outermost depths that are there already hide.
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include "renderers/passes/ldm/host/windows.inl"

#if defined(IR_LDM_HOST_CULLING) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_CULLING
#undef IR_LDM_HOST_CULLING
#else
#define IR_LDM_HOST_CULLING
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

/// What outermost depths that are there already hide.
class Culling {
  public:
    Culling(const Meshlets& meshlets, StreamedMap& map, BuildScratch& scratch)
        : meshlets_(meshlets), map_(map), scratch_(scratch) {}

    /// Whether find_hidden was called.
    bool knows_blocks() const { return knows_blocks_; }

    /// Which things lie wholly between outermost depths that are there already: windows of texels of the band
    /// with depths `least` … `most`. `max_blocks` a side are looked at.
    template <int max_blocks>
    Mask hidden(const Window& window, Floats least, Floats most, Mask which) const {
        auto outermost = hn::Set(n, -1);
        const auto known =
            visit_window<max_blocks>(map_, window, which, 1, [&](Ints block, hn::Mask<IntTag> in, int, int) {
                outermost = min_of_halves(outermost, hn::IfThenElse(in, block, outermost));
            });
        const auto far = upper_half(outermost), near = lower_half(outermost);
        // By more than what rounding to quanta may add.
        return hn::And(known, hn::And(hn::Lt(hn::Add(most, hn::Set(f, 1)), hn::ConvertTo(f, far)),
                                      hn::Lt(hn::Sub(hn::Set(f, 65536), least), hn::ConvertTo(f, near))));
    }

    /// Finds meshlets that need not be rasterised.
    void find_hidden(std::size_t first, std::size_t end) {
        find_blocks(map_, scratch_.line);
        knows_blocks_ = true;
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
            auto bits = bits_of(hidden<4>({left, right, top, bottom}, depth.least, depth.most, all));
            for (; bits != 0; bits &= bits - 1)
                scratch_.hidden[i + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)] = 1;
        }
    }

  private:
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
    StreamedMap& map_;
    BuildScratch& scratch_;
    bool knows_blocks_ = false;
};

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
