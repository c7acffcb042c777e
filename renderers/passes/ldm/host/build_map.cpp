// Rasterises a band of rows of one map on the host, many triangles or texels at a time. A triangle covers the
// texels whose centres lie inside of it, or on its top or left edges; as in shaders/passes/ldm/rasterise.comp
// corners are snapped to subtexels and what follows is exact, so that neighbours neither overlap nor gape.
#include <algorithm>
#include <cmath>
#include <utility>

#include "renderers/passes/ldm/host/streamed_map.h"
#include "renderers/passes/ldm/host/vectors.h"
#include "renderers/passes/raytracing/alpha_masks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/passes/ldm/host/build_map.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, BuildScratch::lanes>;
using IntTag = hn::RebindToSigned<FloatTag>;
using ByteTag = hn::Rebind<std::uint8_t, IntTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using Mask = hn::Mask<FloatTag>;

constexpr int lanes = static_cast<int>(hn::MaxLanes(FloatTag()));
constexpr FloatTag f;
constexpr IntTag n;

/// Depths are kept within the range that `quantised` of fragments.glsl gives.
constexpr int least_depth = 1, most_depth = 65534;
/// Boxes of so many texels a side have edge functions below 2^30, and below 2^24, which float holds exactly.
constexpr int medium_side = 64, float_side = 8;
/// Of the block of texels that the lanes look at together.
constexpr int block_columns = std::min(lanes, 8), block_rows = lanes / block_columns;
/// Side of the blocks of texels that hidden meshlets are found by.
constexpr int cull_side = 4;
/// The maps of outermost depths take fragments while these are still in the first-level cache.
constexpr std::size_t flushed_at = 4096;

/// Some lanes, packed, with anything behind them. (To compress in registers first is many times as fast on
/// some processors.)
template <class Tag, class Vector>
void pack(Vector values, hn::Mask<Tag> which, Tag tag, hn::TFromD<Tag>* to) {
    hn::StoreU(hn::Compress(values, which), tag, to);
}

/// Rows of a triangle and the texels of each whose centres it covers. Corners are whole subtexels.
class Spans {
  public:
    /// Rows from `top` up to `bottom`, columns from 0 up to `resolution`.
    Spans(const double (&x)[3], const double (&y)[3], int top, int bottom, int resolution)
        : resolution_(resolution) {
        int order[3] = {0, 1, 2};
        std::sort(order, order + 3, [&](int a, int b) { return y[a] < y[b]; });
        for (int i = 0; i < 3; ++i) x_[i] = x[order[i]], y_[i] = y[order[i]];
        row_ = std::max(first_centre(y_[0]), top) - 1;
        end_row_ = std::min(first_centre(y_[2]), bottom);
    }
    /// Goes to the next row that has any; false: there is none.
    bool next() {
        while (++row_ < end_row_) {
            const double y = subtexels * (row_ + 0.5);
            const int a = column(0, 2, y), b = y < y_[1] ? column(0, 1, y) : column(1, 2, y);
            first_ = std::max(std::min(a, b), 0);
            end_ = std::min(std::max(a, b), resolution_);
            if (first_ < end_) return true;
        }
        return false;
    }
    int row() const { return row_; }
    int first() const { return first_; }
    int end() const { return end_; }  ///< one after the last

  private:
    static int first_centre(double subtexel) {
        return static_cast<int>(std::ceil((subtexel - 0.5 * subtexels) / subtexels));
    }
    /// First column whose centre is not left of the edge. Divided once, the quotient of whole numbers below
    /// 2^42 lies on the right side of every whole number.
    int column(int from, int to, double y) const {
        const double height = y_[to] - y_[from];
        const double numerator = (x_[from] - 0.5 * subtexels) * height + (y - y_[from]) * (x_[to] - x_[from]);
        return static_cast<int>(std::ceil(numerator / (subtexels * height)));
    }
    double x_[3], y_[3];
    int resolution_, row_, end_row_, first_ = 0, end_ = 0;
};

/// Depth of a triangle's plane above subtexel coordinates.
struct Plane {
    double depth, per_x, per_y, x, y;
    Plane(const double (&xs)[3], const double (&ys)[3], const double (&zs)[3])
        : depth(zs[0]), per_x(0), per_y(0), x(xs[0]), y(ys[0]) {
        const double bx = xs[1] - x, by = ys[1] - y, cx = xs[2] - x, cy = ys[2] - y, area = bx * cy - by * cx;
        if (area == 0) return;
        const double bz = (zs[1] - zs[0]) / area, cz = (zs[2] - zs[0]) / area;
        per_x = bz * cy - cz * by;
        per_y = cz * bx - bz * cx;
    }
    double at(double px, double py) const { return depth + per_x * (px - x) + per_y * (py - y); }
};

