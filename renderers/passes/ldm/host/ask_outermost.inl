// Asks the outermost depths of texels, and of tiles of pixels at once where one answer holds for all.
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include "renderers/passes/ldm/host/question.inl"

#if defined(IR_LDM_HOST_ASK_OUTERMOST) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_ASK_OUTERMOST
#undef IR_LDM_HOST_ASK_OUTERMOST
#else
#define IR_LDM_HOST_ASK_OUTERMOST
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

/// Whether anything lies beyond the start, from the outermost depths.
void ask_outermost(const PixelTiles& tiles, std::size_t tile, const Asked& asked, const SelfHitRule& rule,
                   float scale, std::uint32_t* sums) {
    const auto* const map = reinterpret_cast<const std::int32_t*>(asked.map.outermost.data());
    for (int i = 0; i < pixels; i += lanes) {
        const auto q = question(tiles, tile * pixels + static_cast<std::size_t>(i), asked, rule);
        const auto asks = hn::And(q.above, q.here);
        auto open = hn::And(q.above, q.outside);
        if (asked.map.first_row > 0) open = hn::And(open, hn::Ne(q.cosine, q.cosine));
        const auto texel = hn::GatherIndex(n, map, q.texel);
        const auto outermost =
            hn::IfThenElse(hn::RebindMask(n, q.forward), upper_half(texel), lower_half(texel));
        const auto hit = hn::RebindMask(f, hn::Gt(outermost, key_of(q.start)));
        open = hn::Or(open, hn::AndNot(hit, asks));
        if (hn::AllFalse(f, open)) continue;
        add(sums + i, part_of_sum(hn::Set(f, 1), q.cosine, scale), open);
    }
}

/// Least and largest dot product with the vectors in boxes of tiles first … first + lanes - 1.
struct Range {
    Floats least, most;
};
Range range_of(const PixelTiles::Boxes& boxes, std::size_t first, const glm::vec4& row, float added) {
    auto middle = hn::Set(f, added), reach = hn::Zero(f);
    for (int axis = 0; axis < 3; ++axis) {
        middle = hn::MulAdd(hn::LoadU(f, boxes.centre[axis].data() + first), hn::Set(f, row[axis]), middle);
        reach =
            hn::MulAdd(hn::LoadU(f, boxes.half[axis].data() + first), hn::Set(f, std::abs(row[axis])), reach);
    }
    return {hn::Sub(middle, reach), hn::Add(middle, reach)};
}
Floats largest(const Range& range) {
    return hn::Max(hn::Abs(range.least), hn::Abs(range.most));
}

/// What is known of tiles of pixels without asking any of them, as bits.
struct Verdict {
    std::uint32_t nothing = 0;  ///< no pixel gets light from this band
    std::uint32_t open = 0;     ///< all pixels are open
};

