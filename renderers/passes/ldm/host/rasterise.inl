// Rasterises triangles, many or many texels at a time. A triangle covers the texels whose centres lie inside
// of it, or on its top or left edges; as in shaders/passes/ldm/rasterise.comp corners are snapped to
// subtexels and what follows is exact, so that neighbours neither overlap nor gape. Read once for each
// instruction set, within a source that includes <hwy/foreach_target.h>.
#include "renderers/passes/ldm/host/culling.inl"
#include "renderers/passes/ldm/host/spans.h"
#include "renderers/passes/raytracing/alpha_masks.h"

#if defined(IR_LDM_HOST_RASTERISE) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_RASTERISE
#undef IR_LDM_HOST_RASTERISE
#else
#define IR_LDM_HOST_RASTERISE
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

/// Depths are kept within the range that `quantised` of fragments.glsl gives.
constexpr int least_depth = 1, most_depth = 65534;
/// Boxes of so many texels a side have edge functions below 2^30, and below 2^24, which float holds exactly.
constexpr int medium_side = 64, float_side = 8;
/// The maps of outermost depths take fragments while these are still in the first-level cache.
constexpr std::size_t flushed_at = 4096;

/// A triangle whose box is not large: edge functions, with what they gain a row and lose a column, and depth.
struct MediumTriangle {
    std::int32_t inside[3], per_row[3], per_column[3], texel;
    float depth, depth_per_row, depth_per_column;
    int width, height;
};

/// First texel, along an axis, whose centre is not below a subtexel coordinate.
Floats first_centre(Floats subtexel) {
    return hn::Ceil(hn::MulSub(subtexel, hn::Set(f, 1.0f / subtexels), hn::Set(f, 0.5f)));
}
Floats min3(const Floats (&a)[3]) {
    return hn::Min(a[0], hn::Min(a[1], a[2]));
}
Floats max3(const Floats (&a)[3]) {
    return hn::Max(a[0], hn::Max(a[1], a[2]));
}

/// Takes triangles out of the queue and puts their fragments into the map.
class Rasteriser {
  public:
    Rasteriser(const Meshlets& meshlets, const AlphaMasks& masks, StreamedMap& map, BuildScratch& scratch)
        : masks_(masks),
          map_(map),
          scratch_(scratch),
          queue_(scratch.queue),
          keeps_outermost_(map.holds == Holds::outermost),
          culling_(meshlets, map, scratch) {}

    void begin() {
        scratch_.fragment_count = 0;
        scratch_.fragments.resize(std::max<std::size_t>(scratch_.fragments.size(), 4 * flushed_at));
        queue_.size = 0;
        if (keeps_outermost_) map_.outermost.assign(texels() + lanes, 0);
    }
    /// Finds meshlets first … end - 1 that need not be rasterised, from what the map holds already.
    void find_hidden(std::size_t first, std::size_t end) { culling_.find_hidden(first, end); }

    void rasterise_queue() {
        for (int at = 0; at < queue_.size; at += lanes)
            rasterise_group(at, std::min(lanes, queue_.size - at));
        queue_.size = 0;
    }

    /// With alpha masks, texel by texel.
    void rasterise_masked_queue() {
        for (int place = 0; place < queue_.size; ++place) {
            const auto c = corners_at(place);
            const Plane plane(c.x, c.y, c.z);
            const double bx = c.x[1] - c.x[0], by = c.y[1] - c.y[0], cx = c.x[2] - c.x[0],
                         cy = c.y[2] - c.y[0];
            const double area = bx * cy - by * cx;
            if (area == 0) continue;
            const auto [least, most] = std::minmax({c.z[0], c.z[1], c.z[2]});
            Spans spans(c.x, c.y, map_.first_row, map_.first_row + map_.rows, map_.resolution);
            while (spans.next()) {
                reserve(static_cast<std::size_t>(spans.end() - spans.first()));
                const double y = subtexels * (spans.row() + 0.5), py = y - c.y[0];
                const int row = (spans.row() - map_.first_row) * map_.resolution;
                for (int column = spans.first(); column < spans.end(); ++column) {
                    const double x = subtexels * (column + 0.5), px = x - c.x[0];
                    const double second = (px * cy - py * cx) / area, third = (bx * py - by * px) / area;
                    if (!masks_.is_covered(queue_.number[place], static_cast<float>(second),
                                           static_cast<float>(third)))
                        continue;
                    const double depth = std::clamp(plane.at(x, y), least, most);
                    const auto quanta = std::clamp(static_cast<int>(depth + 0.5), least_depth, most_depth);
                    scratch_.fragments[scratch_.fragment_count++] =
                        static_cast<std::uint32_t>((row + column) << 16 | quanta);
                }
            }
        }
        queue_.size = 0;
    }