/// Column and row of each lane in such a block.
struct BlockLanes {
    alignas(64) std::int32_t column[lanes] = {}, row[lanes] = {};
    constexpr BlockLanes() {
        for (int i = 0; i < lanes; ++i) {
            column[i] = i % block_columns;
            row[i] = i / block_columns;
        }
    }
};
constexpr BlockLanes block;

/// A triangle whose box is not large: edge functions, with what they gain a row and lose a column, and depth.
struct MediumTriangle {
    std::int32_t inside[3], per_row[3], per_column[3], texel;
    float depth, depth_per_row, depth_per_column;
    int width, height;
};

std::uint32_t bits_of(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(f, mask, bytes);
    const auto bits = static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
    return lanes < 16 ? bits & ((1u << lanes) - 1) : bits;
}

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
        const auto low_half = hn::Set(n, 0xffff);
        const hn::RebindToUnsigned<IntTag> unsigned_tag;
        auto far = low_half, near = low_half;
        for (int y = 0; y < most_blocks; ++y) {
            const auto in_rows = hn::And(known, hn::Ge(rows, hn::Set(f, static_cast<float>(y))));
            if (hn::AllFalse(f, in_rows)) break;
            for (int x = 0; x < most_blocks; ++x) {
                const auto in_both = hn::And(in_rows, hn::Ge(columns, hn::Set(f, static_cast<float>(x))));
                if (hn::AllFalse(f, in_both)) break;
                const auto place =
                    hn::Add(base, hn::IfThenElseZero(hn::RebindMask(n, in_both), hn::Set(n, y * side + x)));
                const auto block = hn::GatherIndex(n, scratch_.blocks.data(), place);
                far = hn::Min(far, hn::BitCast(n, hn::ShiftRight<16>(hn::BitCast(unsigned_tag, block))));
                near = hn::Min(near, hn::And(block, low_half));
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

class MapBuild {
  public:
    MapBuild(const Meshlets& meshlets, const AlphaMasks& masks, StreamedMap& map, BuildScratch& scratch)
        : meshlets_(meshlets),
          masks_(masks),
          map_(map),
          scratch_(scratch),
          queue_(scratch.queue),
          keeps_outermost_(map.holds == Holds::outermost),
          culling_(meshlets, map, scratch) {}

    void run() {
        begin();
        const auto all = meshlets_.meshlets.size();
        std::size_t first = 0;
        for (const auto end : meshlets_.stage_ends) {
            rasterise(first, end);
            rasterise_queue();
            first = end;
            if (!keeps_outermost_) continue;
            flush();
            culling_.find_hidden(first, all);
        }
        rasterise(first, all);
        if (keeps_outermost_)
            flush();
        else
            sort_into_lists();
    }

  private:
    std::size_t texels() const { return static_cast<std::size_t>(map_.rows) * map_.resolution; }

    void begin() {
        scratch_.fragment_count = 0;
        scratch_.fragments.resize(std::max<std::size_t>(scratch_.fragments.size(), 4 * flushed_at));
        scratch_.hidden.assign(meshlets_.meshlets.size() + BuildScratch::lanes, 0);
        queue_.size = 0;
        if (keeps_outermost_) map_.outermost.assign(texels() + lanes, 0);
    }

    /// Meshlets first … end - 1: the queue holds what is not rasterised yet.
    void rasterise(std::size_t first, std::size_t end) {
        for (auto i = first; i < end; ++i) {
            if (scratch_.hidden[i] || is_outside(i)) continue;
            const auto& meshlet = meshlets_.meshlets[i];
            transform(meshlet);
            if (i < meshlets_.opaque())
                queue_triangles<false>(meshlet, nullptr);
            else
                queue_triangles<true>(meshlet, meshlets_.masked_triangles[i - meshlets_.opaque()].data());
        }
    }

    bool is_outside(std::size_t meshlet) const {
        if (map_.rows == map_.resolution) return false;
        float middle = map_.frame.v.w, reach = 1;
        for (int axis = 0; axis < 3; ++axis) {
            middle += map_.frame.v[axis] * meshlets_.centre[axis][meshlet];
            reach += std::abs(map_.frame.v[axis]) * meshlets_.half[axis][meshlet];
        }
        return middle + reach < static_cast<float>(map_.first_row) ||
               middle - reach > static_cast<float>(map_.first_row + map_.rows);
    }

    /// dot(p, row.xyz) + row.w of a vector of vertices, all times `scale`, plus `added`.
    static Floats projected(const Meshlet& meshlet, int first, const glm::vec4& row, float scale,
                            float added) {
        const auto x = hn::Load(f, meshlet.x + first), y = hn::Load(f, meshlet.y + first),
                   z = hn::Load(f, meshlet.z + first);
        auto sum = hn::MulAdd(z, hn::Set(f, row.z * scale), hn::Set(f, row.w * scale + added));
        sum = hn::MulAdd(y, hn::Set(f, row.y * scale), sum);
        return hn::MulAdd(x, hn::Set(f, row.x * scale), sum);
    }

    void transform(const Meshlet& meshlet) {
        const auto& frame = map_.frame;
        for (int i = 0; i < Meshlet::max_vertices; i += lanes) {
            hn::Store(hn::Floor(projected(meshlet, i, frame.u, subtexels, 0.5f)), f, x_ + i);
            hn::Store(hn::Floor(projected(meshlet, i, frame.v, subtexels, 0.5f)), f, y_ + i);
            hn::Store(projected(meshlet, i, frame.depth, 1, 0), f, z_ + i);
        }
    }

    /// First texel, along an axis, whose centre is not below a subtexel coordinate.
    static Floats first_centre(Floats subtexel) {
        return hn::Ceil(hn::MulSub(subtexel, hn::Set(f, 1.0f / subtexels), hn::Set(f, 0.5f)));
    }
    static Floats min3(const Floats (&a)[3]) { return hn::Min(a[0], hn::Min(a[1], a[2])); }
    static Floats max3(const Floats (&a)[3]) { return hn::Max(a[0], hn::Max(a[1], a[2])); }

    /// Puts triangles whose box holds a texel's centre into the queue: most do not.
    template <bool masked>
    void queue_triangles(const Meshlet& meshlet, const std::uint32_t* numbers) {
        const auto top = hn::Set(f, static_cast<float>(map_.first_row)),
                   bottom = hn::Set(f, static_cast<float>(map_.first_row + map_.rows));
        for (int first = 0; first < meshlet.triangles; first += lanes) {
            Ints corner[3];
            Floats x[3], y[3];
            for (int k = 0; k < 3; ++k) {
                corner[k] = hn::PromoteTo(n, hn::LoadU(ByteTag(), meshlet.corners[k] + first));
                x[k] = hn::GatherIndex(f, x_, corner[k]);
                y[k] = hn::GatherIndex(f, y_, corner[k]);
            }
            const auto low = hn::Max(first_centre(min3(y)), top),
                       end = hn::Min(first_centre(max3(y)), bottom);
            const auto live = hn::And(hn::Lt(first_centre(min3(x)), first_centre(max3(x))), hn::Lt(low, end));
            if (hn::AllFalse(f, live)) continue;
            const int at = queue_.size;
            for (int k = 0; k < 3; ++k) {
                pack(x[k], live, f, queue_.x[k] + at);
                pack(y[k], live, f, queue_.y[k] + at);
                pack(hn::GatherIndex(f, z_, corner[k]), live, f, queue_.z[k] + at);
            }
            if constexpr (masked)
                pack(hn::LoadU(n, reinterpret_cast<const std::int32_t*>(numbers) + first),
                     hn::RebindMask(n, live), n, reinterpret_cast<std::int32_t*>(queue_.number) + at);
            queue_.size += static_cast<int>(hn::CountTrue(f, live));
            if (queue_.size <= BuildScratch::queue_size - lanes) continue;
            if constexpr (!masked) rasterise_queue();
        }
        if constexpr (masked) rasterise_masked_queue();
    }

    void rasterise_queue() {
        for (int at = 0; at < queue_.size; at += lanes)
            rasterise_group(at, std::min(lanes, queue_.size - at));
        queue_.size = 0;
    }

    void reserve(std::size_t more) {
        if (keeps_outermost_ && scratch_.fragment_count >= flushed_at) flush();
        const auto needed = scratch_.fragment_count + more + lanes;
        if (needed > scratch_.fragments.size()) scratch_.fragments.resize(2 * needed);
    }

    /// Depths inside of a triangle: they lie within the margins of the map's range.
    void put(Ints texel, Floats depth, Mask which) {
        const auto packed = hn::Or(hn::ShiftLeft<16>(texel), hn::NearestInt(depth));
        auto* to = reinterpret_cast<std::int32_t*>(scratch_.fragments.data()) + scratch_.fragment_count;
        pack(packed, hn::RebindMask(n, which), n, to);
        scratch_.fragment_count += hn::CountTrue(f, which);
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

    /// One triangle, block by block of its box; values at the box's first centre.
    void rasterise_medium(const MediumTriangle& t) {
        const auto column = hn::Load(n, block.column), row = hn::Load(n, block.row);
        const auto offset = hn::Add(hn::Mul(row, hn::Set(n, map_.resolution)), column);
        Ints line[3], right[3], down[3];
        for (int k = 0; k < 3; ++k) {
            line[k] = hn::Add(hn::Set(n, t.inside[k]), hn::Sub(hn::Mul(row, hn::Set(n, t.per_row[k])),
                                                               hn::Mul(column, hn::Set(n, t.per_column[k]))));
            right[k] = hn::Set(n, block_columns * t.per_column[k]);
            down[k] = hn::Set(n, block_rows * t.per_row[k]);
        }
        auto line_depth =
            hn::MulAdd(hn::ConvertTo(f, column), hn::Set(f, t.depth_per_column),
                       hn::MulAdd(hn::ConvertTo(f, row), hn::Set(f, t.depth_per_row), hn::Set(f, t.depth)));
        const auto depth_right = hn::Set(f, static_cast<float>(block_columns) * t.depth_per_column),
                   depth_down = hn::Set(f, static_cast<float>(block_rows) * t.depth_per_row);
        for (int y = 0; y < t.height; y += block_rows) {
            reserve(block_rows * medium_side);
            auto a = line[0], b = line[1], c = line[2];
            auto depth = line_depth;
            for (int x = 0; x < t.width; x += block_columns) {
                const auto hit = hn::RebindMask(f, hn::Gt(hn::Or(a, hn::Or(b, c)), hn::Set(n, -1)));
                if (!hn::AllFalse(f, hit))
                    put(hn::Add(offset, hn::Set(n, t.texel + y * map_.resolution + x)), depth, hit);
                a = hn::Sub(a, right[0]);
                b = hn::Sub(b, right[1]);
                c = hn::Sub(c, right[2]);
                depth = hn::Add(depth, depth_right);
            }
            for (int k = 0; k < 3; ++k) line[k] = hn::Add(line[k], down[k]);
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
                raise(texel + x, quanta, left);
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

    /// Consecutive texels at once.
    void raise(int texel, Ints quanta, int count) {
        auto* to = reinterpret_cast<std::int32_t*>(map_.outermost.data()) + texel;
        const hn::RebindToUnsigned<IntTag> unsigned_tag;
        const auto old = hn::LoadU(n, to), low_half = hn::Set(n, 0xffff);
        const auto far = hn::BitCast(n, hn::ShiftRight<16>(hn::BitCast(unsigned_tag, old)));
        const auto near = hn::Max(hn::And(old, low_half), hn::Sub(low_half, quanta));
        const auto packed = hn::Or(hn::ShiftLeft<16>(hn::Max(far, quanta)), near);
        hn::BlendedStore(packed, hn::FirstN(n, static_cast<std::size_t>(count)), n, to);
        scratch_.fragments_made += static_cast<std::uint64_t>(count);
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

    const Meshlets& meshlets_;
    const AlphaMasks& masks_;
    StreamedMap& map_;
    BuildScratch& scratch_;
    BuildScratch::Queue& queue_;
    const bool keeps_outermost_;
    Culling culling_;
    alignas(64) float x_[Meshlet::max_vertices], y_[Meshlet::max_vertices], z_[Meshlet::max_vertices];
};

}  // namespace

void build(const Meshlets& meshlets, const AlphaMasks& masks, StreamedMap& map, BuildScratch& scratch) {
    MapBuild(meshlets, masks, map, scratch).run();
}

}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::passes::ldm {

HWY_EXPORT(build);

void build_map(const Meshlets& meshlets, const AlphaMasks& masks, const MapFrame& frame, int first_row,
               int rows, StreamedMap& map, BuildScratch& scratch) {
    map.frame = frame;
    map.first_row = first_row;
    map.rows = rows;
    HWY_DYNAMIC_DISPATCH(build)(meshlets, masks, map, scratch);
}

}  // namespace ir::passes::ldm
#endif
