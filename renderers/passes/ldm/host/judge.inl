// Tells of whole tiles of pixels what outermost depths say of them, where one answer holds for all pixels.
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include "renderers/passes/ldm/host/question.inl"
#include "renderers/passes/ldm/host/windows.inl"

#if defined(IR_LDM_HOST_JUDGE) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_JUDGE
#undef IR_LDM_HOST_JUDGE
#else
#define IR_LDM_HOST_JUDGE
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

/// What is known of tiles of pixels without a look at any of them, as bits.
struct Verdict {
    std::uint32_t nothing = 0;                ///< no pixel gets light from this band
    std::uint32_t open = 0;                   ///< all pixels are open
    std::uint32_t inside = 0;                 ///< all pixels query texels of this band
    std::uint32_t forward = 0, backward = 0;  ///< and all along v, or along -v, above their surfaces
};

/// Judges tiles first … first + lanes - 1, for which one map is queried. Margins cover rounding.
class Judge {
  public:
    Judge(const PixelTiles& tiles, std::size_t first, const QueriedMap& queried, const SelfHitRule& rule)
        : tiles_(tiles), first_(first), queried_(queried), rule_(rule) {}

    Verdict verdict() const {
        const auto zero = hn::Zero(f), one = hn::Set(f, 1);
        const auto& frame = queried_.map.frame;
        const auto cosine = range_of(tiles_.normal_boxes, frame.direction, 0),
                   facing = range_of(tiles_.geometric_normal_boxes, frame.direction, 0);
        const auto forward = hn::And(hn::Gt(cosine.least, zero), hn::Gt(facing.least, zero)),
                   backward = hn::And(hn::Lt(cosine.most, zero), hn::Lt(facing.most, zero)),
                   below = hn::Or(hn::And(hn::Gt(cosine.least, zero), hn::Le(facing.most, zero)),
                                  hn::And(hn::Lt(cosine.most, zero), hn::Ge(facing.least, zero)));
        // The largest gain and tolerance of query_tangent.
        const auto min_abs_facing =
            hn::Max(hn::Set(f, min_facing), hn::IfThenElse(forward, facing.least, hn::Neg(facing.most)));
        const auto slope =
            hn::Div(hn::Add(largest(range_of(tiles_.geometric_normal_boxes, queried_.slope_u, 0)),
                            largest(range_of(tiles_.geometric_normal_boxes, queried_.slope_v, 0))),
                    min_abs_facing);
        const auto dip = hn::Set(f, rule_.max_dip * queried_.texel_quanta),
                   half_slope = hn::Mul(slope, hn::Set(f, 0.505f));
        const auto gain = hn::Add(hn::Min(half_slope, dip), tolerance_of(slope));
        const auto window = texels_queried(hn::Gt(half_slope, dip));
        const auto inside = is_inside(window);

        const auto plane = plane_of(forward, window);
        auto least = hn::Set(n, -1);
        auto above_plane = hn::Neg(hn::Set(f, last_depth));
        constexpr int max_cells = 5;  // a side
        const auto known = visit_window<max_cells>(
            queried_.map, in_band(window), inside, 0,
            [&](Ints cell, hn::Mask<IntTag> which, int column, int row) {
                least = min_of_halves(least, hn::IfThenElse(which, cell, least));
                const auto outermost = hn::ConvertTo(
                    f, hn::IfThenElse(hn::RebindMask(n, forward), upper_half(cell), lower_half(cell)));
                const auto above = hn::Sub(outermost, plane.at(column, row));
                above_plane =
                    hn::Max(above_plane, hn::IfThenElse(hn::RebindMask(f, which), above, above_plane));
            });
        const auto depth = range_of(tiles_.position_boxes, frame.depth, frame.depth.w);
        const auto margin = hn::Add(hn::Max(gain, zero), one);
        const auto closed_ahead = hn::Gt(hn::ConvertTo(f, upper_half(least)), hn::Add(depth.most, margin));
        const auto closed_behind = hn::Gt(hn::ConvertTo(f, lower_half(least)),
                                          hn::Add(hn::Sub(hn::Set(f, last_depth), depth.least), margin));
        const auto closed =
            hn::Or(hn::And(closed_ahead, hn::Or(closed_behind, forward)), hn::And(closed_behind, backward));
        const auto are_texels = hn::Lt(size_of(window), hn::Set(f, max_cells));
        const auto open = hn::And(hn::And(known, are_texels),
                                  hn::And(hn::Or(forward, backward), hn::Lt(above_plane, plane.room)));
        Verdict verdict;
        verdict.nothing = bits_of(hn::Or(hn::Or(below, is_elsewhere(window)), hn::And(known, closed)));
        verdict.open = bits_of(open);
        verdict.inside = bits_of(inside);
        verdict.forward = bits_of(hn::And(inside, forward));
        verdict.backward = bits_of(hn::And(inside, backward));
        return verdict;
    }

  private:
    static constexpr float last_depth = 65535;