    /// Into the map of outermost depths.
    void flush() {
        auto* const map = map_.outermost.data();
        for (std::size_t i = 0; i < scratch_.fragment_count; ++i) {
            const auto fragment = scratch_.fragments[i], depth = fragment & 0xffffu;
            auto& texel = map[fragment >> 16];
            texel = std::max(texel >> 16, depth) << 16 | std::max(texel & 0xffffu, 0xffffu - depth);
        }
        scratch_.fragments_made += scratch_.fragment_count;
        scratch_.fragment_count = 0;
    }

    void sort_into_lists() {
        const auto count = scratch_.fragment_count;
        const auto* const fragments = scratch_.fragments.data();
        map_.begins.assign(texels() + 1, 0);
        if (map_.depths.size() < count) map_.depths.resize(count + count / 4);
        auto* const begins = map_.begins.data();
        for (std::size_t i = 0; i < count; ++i) ++begins[fragments[i] >> 16];
        std::uint32_t sum = 0;
        for (std::size_t texel = 0; texel <= texels(); ++texel) begins[texel] = sum += begins[texel];
        for (std::size_t i = 0; i < count; ++i)
            map_.depths[--begins[fragments[i] >> 16]] = static_cast<std::uint16_t>(fragments[i]);
        scratch_.fragments_made += count;
    }

  private:
    std::size_t texels() const { return static_cast<std::size_t>(map_.rows) * map_.resolution; }

    void reserve(std::size_t more) {
        if (keeps_outermost_ && scratch_.fragment_count >= flushed_at) flush();
        const auto needed = scratch_.fragment_count + more + lanes;
        if (needed > scratch_.fragments.size()) scratch_.fragments.resize(2 * needed);
    }

    /// Depths inside of a triangle: they lie within the margins of the map's range.
    void put(Ints texel, Floats depth, Mask which) {
        const auto packed = hn::Or(hn::ShiftLeft<16>(texel), hn::NearestInt(depth));
        const Packing packing(which);
        packing.store(packed, scratch_.fragments.data() + scratch_.fragment_count);
        scratch_.fragment_count += static_cast<std::size_t>(packing.count());
    }

