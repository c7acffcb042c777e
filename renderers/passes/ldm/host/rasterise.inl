// Rasterises triangles, many or many texels at a time. A triangle covers the texels whose centres lie inside
// of it, or on its top or left edges; as in shaders/passes/ldm/rasterise.comp corners are snapped to
// subtexels and what follows is exact, so that neighbours neither overlap nor gape. Read once for each
// instruction set, within a source that includes <hwy/foreach_target.h>.
#include "renderers/passes/ldm/host/culling.inl"
#include "renderers/passes/ldm/host/spans.inl"
#include "renderers/passes/raytracing/alpha_masks.h"
#include "shaders/passes/ldm/fragments.glsl.h"

#if defined(IR_LDM_HOST_RASTERISE) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_RASTERISE
#undef IR_LDM_HOST_RASTERISE
#else
#define IR_LDM_HOST_RASTERISE
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

constexpr int first_depth = static_cast<int>(ldm_first_depth), last_depth = static_cast<int>(ldm_last_depth);
/// Boxes of so many texels a side have edge functions below 2^30, and below 2^24, which float holds exactly.
constexpr int medium_side = 64, float_side = 8;
/// Boxes of so many are tested at each of their texels for many triangles at once.
constexpr int small_side = 2;
/// The maps of outermost depths take fragments while these are still in the first-level cache.
constexpr std::size_t flushed_at = 4096;

/// A triangle whose box is not large: edge functions, with what they gain a row and lose a column, and depth.
struct MediumTriangle {
    std::int32_t inside[3], per_row[3], per_column[3], texel;
    float depth, depth_per_row, depth_per_column;
    int width, height;
    std::int32_t slopes;  ///< codes
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
          others_(scratch.others),
          top_(hn::Set(f, static_cast<float>(map.first_row))),
          bottom_(hn::Set(f, static_cast<float>(map.first_row + map.rows))),
          resolution_(hn::Set(f, static_cast<float>(map.resolution))),
          keeps_outermost_(map.holds == Holds::outermost),
          keeps_slopes_(map.holds == Holds::sloped_lists),
          texel_quanta_(StreamedMap::texel_quanta(map.frame)),
          culling_(meshlets, map, scratch) {}

    void begin() {
        scratch_.fragment_count = 0;
        scratch_.fragments.resize(std::max<std::size_t>(scratch_.fragments.size(), 4 * flushed_at));
        if (keeps_slopes_) scratch_.slopes.resize(scratch_.fragments.size());
        queue_.size = 0;
        if (!keeps_outermost_) return;
        map_.levels = StreamedMap::levels_of(map_.resolution, map_.rows);
        map_.outermost.assign(map_.levels.back().end(), 0);
    }
    /// Once all is rasterised.
    void finish() {
        if (!keeps_outermost_) return sort_into_lists();
        flush();
        find_blocks(map_, scratch_.line);
    }
    /// Finds meshlets first … end - 1 that need not be rasterised, from what the map holds already.
    void find_hidden(std::size_t first, std::size_t end) {
        flush();
        culling_.find_hidden(first, end);
    }

    void rasterise_queue() {
        const int small = take_queue_apart();
        for (int at = 0; at < small; at += lanes) rasterise_small(at, std::min(lanes, small - at));
        for (int at = 0; at < others_.size; at += lanes)
            rasterise_others(at, std::min(lanes, others_.size - at));
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
            const auto slopes = keeps_slopes_ ? codes_of(plane) : 0;
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
                    const auto quanta = std::clamp(static_cast<int>(depth + 0.5), first_depth, last_depth);
                    if (keeps_slopes_) scratch_.slopes[scratch_.fragment_count] = slopes;
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
        if (keeps_slopes_) map_.slopes.resize(map_.depths.size());
        auto* const begins = map_.begins.data();
        for (std::size_t i = 0; i < count; ++i) ++begins[fragments[i] >> 16];
        std::uint32_t sum = 0;
        for (std::size_t texel = 0; texel <= texels(); ++texel) begins[texel] = sum += begins[texel];
        for (std::size_t i = 0; i < count; ++i) {
            const auto place = --begins[fragments[i] >> 16];
            map_.depths[place] = static_cast<std::uint16_t>(fragments[i]);
            if (keeps_slopes_) map_.slopes[place] = static_cast<std::uint16_t>(scratch_.slopes[i]);
        }
        scratch_.fragments_made += count;
    }