/// Judges tiles first … first + lanes - 1 by the outermost depths of all texels that they may ask: no depth
/// reaches beyond what is largest, and all reach beyond what is least. Rounding is covered by margins.
Verdict judge(const PixelTiles& tiles, std::size_t first, const Asked& asked, const SelfHitRule& rule) {
    constexpr float texel_margin = 0.01f;
    constexpr int most_texels = 6;  // a side
    const auto& map = asked.map;
    const auto& frame = map.frame;
    const auto zero = hn::Zero(f), one = hn::Set(f, 1);
    const auto cosine = range_of(tiles.normal_boxes, first, frame.direction, 0),
               facing = range_of(tiles.geometric_normal_boxes, first, frame.direction, 0);
    const auto forward = hn::And(hn::Gt(cosine.least, zero), hn::Gt(facing.least, zero)),
               backward = hn::And(hn::Lt(cosine.most, zero), hn::Lt(facing.most, zero));
    const auto below = hn::Or(hn::And(hn::Gt(cosine.least, zero), hn::Le(facing.most, zero)),
                              hn::And(hn::Lt(cosine.most, zero), hn::Ge(facing.least, zero)));
    const auto u = range_of(tiles.position_boxes, first, frame.u, frame.u.w),
               v = range_of(tiles.position_boxes, first, frame.v, frame.v.w),
               depth = range_of(tiles.position_boxes, first, frame.depth, frame.depth.w);
    // The largest gain and tolerance of ask_tangent.
    const auto least_abs_facing =
        hn::Max(hn::Set(f, least_facing), hn::IfThenElse(forward, facing.least, hn::Neg(facing.most)));
    const auto slope =
        hn::Div(hn::Add(largest(range_of(tiles.geometric_normal_boxes, first, asked.slope_u, 0)),
                        largest(range_of(tiles.geometric_normal_boxes, first, asked.slope_v, 0))),
                least_abs_facing);
    const auto dip = hn::Set(f, rule.max_dip * asked.texel_quanta),
               half_slope = hn::Mul(slope, hn::Set(f, 0.505f));
    const auto tolerance = hn::Add(
        hn::Set(f, rule.quanta),
        hn::Min(hn::Mul(hn::Set(f, rule.slope), slope), hn::Set(f, most_tolerance * asked.texel_quanta)));
    const auto gain = hn::Add(hn::Min(half_slope, dip), tolerance);
    // The texels that may be asked: where rays may dip, neighbours too.
    const auto margin = hn::Add(hn::Set(f, texel_margin), hn::IfThenElseZero(hn::Gt(half_slope, dip), one));
    const auto left = hn::Floor(hn::Sub(u.least, margin)), right = hn::Floor(hn::Add(u.most, margin)),
               top = hn::Floor(hn::Sub(v.least, margin)), bottom = hn::Floor(hn::Add(v.most, margin));
    const auto first_row = hn::Set(f, static_cast<float>(map.first_row)),
               end_row = hn::Set(f, static_cast<float>(map.first_row + map.rows)),
               end = hn::Set(f, static_cast<float>(map.resolution));
    Verdict verdict;
    auto nothing = below;
    // Pixels outside of the map count with its first band.
    if (map.first_row > 0 || map.rows < map.resolution) {
        const auto inside = hn::And(hn::And(hn::Ge(left, one), hn::Lt(right, hn::Sub(end, one))),
                                    hn::And(hn::Ge(top, one), hn::Lt(bottom, hn::Sub(end, one))));
        nothing = hn::Or(nothing, hn::And(inside, hn::Or(hn::Lt(hn::Add(bottom, one), first_row),
                                                         hn::Gt(hn::Sub(top, one), end_row))));
    }
    const auto columns = hn::Sub(right, left), rows = hn::Sub(bottom, top);
    auto known = hn::And(hn::Or(forward, backward), hn::Lt(hn::Max(columns, rows), hn::Set(f, most_texels)));
    known = hn::And(known, hn::And(hn::And(hn::Ge(left, zero), hn::Lt(right, end)),
                                   hn::And(hn::Ge(top, first_row), hn::Lt(bottom, end_row))));
    if (!hn::AllFalse(f, known)) {
        const auto* const texels = reinterpret_cast<const std::int32_t*>(map.outermost.data());
        const auto base =
            hn::ConvertTo(n, hn::IfThenElseZero(known, hn::MulAdd(hn::Sub(top, first_row), end, left)));
        const auto low_half = hn::Set(n, 0xffff);
        auto least = low_half, most = hn::Zero(n);
        for (int y = 0; y < most_texels; ++y) {
            const auto in_rows = hn::And(known, hn::Ge(rows, hn::Set(f, static_cast<float>(y))));
            if (hn::AllFalse(f, in_rows)) break;
            for (int x = 0; x < most_texels; ++x) {
                const auto in_both = hn::And(in_rows, hn::Ge(columns, hn::Set(f, static_cast<float>(x))));
                if (hn::AllFalse(f, in_both)) break;
                const auto which = hn::RebindMask(n, in_both);
                const auto place =
                    hn::Add(base, hn::IfThenElseZero(which, hn::Set(n, y * map.resolution + x)));
                const auto texel = hn::GatherIndex(n, texels, place);
                const auto outermost =
                    hn::IfThenElse(hn::RebindMask(n, forward), upper_half(texel), lower_half(texel));
                least = hn::Min(least, hn::IfThenElse(which, outermost, low_half));
                most = hn::Max(most, hn::IfThenElseZero(which, outermost));
            }
        }
        const auto own_least = hn::IfThenElse(forward, depth.least, hn::Sub(hn::Set(f, 65535), depth.most)),
                   own_most = hn::IfThenElse(forward, depth.most, hn::Sub(hn::Set(f, 65535), depth.least));
        const auto start = hn::Add(hn::Add(own_most, hn::Max(gain, zero)), one);
        nothing = hn::Or(nothing, hn::And(known, hn::Gt(hn::ConvertTo(f, least), start)));
        const auto open = hn::And(known, hn::Lt(hn::ConvertTo(f, most), hn::Sub(own_least, one)));
        verdict.open = bits_of(open);
    }
    verdict.nothing = bits_of(nothing);
    return verdict;
}

/// All of a tile's pixels are open.
void add_open(const PixelTiles& tiles, std::size_t tile, const Asked& asked, float scale,
              std::uint32_t* sums) {
    for (int i = 0; i < pixels; i += lanes) {
        const auto cosine = hn::Abs(
            dot(load(tiles.normal, tile * pixels + static_cast<std::size_t>(i)), asked.map.frame.direction));
        auto* to = reinterpret_cast<std::int32_t*>(sums) + i;
        hn::StoreU(hn::Add(hn::LoadU(n, to), part_of_sum(hn::Set(f, 1), cosine, scale)), n, to);
    }
}

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