    /// Triangles with small boxes at once, the others one by one.
    void rasterise_group(int at, int count) {
        Floats x[3], y[3], z[3], dx[3], dy[3], edge[3];
        Ints inside[3], per_row_int[3],
            per_column_int[3];  // edges, 0 or more inside; gained a row, lost a column
        for (int k = 0; k < 3; ++k) {
            x[k] = hn::Load(f, queue_.x[k] + at);
            y[k] = hn::Load(f, queue_.y[k] + at);
            z[k] = hn::Load(f, queue_.z[k] + at);
        }
        const auto column = first_centre(min3(x)), row = first_centre(min3(y));
        const auto width = hn::Sub(first_centre(max3(x)), column),
                   height = hn::Sub(first_centre(max3(y)), row);
        const auto zero = hn::Zero(f), side = hn::Set(f, subtexels);
        const auto top = hn::Set(f, static_cast<float>(map_.first_row)),
                   bottom = hn::Set(f, static_cast<float>(map_.first_row + map_.rows));
        const auto fits =
            hn::And(hn::And(hn::Ge(column, zero),
                            hn::Le(hn::Add(column, width), hn::Set(f, static_cast<float>(map_.resolution)))),
                    hn::And(hn::Ge(row, top), hn::Le(hn::Add(row, height), bottom)));
        const auto is_there = hn::FirstN(f, static_cast<std::size_t>(count));
        const auto most = hn::Max(width, height);
        auto is_medium = hn::And(hn::And(is_there, fits), hn::Le(most, hn::Set(f, medium_side)));
        rasterise_large(at, hn::AndNot(is_medium, is_there));
        if (culling_.knows_blocks()) {
            const auto first = hn::Sub(row, top), one = hn::Set(f, 1);
            is_medium = hn::AndNot(
                culling_.hidden(column, hn::Sub(hn::Add(column, width), one), first,
                                hn::Sub(hn::Add(first, height), one), min3(z), max3(z), is_medium, 2),
                is_medium);
        }
        if (hn::AllFalse(f, is_medium)) return;

        // cross(b - a, p - a) at the box's first centre, for the edges from corner k to the next.
        const auto centre_x = hn::MulAdd(column, side, hn::Set(f, 0.5f * subtexels)),
                   centre_y = hn::MulAdd(row, side, hn::Set(f, 0.5f * subtexels));
        Ints edge_int[3];
        for (int k = 0; k < 3; ++k) {
            x[k] = hn::Sub(x[k], centre_x);
            y[k] = hn::Sub(y[k], centre_y);
        }
        const bool float_holds =
            hn::AllTrue(f, hn::Or(hn::Le(most, hn::Set(f, float_side)), hn::Not(is_medium)));
        for (int k = 0; k < 3; ++k) {
            const int next = k == 2 ? 0 : k + 1;
            dx[k] = hn::Sub(x[next], x[k]);
            dy[k] = hn::Sub(y[next], y[k]);
            if (float_holds)
                edge_int[k] = hn::ConvertTo(n, hn::Sub(hn::Mul(dy[k], x[k]), hn::Mul(dx[k], y[k])));
            else
                edge_int[k] = hn::Sub(hn::Mul(hn::ConvertTo(n, dy[k]), hn::ConvertTo(n, x[k])),
                                      hn::Mul(hn::ConvertTo(n, dx[k]), hn::ConvertTo(n, y[k])));
            edge[k] = hn::ConvertTo(f, edge_int[k]);
        }
        auto area = hn::ConvertTo(f, hn::Add(edge_int[0], hn::Add(edge_int[1], edge_int[2])));
        const auto has_area = hn::And(is_medium, hn::Ne(area, zero));
        if (hn::AllFalse(f, has_area)) return;
        const auto sign = hn::And(area, hn::Set(f, -0.0f));
        const auto is_negative = hn::Lt(area, zero);
        for (int k = 0; k < 3; ++k) {
            edge[k] = hn::Xor(edge[k], sign);
            dx[k] = hn::Xor(dx[k], sign);
            dy[k] = hn::Xor(dy[k], sign);
            const auto owns_ties =
                hn::Or(hn::Lt(dy[k], zero), hn::And(hn::Eq(dy[k], zero), hn::Gt(dx[k], zero)));
            edge_int[k] = hn::IfThenElse(hn::RebindMask(n, is_negative), hn::Neg(edge_int[k]), edge_int[k]);
            inside[k] = hn::Sub(edge_int[k], hn::IfThenZeroElse(hn::RebindMask(n, owns_ties), hn::Set(n, 1)));
            dx[k] = hn::Mul(dx[k], side);
            dy[k] = hn::Mul(dy[k], side);
            per_row_int[k] = hn::ConvertTo(n, dx[k]);
            per_column_int[k] = hn::ConvertTo(n, dy[k]);
        }
        area = hn::Xor(area, sign);
        // Weights of corners are the edges opposite: 1 (b to c), 2 (c to a) and 0 (a to b).
        const auto per_area = hn::Div(hn::Set(f, 1), area);
        const auto b = hn::Mul(hn::Sub(z[1], z[0]), per_area), c = hn::Mul(hn::Sub(z[2], z[0]), per_area);
        const auto depth = hn::MulAdd(edge[2], b, hn::MulAdd(edge[0], c, z[0]));
        const auto per_column = hn::Neg(hn::MulAdd(dy[2], b, hn::Mul(dy[0], c))),
                   per_row = hn::MulAdd(dx[2], b, hn::Mul(dx[0], c));
        const auto texel = hn::ConvertTo(
            n, hn::MulAdd(hn::Sub(row, top), hn::Set(f, static_cast<float>(map_.resolution)), column));
        const auto is_small = hn::And(has_area, hn::Le(most, hn::Set(f, 2)));
        if (!hn::AllFalse(f, is_small)) {
            reserve(4 * lanes);
            for (int j = 0; j < 2; ++j) {
                for (int i = 0; i < 2; ++i) {
                    auto any = hn::Zero(n);
                    for (int k = 0; k < 3; ++k)
                        any = hn::Or(any, at_offset(inside[k], per_row_int[k], per_column_int[k], i, j));
                    const auto hit = hn::And(is_small, hn::RebindMask(f, hn::Gt(any, hn::Set(n, -1))));
                    if (hn::AllFalse(f, hit)) continue;
                    auto z_here = depth;
                    if (i > 0) z_here = hn::Add(z_here, per_column);
                    if (j > 0) z_here = hn::Add(z_here, per_row);
                    put(hn::Add(texel, hn::Set(n, i + j * map_.resolution)), z_here, hit);
                }
            }
        }
        const auto others = hn::AndNot(is_small, has_area);
        if (hn::AllFalse(f, others)) return;
        alignas(64) std::int32_t ints[10][lanes];
        alignas(64) float floats[5][lanes];
        for (int k = 0; k < 3; ++k) {
            hn::Store(inside[k], n, ints[k]);
            hn::Store(per_row_int[k], n, ints[3 + k]);
            hn::Store(per_column_int[k], n, ints[6 + k]);
        }
        hn::Store(texel, n, ints[9]);
        const Floats others_floats[5] = {depth, per_row, per_column, width, height};
        for (int k = 0; k < 5; ++k) hn::Store(others_floats[k], f, floats[k]);
        for (auto bits = bits_of(others); bits != 0; bits &= bits - 1) {
            const auto lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
            MediumTriangle triangle;
            for (int k = 0; k < 3; ++k) {
                triangle.inside[k] = ints[k][lane];
                triangle.per_row[k] = ints[3 + k][lane];
                triangle.per_column[k] = ints[6 + k][lane];
            }
            triangle.texel = ints[9][lane];
            triangle.depth = floats[0][lane], triangle.depth_per_row = floats[1][lane];
            triangle.depth_per_column = floats[2][lane];
            triangle.width = static_cast<int>(floats[3][lane]),
            triangle.height = static_cast<int>(floats[4][lane]);
            rasterise_medium(triangle);
        }
    }