  private:
    std::size_t texels() const { return static_cast<std::size_t>(map_.rows) * map_.resolution; }

    void reserve(std::size_t more) {
        if (keeps_outermost_ && scratch_.fragment_count >= flushed_at) flush();
        const auto needed = scratch_.fragment_count + more + lanes;
        if (needed <= scratch_.fragments.size()) return;
        scratch_.fragments.resize(2 * needed);
        if (keeps_slopes_) scratch_.slopes.resize(2 * needed);
    }

    /// Of slopes in quanta per texel: slope_codes() of many.
    Ints codes_of(Floats per_column, Floats per_row) const {
        const auto code = [&](Floats slope) {
            const auto most = hn::Set(f, ldm_max_kept_slope), last = hn::Set(f, ldm_max_slope_code);
            const auto s =
                hn::Min(hn::Max(hn::Mul(slope, hn::Set(f, 1 / texel_quanta_)), hn::Neg(most)), most);
            const auto steps =
                hn::Div(hn::Mul(s, hn::Set(f, ldm_slope_steps)), hn::Add(hn::Set(f, 1), hn::Abs(s)));
            return hn::And(hn::NearestInt(hn::Min(hn::Max(steps, hn::Neg(last)), last)), hn::Set(n, 0xff));
        };
        return hn::Or(code(per_column), hn::ShiftLeft<8>(code(per_row)));
    }
    std::uint32_t codes_of(const Plane& plane) const {
        return slope_codes(double{subtexels} * glm::dvec2(plane.per_x, plane.per_y), double{texel_quanta_});
    }

    /// Depths inside of a triangle: they lie within the margins of the map's range.
    void put(Ints texel, Floats depth, Mask which, Ints slopes) {
        const auto packed = hn::Or(hn::ShiftLeft<16>(texel), hn::NearestInt(depth));
        const Packing packing(which);
        if (keeps_slopes_) packing.store(slopes, scratch_.slopes.data() + scratch_.fragment_count);
        packing.store(packed, scratch_.fragments.data() + scratch_.fragment_count);
        scratch_.fragment_count += static_cast<std::size_t>(packing.count());
    }

    /// Rasterises large triangles and drops hidden ones. Of the others, those with small boxes come to the
    /// front of the queue, which number is returned, the rest into another queue.
    int take_queue_apart() {
        int small = 0;
        others_.size = 0;
        for (int at = 0; at < queue_.size; at += lanes) {
            const auto t = triangles_at(queue_, at);
            const auto box = box_of(t);
            auto left = hn::FirstN(f, static_cast<std::size_t>(queue_.size - at));
            if (culling_.knows_blocks())
                left = hn::AndNot(culling_.hidden<2>(in_band(box), min3(t.z), max3(t.z), left), left);
            const auto most = hn::Max(box.width, box.height);
            const auto is_medium = hn::And(fits(box), hn::Le(most, hn::Set(f, medium_side)));
            rasterise_large(at, hn::AndNot(is_medium, left));
            left = hn::And(left, is_medium);
            const auto is_small = hn::Le(most, hn::Set(f, small_side));
            small += pack(t, hn::And(left, is_small), queue_, small);
            others_.size += pack(t, hn::AndNot(is_small, left), others_, others_.size);
        }
        return small;
    }

    struct Triangles {
        Floats x[3], y[3], z[3];
    };
    static Triangles triangles_at(const BuildScratch::Queue& queue, int at) {
        Triangles t;
        for (int k = 0; k < 3; ++k) {
            t.x[k] = hn::LoadU(f, queue.x[k] + at);
            t.y[k] = hn::LoadU(f, queue.y[k] + at);
            t.z[k] = hn::LoadU(f, queue.z[k] + at);
        }
        return t;
    }
    /// Returns how many.
    static int pack(const Triangles& t, Mask which, BuildScratch::Queue& queue, int to) {
        const Packing packing(which);
        for (int k = 0; k < 3; ++k) {
            packing.store(t.x[k], queue.x[k] + to);
            packing.store(t.y[k], queue.y[k] + to);
            packing.store(t.z[k], queue.z[k] + to);
        }
        return packing.count();
    }

