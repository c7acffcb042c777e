// Queries the outermost depths of texels.
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include "renderers/passes/ldm/host/question.inl"

#if defined(IR_LDM_HOST_QUERY_OUTERMOST) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_QUERY_OUTERMOST
#undef IR_LDM_HOST_QUERY_OUTERMOST
#else
#define IR_LDM_HOST_QUERY_OUTERMOST
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

/// Whether anything lies beyond the start, from the outermost depths.
void query_outermost(const PixelTiles& tiles, std::size_t tile, const QueriedMap& queried,
                     const SelfHitRule& rule, float scale, std::uint32_t* sums) {
    const auto* const map = reinterpret_cast<const std::int32_t*>(queried.map.outermost.data());
    for (int i = 0; i < pixels; i += lanes) {
        const auto q = question(tiles, tile * pixels + static_cast<std::size_t>(i), queried, rule);
        const auto queries = hn::And(q.above, q.here);
        auto open = hn::And(q.above, q.outside);
        if (queried.map.first_row > 0) open = hn::And(open, hn::Ne(q.cosine, q.cosine));
        const auto texel = hn::GatherIndex(n, map, q.texel);
        const auto outermost =
            hn::IfThenElse(hn::RebindMask(n, q.forward), upper_half(texel), lower_half(texel));
        const auto hit = hn::RebindMask(f, hn::Gt(outermost, key_of(q.start)));
        open = hn::Or(open, hn::AndNot(hit, queries));
        if (hn::AllFalse(f, open)) continue;
        add(sums + i, part_of_sum(hn::Set(f, 1), q.cosine, scale), open);
    }
}

/// Where the pixels of a tile look to.
enum class Along { v, minus_v, either };

/// Of a tile whose pixels all query texels of the band; along one side only they are above their surfaces.
template <Along side>
void query_inside(const PixelTiles& tiles, std::size_t tile, const QueriedMap& queried,
                  const SelfHitRule& rule, float scale, std::uint32_t* sums) {
    const auto* const map = reinterpret_cast<const std::int32_t*>(queried.map.outermost.data());
    const auto& frame = queried.map.frame;
    const auto zero = hn::Zero(f);
    const auto first_row = hn::Set(f, static_cast<float>(queried.map.first_row)),
               resolution = hn::Set(f, static_cast<float>(queried.map.resolution));
    const bool is_flat = tiles.geometric_normal_boxes.is_point(tile);
    Floats facing = zero;
    Slant slant{};
    for (int i = 0; i < pixels; i += lanes) {
        const auto place = tile * pixels + static_cast<std::size_t>(i);
        if (i == 0 || !is_flat) {
            const auto normal = load(tiles.geometric_normal, place);
            facing = dot(normal, frame.direction);
            slant = slant_of(queried, rule, normal, facing);
        }
        const auto position = load(tiles.position, place);
        const auto at =
            texel_of<true>(queried, rule, slant, project(position, frame.u), project(position, frame.v));
        const auto depth = project(position, frame.depth), behind = hn::Sub(hn::Set(f, 65535), depth);
        const auto texel = hn::GatherIndex(
            n, map, hn::ConvertTo(n, hn::MulAdd(hn::Sub(at.row, first_row), resolution, at.column)));
        const auto far = upper_half(texel), near = lower_half(texel);
        if constexpr (side == Along::either) {
            const auto cosine = dot(load(tiles.normal, place), frame.direction);
            const auto forward = hn::Gt(cosine, zero);
            const auto start = start_of(hn::IfThenElse(forward, depth, behind), at, slant);
            const auto outermost = hn::IfThenElse(hn::RebindMask(n, forward), far, near);
            const auto above = hn::Gt(hn::Mul(cosine, facing), zero);
            const auto open = hn::AndNot(hn::RebindMask(f, hn::Gt(outermost, key_of(start))), above);
            if (hn::AllFalse(f, open)) continue;
            add(sums + i, part_of_sum(hn::Set(f, 1), hn::Abs(cosine), scale), open);
        } else {
            const auto start = start_of(side == Along::v ? depth : behind, at, slant);
            const auto open = hn::Not(hn::Gt(side == Along::v ? far : near, key_of(start)));
            if (hn::AllFalse(n, open)) continue;
            const auto cosine = hn::Abs(dot(load(tiles.normal, place), frame.direction));
            add(sums + i, part_of_sum(hn::Set(f, 1), cosine, scale), hn::RebindMask(f, open));
        }
    }
}

/// All of a tile's pixels are open.
void add_open(const PixelTiles& tiles, std::size_t tile, const QueriedMap& queried, float scale,
              std::uint32_t* sums) {
    for (int i = 0; i < pixels; i += lanes) {
        const auto cosine = hn::Abs(dot(load(tiles.normal, tile * pixels + static_cast<std::size_t>(i)),
                                        queried.map.frame.direction));
        auto* to = reinterpret_cast<std::int32_t*>(sums) + i;
        hn::StoreU(hn::Add(hn::LoadU(n, to), part_of_sum(hn::Set(f, 1), cosine, scale)), n, to);
    }
}

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