    static Ints at_offset(Ints edge, Ints gained_per_row, Ints lost_per_column, int columns, int rows) {
        if (rows > 0) edge = hn::Add(edge, gained_per_row);
        if (columns > 0) edge = hn::Sub(edge, lost_per_column);
        return edge;
    }

    /// One triangle, row by row of its box, many texels at a time; values at the box's first centre.
    void rasterise_medium(const MediumTriangle& t) {
        const auto column = hn::Iota(n, 0);
        Ints line[3], right[3];
        for (int k = 0; k < 3; ++k) {
            line[k] = hn::Sub(hn::Set(n, t.inside[k]), hn::Mul(column, hn::Set(n, t.per_column[k])));
            right[k] = hn::Set(n, lanes * t.per_column[k]);
        }
        auto line_depth =
            hn::MulAdd(hn::ConvertTo(f, column), hn::Set(f, t.depth_per_column), hn::Set(f, t.depth));
        const auto depth_right = hn::Set(f, lanes * t.depth_per_column),
                   depth_down = hn::Set(f, t.depth_per_row);
        int texel = t.texel;
        if (keeps_outermost_ && t.width <= lanes) {
            for (int y = 0; y < t.height; ++y, texel += map_.resolution) {
                raise(texel, hn::NearestInt(line_depth),
                      hn::Gt(hn::Or(line[0], hn::Or(line[1], line[2])), hn::Set(n, -1)));
                for (int k = 0; k < 3; ++k) line[k] = hn::Add(line[k], hn::Set(n, t.per_row[k]));
                line_depth = hn::Add(line_depth, depth_down);
            }
            return;
        }
        for (int y = 0; y < t.height; ++y, texel += map_.resolution) {
            if (!keeps_outermost_) reserve(medium_side);
            auto a = line[0], b = line[1], c = line[2];
            auto depth = line_depth;
            for (int x = 0; x < t.width; x += lanes) {
                const auto hit = hn::Gt(hn::Or(a, hn::Or(b, c)), hn::Set(n, -1));
                if (!hn::AllFalse(n, hit)) {
                    if (keeps_outermost_)
                        raise(texel + x, hn::NearestInt(depth), hit);
                    else
                        put(hn::Iota(n, texel + x), depth, hn::RebindMask(f, hit));
                }
                a = hn::Sub(a, right[0]);
                b = hn::Sub(b, right[1]);
                c = hn::Sub(c, right[2]);
                depth = hn::Add(depth, depth_right);
            }
            for (int k = 0; k < 3; ++k) line[k] = hn::Add(line[k], hn::Set(n, t.per_row[k]));
            line_depth = hn::Add(line_depth, depth_down);
        }
    }