    /// Texels whose centres lie in a triangle's box.
    struct Box {
        Floats column, row, width, height;
    };
    static Box box_of(const Triangles& t) {
        const auto column = first_centre(min3(t.x)), row = first_centre(min3(t.y));
        return {column, row, hn::Sub(first_centre(max3(t.x)), column), hn::Sub(first_centre(max3(t.y)), row)};
    }

    /// Whether all of a box is in the band.
    Mask fits(const Box& box) const {
        return hn::And(
            hn::And(hn::Ge(box.column, hn::Zero(f)), hn::Le(hn::Add(box.column, box.width), resolution_)),
            hn::And(hn::Ge(box.row, top_), hn::Le(hn::Add(box.row, box.height), bottom_)));
    }
    /// What of a box is.
    Window in_band(const Box& box) const {
        const auto zero = hn::Zero(f), one = hn::Set(f, 1);
        const auto row = hn::Sub(box.row, top_), last_column = hn::Sub(resolution_, one),
                   last_row = hn::Sub(hn::Sub(bottom_, top_), one);
        return {hn::Max(box.column, zero), hn::Min(hn::Sub(hn::Add(box.column, box.width), one), last_column),
                hn::Max(row, zero), hn::Min(hn::Sub(hn::Add(row, box.height), one), last_row)};
    }

    /// Of triangles, at the first centre of their boxes: edge functions, 0 or more inside, with what they
    /// gain a row and lose a column, and depth likewise. Edge functions are whole numbers, in Floats where
    /// these hold them.
    template <class Whole>
    struct Prepared {
        Mask live;
        Whole inside[3], per_row[3], per_column[3];
        Floats depth, depth_per_row, depth_per_column;
        Ints texel, slopes;
    };
    template <class Whole>
    Prepared<Whole> prepare(Triangles t, const Box& box, Mask live, bool floats_hold) const {
        constexpr bool in_floats = std::is_same_v<Whole, Floats>;
        const auto zero = hn::Zero(f), side = hn::Set(f, subtexels);
        const auto centre_x = hn::MulAdd(box.column, side, hn::Set(f, 0.5f * subtexels)),
                   centre_y = hn::MulAdd(box.row, side, hn::Set(f, 0.5f * subtexels));
        for (int k = 0; k < 3; ++k) {
            t.x[k] = hn::Sub(t.x[k], centre_x);
            t.y[k] = hn::Sub(t.y[k], centre_y);
        }
        // cross(b - a, p - a) for the edges from corner k to the next.
        Floats dx[3], dy[3], edge[3];
        Ints edge_int[3];
        for (int k = 0; k < 3; ++k) {
            const int next = k == 2 ? 0 : k + 1;
            dx[k] = hn::Sub(t.x[next], t.x[k]);
            dy[k] = hn::Sub(t.y[next], t.y[k]);
            if (in_floats || floats_hold)
                edge[k] = hn::Sub(hn::Mul(dy[k], t.x[k]), hn::Mul(dx[k], t.y[k]));
            else
                edge_int[k] = hn::Sub(hn::Mul(hn::ConvertTo(n, dy[k]), hn::ConvertTo(n, t.x[k])),
                                      hn::Mul(hn::ConvertTo(n, dx[k]), hn::ConvertTo(n, t.y[k])));
            if constexpr (in_floats) continue;
            if (floats_hold)
                edge_int[k] = hn::ConvertTo(n, edge[k]);
            else
                edge[k] = hn::ConvertTo(f, edge_int[k]);
        }
        Floats area;
        if constexpr (in_floats)
            area = hn::Add(edge[0], hn::Add(edge[1], edge[2]));
        else
            area = hn::ConvertTo(f, hn::Add(edge_int[0], hn::Add(edge_int[1], edge_int[2])));
        Prepared<Whole> result;
        result.live = hn::And(live, hn::Ne(area, zero));
        const auto sign = hn::And(area, hn::Set(f, -0.0f));
        const auto is_negative = hn::Lt(area, zero);
        for (int k = 0; k < 3; ++k) {
            edge[k] = hn::Xor(edge[k], sign);
            dx[k] = hn::Xor(dx[k], sign);
            dy[k] = hn::Xor(dy[k], sign);
            const auto owns_ties =
                hn::Or(hn::Lt(dy[k], zero), hn::And(hn::Eq(dy[k], zero), hn::Gt(dx[k], zero)));
            dx[k] = hn::Mul(dx[k], side);
            dy[k] = hn::Mul(dy[k], side);
            if constexpr (in_floats) {
                result.inside[k] = hn::Sub(edge[k], hn::IfThenZeroElse(owns_ties, hn::Set(f, 1)));
                result.per_row[k] = dx[k];
                result.per_column[k] = dy[k];
            } else {
                edge_int[k] =
                    hn::IfThenElse(hn::RebindMask(n, is_negative), hn::Neg(edge_int[k]), edge_int[k]);
                result.inside[k] =
                    hn::Sub(edge_int[k], hn::IfThenZeroElse(hn::RebindMask(n, owns_ties), hn::Set(n, 1)));
                result.per_row[k] = hn::ConvertTo(n, dx[k]);
                result.per_column[k] = hn::ConvertTo(n, dy[k]);
            }
        }
        // Weights of corners are the edges opposite: 1 (b to c), 2 (c to a) and 0 (a to b).
        const auto per_area = hn::Div(hn::Set(f, 1), hn::Xor(area, sign));
        const auto b = hn::Mul(hn::Sub(t.z[1], t.z[0]), per_area),
                   c = hn::Mul(hn::Sub(t.z[2], t.z[0]), per_area);
        result.depth = hn::MulAdd(edge[2], b, hn::MulAdd(edge[0], c, t.z[0]));
        result.depth_per_column = hn::Neg(hn::MulAdd(dy[2], b, hn::Mul(dy[0], c)));
        result.depth_per_row = hn::MulAdd(dx[2], b, hn::Mul(dx[0], c));
        result.texel = hn::ConvertTo(n, hn::MulAdd(hn::Sub(box.row, top_), resolution_, box.column));
        result.slopes = keeps_slopes_ ? codes_of(result.depth_per_column, result.depth_per_row) : hn::Zero(n);
        return result;
    }