    /// Least and largest dot product with the vectors in the boxes of tiles.
    struct Range {
        Floats least, most;
    };
    Range range_of(const PixelTiles::Boxes& boxes, const glm::vec4& row, float added) const {
        auto middle = hn::Set(f, added), reach = hn::Zero(f);
        for (int axis = 0; axis < 3; ++axis) {
            middle =
                hn::MulAdd(hn::LoadU(f, boxes.centre[axis].data() + first_), hn::Set(f, row[axis]), middle);
            reach = hn::MulAdd(hn::LoadU(f, boxes.half[axis].data() + first_),
                               hn::Set(f, std::abs(row[axis])), reach);
        }
        return {hn::Sub(middle, reach), hn::Add(middle, reach)};
    }
    static Floats largest(const Range& range) { return hn::Max(hn::Abs(range.least), hn::Abs(range.most)); }
    Floats tolerance_of(Floats slope) const {
        return hn::Add(hn::Set(f, rule_.quanta), hn::Min(hn::Mul(hn::Set(f, rule_.slope), slope),
                                                         hn::Set(f, max_tolerance * queried_.texel_quanta)));
    }

    /// The texels of the map that may be queried: where rays may dip, neighbours too.
    Window texels_queried(Mask may_dip) const {
        constexpr float texel_margin = 0.01f;
        const auto& frame = queried_.map.frame;
        const auto u = range_of(tiles_.position_boxes, frame.u, frame.u.w),
                   v = range_of(tiles_.position_boxes, frame.v, frame.v.w);
        const auto margin = hn::Add(hn::Set(f, texel_margin), hn::IfThenElseZero(may_dip, hn::Set(f, 1)));
        return {hn::Floor(hn::Sub(u.least, margin)), hn::Floor(hn::Add(u.most, margin)),
                hn::Floor(hn::Sub(v.least, margin)), hn::Floor(hn::Add(v.most, margin))};
    }
    static Floats size_of(const Window& window) {
        return hn::Max(hn::Sub(window.right, window.left), hn::Sub(window.bottom, window.top));
    }
    Floats first_row() const { return hn::Set(f, static_cast<float>(queried_.map.first_row)); }
    Floats end_row() const {
        return hn::Set(f, static_cast<float>(queried_.map.first_row + queried_.map.rows));
    }
    Window in_band(const Window& window) const {
        return {window.left, window.right, hn::Sub(window.top, first_row()),
                hn::Sub(window.bottom, first_row())};
    }
    Mask is_inside(const Window& window) const {
        const auto end = hn::Set(f, static_cast<float>(queried_.map.resolution));
        return hn::And(hn::And(hn::Ge(window.left, hn::Zero(f)), hn::Lt(window.right, end)),
                       hn::And(hn::Ge(window.top, first_row()), hn::Lt(window.bottom, end_row())));
    }
    /// All texels are of other bands. (Pixels outside of the map count with its first band.)
    Mask is_elsewhere(const Window& window) const {
        const auto zero = hn::Zero(f);
        if (queried_.map.rows == queried_.map.resolution) return hn::Lt(zero, zero);
        const auto one = hn::Set(f, 1), end = hn::Set(f, static_cast<float>(queried_.map.resolution - 1));
        const auto within = hn::And(hn::And(hn::Ge(window.left, one), hn::Lt(window.right, end)),
                                    hn::And(hn::Ge(window.top, one), hn::Lt(window.bottom, end)));
        return hn::And(within, hn::Or(hn::Lt(hn::Add(window.bottom, one), first_row()),
                                      hn::Gt(hn::Sub(window.top, one), end_row())));
    }

    /// The tangent plane that all pixels of a tile share, along ω: its depth at the centres of a window's
    /// texels, counted from the first one, and what entries beyond it are still the pixels' own. Without such
    /// a plane there is no room.
    struct Plane {
        Floats depth, per_column, per_row, room;
        Floats at(int column, int row) const {
            return hn::MulAdd(hn::Set(f, static_cast<float>(row)), per_row,
                              hn::MulAdd(hn::Set(f, static_cast<float>(column)), per_column, depth));
        }
    };
    Plane plane_of(Mask forward, const Window& window) const {
        const auto& frame = queried_.map.frame;
        const auto normal = centre_of(tiles_.geometric_normal_boxes);
        auto point = centre_of(tiles_.position_boxes);
        const auto offset =
            hn::Sub(hn::LoadU(f, tiles_.plane_offset.data() + first_),
                    hn::MulAdd(normal.x, point.x, hn::MulAdd(normal.y, point.y, hn::Mul(normal.z, point.z))));
        point = {hn::MulAdd(normal.x, offset, point.x), hn::MulAdd(normal.y, offset, point.y),
                 hn::MulAdd(normal.z, offset, point.z)};
        const auto facing = hn::Abs(dot(normal, frame.direction));
        const auto slant = slant_of(queried_, rule_, normal, facing);
        const auto half = hn::Set(f, 0.5f);
        const auto to_u = hn::Sub(hn::Add(window.left, half), project(point, frame.u)),
                   to_v = hn::Sub(hn::Add(window.top, half), project(point, frame.v));
        const auto uneven =
            hn::Div(hn::LoadU(f, tiles_.off_plane.data() + first_),
                    hn::Mul(hn::Max(facing, hn::Set(f, min_facing)), hn::Set(f, frame.direction.w)));
        return {hn::MulAdd(slant.per_column, to_u,
                           hn::MulAdd(slant.per_row, to_v, along(forward, project(point, frame.depth)))),
                slant.per_column, slant.per_row, hn::Sub(hn::Sub(slant.tolerance, uneven), hn::Set(f, 1))};
    }
    Vector3 centre_of(const PixelTiles::Boxes& boxes) const { return load(boxes.centre, first_); }

    const PixelTiles& tiles_;
    const std::size_t first_;
    const QueriedMap& queried_;
    const SelfHitRule& rule_;
};

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