    struct Corners {
        double x[3], y[3], z[3];
    };
    Corners corners_at(int place) const {
        Corners result;
        for (int k = 0; k < 3; ++k) {
            result.x[k] = double{queue_.x[k][place]};
            result.y[k] = double{queue_.y[k][place]};
            result.z[k] = double{queue_.z[k][place]};
        }
        return result;
    }

    /// Triangles of any size, row by row.
    void rasterise_large(int at, Mask which) {
        for (auto bits = bits_of(which); bits != 0; bits &= bits - 1) {
            const auto c = corners_at(at + static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)));
            const Plane plane(c.x, c.y, c.z);
            const auto [least, most] = std::minmax({c.z[0], c.z[1], c.z[2]});
            Spans spans(c.x, c.y, map_.first_row, map_.first_row + map_.rows, map_.resolution);
            while (spans.next()) {
                const double depth =
                    plane.at(subtexels * (spans.first() + 0.5), subtexels * (spans.row() + 0.5));
                const int texel = (spans.row() - map_.first_row) * map_.resolution + spans.first();
                put_span(texel, spans.end() - spans.first(), static_cast<float>(depth),
                         static_cast<float>(plane.per_x * subtexels), static_cast<float>(least),
                         static_cast<float>(most));
            }
        }
    }

    void put_span(int texel, int count, float depth, float per_column, float least, float most) {
        if (!keeps_outermost_) reserve(static_cast<std::size_t>(count));
        const auto low = hn::Set(f, std::max(least, float{least_depth})),
                   high = hn::Set(f, std::min(most, float{most_depth}));
        const auto iota = hn::Iota(f, 0);
        for (int x = 0; x < count; x += lanes) {
            const auto z = hn::MulAdd(hn::Add(iota, hn::Set(f, static_cast<float>(x))),
                                      hn::Set(f, per_column), hn::Set(f, depth));
            const auto quanta = hn::NearestInt(hn::Min(hn::Max(z, low), high));
            const int left = std::min(lanes, count - x);
            if (keeps_outermost_)
                raise(texel + x, quanta, hn::FirstN(n, static_cast<std::size_t>(left)));
            else
                append(texel + x, quanta, left);
        }
    }

    void append(int texel, Ints quanta, int count) {
        const auto packed = hn::Or(hn::ShiftLeft<16>(hn::Iota(n, texel)), quanta);
        hn::StoreU(packed, n,
                   reinterpret_cast<std::int32_t*>(scratch_.fragments.data()) + scratch_.fragment_count);
        scratch_.fragment_count += static_cast<std::size_t>(count);
    }

    /// Consecutive texels at once, from `texel` on.
    void raise(int texel, Ints quanta, hn::Mask<IntTag> which) {
        auto* to = reinterpret_cast<std::int32_t*>(map_.outermost.data()) + texel;
        const auto both = hn::Or(hn::ShiftLeft<16>(quanta), hn::Sub(hn::Set(n, 0xffff), quanta));
        hn::StoreU(max_of_halves(hn::LoadU(n, to), hn::IfThenElseZero(which, both)), n, to);
        scratch_.fragments_made += hn::CountTrue(n, which);
    }

    const AlphaMasks& masks_;
    StreamedMap& map_;
    BuildScratch& scratch_;
    BuildScratch::Queue& queue_;
    const bool keeps_outermost_;
    Culling culling_;
};

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