    /// Triangles with small boxes at once.
    void rasterise_small(int at, int count) {
        const auto t = triangles_at(queue_, at);
        const auto p = prepare<Floats>(t, box_of(t), hn::FirstN(f, static_cast<std::size_t>(count)), true);
        reserve(small_side * small_side * lanes);
        for (int j = 0; j < small_side; ++j) {
            for (int i = 0; i < small_side; ++i) {
                Floats inside[3];
                for (int k = 0; k < 3; ++k)
                    inside[k] = at_offset(p.inside[k], p.per_row[k], p.per_column[k], i, j);
                const auto hit = hn::And(p.live, hn::Ge(min3(inside), hn::Zero(f)));
                auto depth = p.depth;
                if (i > 0) depth = hn::Add(depth, p.depth_per_column);
                if (j > 0) depth = hn::Add(depth, p.depth_per_row);
                put(hn::Add(p.texel, hn::Set(n, i + j * map_.resolution)), depth, hit, p.slopes);
            }
        }
    }

    /// Triangles whose boxes are neither small nor large, one by one.
    void rasterise_others(int at, int count) {
        const auto t = triangles_at(others_, at);
        const auto box = box_of(t);
        const auto is_there = hn::FirstN(f, static_cast<std::size_t>(count));
        const auto most = hn::Max(box.width, box.height);
        const bool floats_hold =
            hn::AllTrue(f, hn::Or(hn::Le(most, hn::Set(f, float_side)), hn::Not(is_there)));
        const auto p = prepare<Ints>(t, box, is_there, floats_hold);
        alignas(64) std::int32_t ints[11][lanes];
        alignas(64) float floats[5][lanes];
        for (int k = 0; k < 3; ++k) {
            hn::Store(p.inside[k], n, ints[k]);
            hn::Store(p.per_row[k], n, ints[3 + k]);
            hn::Store(p.per_column[k], n, ints[6 + k]);
        }
        hn::Store(p.texel, n, ints[9]);
        hn::Store(p.slopes, n, ints[10]);
        const Floats others_floats[5] = {p.depth, p.depth_per_row, p.depth_per_column, box.width, box.height};
        for (int k = 0; k < 5; ++k) hn::Store(others_floats[k], f, floats[k]);
        for (auto bits = bits_of(p.live); bits != 0; bits &= bits - 1) {
            const auto lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
            MediumTriangle triangle;
            for (int k = 0; k < 3; ++k) {
                triangle.inside[k] = ints[k][lane];
                triangle.per_row[k] = ints[3 + k][lane];
                triangle.per_column[k] = ints[6 + k][lane];
            }
            triangle.texel = ints[9][lane];
            triangle.slopes = ints[10][lane];
            triangle.depth = floats[0][lane], triangle.depth_per_row = floats[1][lane];
            triangle.depth_per_column = floats[2][lane];
            triangle.width = static_cast<int>(floats[3][lane]),
            triangle.height = static_cast<int>(floats[4][lane]);
            rasterise_medium(triangle);
        }
    }

    static Floats at_offset(Floats edge, Floats gained_per_row, Floats lost_per_column, int columns,
                            int rows) {
        if (rows > 0) edge = hn::Add(edge, gained_per_row);
        if (columns > 0) edge = hn::Sub(edge, lost_per_column);
        return edge;
    }

    /// One triangle, row by row of its box, many texels at a time; values at the box's first centre.
    void rasterise_medium(const MediumTriangle& t) {
#if HWY_TARGET != HWY_SCALAR
        if (keeps_outermost_ && t.width <= lanes / 2) return rasterise_narrow(t);
#endif
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
                raise_some(texel, hn::NearestInt(line_depth),
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
                        raise_some(texel + x, hn::NearestInt(depth), hit);
                    else
                        put(hn::Iota(n, texel + x), depth, hn::RebindMask(f, hit), hn::Set(n, t.slopes));
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

#if HWY_TARGET != HWY_SCALAR
    /// The same of a triangle as wide as half a vector at most, two rows at a time.
    void rasterise_narrow(const MediumTriangle& t) {
        constexpr int half = lanes / 2;
        const auto is_lower = hn::FirstN(n, half);
        const auto lane = hn::Iota(n, 0), column = hn::And(lane, hn::Set(n, half - 1));
        Ints inside[3], down[3];
        for (int k = 0; k < 3; ++k) {
            const auto row = hn::Set(n, t.per_row[k]);
            inside[k] = hn::Sub(hn::Add(hn::Set(n, t.inside[k]), hn::IfThenZeroElse(is_lower, row)),
                                hn::Mul(column, hn::Set(n, t.per_column[k])));
            down[k] = hn::Add(row, row);
        }
        const auto depth_down = hn::Set(f, t.depth_per_row);
        auto depth =
            hn::MulAdd(hn::ConvertTo(f, column), hn::Set(f, t.depth_per_column), hn::Set(f, t.depth));
        depth = hn::IfThenElse(hn::RebindMask(f, is_lower), depth, hn::Add(depth, depth_down));
        int texel = t.texel;
        for (int y = 0; y < t.height; y += 2, texel += 2 * map_.resolution) {
            const auto hit = hn::Gt(hn::Or(inside[0], hn::Or(inside[1], inside[2])), hn::Set(n, -1));
            const auto both = hn::IfThenElseZero(hit, both_depths(hn::NearestInt(depth)));
            if (y + 1 < t.height)
                raise_two(texel, both);
            else
                raise(texel, hn::IfThenElseZero(is_lower, both));
            scratch_.fragments_made += hn::CountTrue(n, hit);
            for (int k = 0; k < 3; ++k) inside[k] = hn::Add(inside[k], down[k]);
            depth = hn::Add(hn::Add(depth, depth_down), depth_down);
        }
    }
    /// Those of the lower half from `texel` on, those of the upper half in the row below.
    void raise_two(int texel, Ints both) {
        constexpr hn::Half<IntTag> half;
        auto* to = reinterpret_cast<std::int32_t*>(map_.outermost.data()) + texel;
        auto* below = to + map_.resolution;
        const auto now = hn::Combine(n, hn::LoadU(half, below), hn::LoadU(half, to));
        const auto raised = max_of_halves(now, both);
        hn::StoreU(hn::LowerHalf(half, raised), half, to);
        hn::StoreU(hn::UpperHalf(half, raised), half, below);
    }
#endif

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
            const auto slopes = keeps_slopes_ ? codes_of(plane) : 0;
            const auto [least, most] = std::minmax({c.z[0], c.z[1], c.z[2]});
            Spans spans(c.x, c.y, map_.first_row, map_.first_row + map_.rows, map_.resolution);
            while (spans.next()) {
                const double depth =
                    plane.at(subtexels * (spans.first() + 0.5), subtexels * (spans.row() + 0.5));
                const int texel = (spans.row() - map_.first_row) * map_.resolution + spans.first();
                put_span(texel, spans.end() - spans.first(), static_cast<float>(depth),
                         static_cast<float>(plane.per_x * subtexels), static_cast<float>(least),
                         static_cast<float>(most), slopes);
            }
        }
    }

    void put_span(int texel, int count, float depth, float per_column, float least, float most,
                  std::uint32_t slopes) {
        if (!keeps_outermost_) reserve(static_cast<std::size_t>(count));
        const auto low = hn::Set(f, std::max(least, ldm_first_depth)),
                   high = hn::Set(f, std::min(most, ldm_last_depth));
        const auto quanta_at = [&](int x) {
            const auto z =
                hn::MulAdd(hn::Iota(f, static_cast<float>(x)), hn::Set(f, per_column), hn::Set(f, depth));
            return hn::NearestInt(hn::Min(hn::Max(z, low), high));
        };
        int x = 0;
        for (; x + lanes <= count; x += lanes) {
            if (keeps_outermost_)
                raise(texel + x, both_depths(quanta_at(x)));
            else
                append(texel + x, quanta_at(x), lanes, slopes);
        }
        if (keeps_outermost_) scratch_.fragments_made += static_cast<std::uint64_t>(count);
        if (x == count) return;
        const int left = count - x;
        if (keeps_outermost_)
            raise(texel + x, hn::IfThenElseZero(hn::FirstN(n, static_cast<std::size_t>(left)),
                                                both_depths(quanta_at(x))));
        else
            append(texel + x, quanta_at(x), left, slopes);
    }

    void append(int texel, Ints quanta, int count, std::uint32_t slopes) {
        const auto packed = hn::Or(hn::ShiftLeft<16>(hn::Iota(n, texel)), quanta);
        hn::StoreU(packed, n,
                   reinterpret_cast<std::int32_t*>(scratch_.fragments.data()) + scratch_.fragment_count);
        if (keeps_slopes_)
            hn::StoreU(hn::Set(n, static_cast<std::int32_t>(slopes)), n,
                       reinterpret_cast<std::int32_t*>(scratch_.slopes.data()) + scratch_.fragment_count);
        scratch_.fragment_count += static_cast<std::size_t>(count);
    }

    /// Consecutive texels at once, from `texel` on: with both depths of each; 0 where there is none.
    void raise(int texel, Ints both) {
        auto* to = reinterpret_cast<std::int32_t*>(map_.outermost.data()) + texel;
        hn::StoreU(max_of_halves(hn::LoadU(n, to), both), n, to);
    }
    void raise_some(int texel, Ints depth, hn::Mask<IntTag> which) {
        raise(texel, hn::IfThenElseZero(which, both_depths(depth)));
        scratch_.fragments_made += hn::CountTrue(n, which);
    }

    const AlphaMasks& masks_;
    StreamedMap& map_;
    BuildScratch& scratch_;
    BuildScratch::Queue &queue_, &others_;
    const Floats top_, bottom_, resolution_;
    const bool keeps_outermost_, keeps_slopes_;
    const float texel_quanta_;
    Culling culling_;
};

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
