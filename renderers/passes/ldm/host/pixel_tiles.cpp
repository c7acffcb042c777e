// Puts the pixels of a G-buffer into tiles.
#include "renderers/passes/ldm/host/pixel_tiles.h"

#include <tbb/parallel_for.h>

#include <limits>

#include "renderers/passes/vectors/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/passes/ldm/host/pixel_tiles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int side = PixelTiles::side;
using RowTag = hn::CappedTag<float, side>;
using Floats = hn::Vec<RowTag>;
constexpr RowTag f;
constexpr int lanes = static_cast<int>(hn::MaxLanes(RowTag()));

/// A row of a tile, by axis. 0 beside the picture.
struct Row {
    alignas(32) float position[3][side] = {}, geometric_normal[3][side] = {};
    alignas(32) std::uint16_t normal[3][side] = {};  ///< in half floats

    Row(const SurfaceImages& images, int left, int y) {
        if (y >= images.height) return;
        const auto first = static_cast<std::size_t>(y) * images.width;
        for (int x = left; x < std::min(left + side, images.width); ++x) {
            const auto& at = images.position[first + x];
            const auto& plane = images.geometric_normal[first + x];
            const auto packed = images.normal[first + x];
            for (int axis = 0; axis < 3; ++axis) {
                position[axis][x - left] = at[axis];
                geometric_normal[axis][x - left] = plane[axis];
                normal[axis][x - left] = static_cast<std::uint16_t>(packed >> 16 * axis);
            }
        }
    }
};

/// The box around some vectors.
class Extent {
  public:
    Extent() {
        for (auto& least : least_) least = hn::Set(f, std::numeric_limits<float>::max());
        for (auto& most : most_) most = hn::Set(f, -std::numeric_limits<float>::max());
    }
    void add(const Floats (&vectors)[3], hn::Mask<RowTag> which) {
        for (int axis = 0; axis < 3; ++axis) {
            least_[axis] = hn::Min(least_[axis], hn::IfThenElse(which, vectors[axis], least_[axis]));
            most_[axis] = hn::Max(most_[axis], hn::IfThenElse(which, vectors[axis], most_[axis]));
        }
    }
    void store(PixelTiles::Boxes& boxes, std::size_t tile, bool is_empty) const {
        for (int axis = 0; axis < 3; ++axis) {
            const float least = is_empty ? 0 : hn::GetLane(hn::MinOfLanes(f, least_[axis])),
                        most = is_empty ? 0 : hn::GetLane(hn::MaxOfLanes(f, most_[axis]));
            boxes.centre[axis][tile] = 0.5f * (least + most);
            boxes.half[axis][tile] = 0.5f * (most - least);
        }
    }

  private:
    Floats least_[3], most_[3];
};

Floats dot(const Floats (&a)[3], const Floats (&b)[3]) {
    return hn::MulAdd(a[2], b[2], hn::MulAdd(a[1], b[1], hn::Mul(a[0], b[0])));
}

void find_plane(PixelTiles& tiles, std::size_t tile) {
    tiles.plane_offset[tile] = 0;
    tiles.off_plane[tile] = std::numeric_limits<float>::infinity();
    if (tiles.valid[tile] != ~std::uint64_t{0} || !tiles.geometric_normal_boxes.is_point(tile)) return;
    auto least = hn::Set(f, std::numeric_limits<float>::max()), most = hn::Neg(least);
    for (int i = 0; i < PixelTiles::pixels; i += lanes) {
        const auto place = tile * PixelTiles::pixels + static_cast<std::size_t>(i);
        Floats position[3], normal[3];
        for (int axis = 0; axis < 3; ++axis) {
            position[axis] = hn::LoadU(f, tiles.position[axis].data() + place);
            normal[axis] = hn::LoadU(f, tiles.geometric_normal[axis].data() + place);
        }
        const auto offset = dot(position, normal);
        least = hn::Min(least, offset), most = hn::Max(most, offset);
    }
    const float first = hn::GetLane(hn::MinOfLanes(f, least)), last = hn::GetLane(hn::MaxOfLanes(f, most));
    tiles.plane_offset[tile] = 0.5f * (first + last);
    tiles.off_plane[tile] = 0.5f * (last - first);
}

}  // namespace

void fill_tile(PixelTiles& tiles, std::size_t tile, const SurfaceImages& images) {
    const int left = static_cast<int>(tile % tiles.columns) * side;
    const int top = static_cast<int>(tile / tiles.columns) * side;
    constexpr hn::Rebind<hwy::float16_t, RowTag> halves;
    Extent positions, geometric_normals, normals;
    std::uint64_t valid = 0;
    for (int y = 0; y < side; ++y) {
        const Row row(images, left, top + y);
        for (int x = 0; x < side; x += lanes) {
            Floats position[3], geometric_normal[3], normal[3];
            for (int axis = 0; axis < 3; ++axis) {
                position[axis] = hn::Load(f, row.position[axis] + x);
                geometric_normal[axis] = hn::Load(f, row.geometric_normal[axis] + x);
                const auto* const half = reinterpret_cast<const hwy::float16_t*>(row.normal[axis] + x);
                normal[axis] = hn::PromoteTo(f, hn::LoadU(halves, half));
            }
            const auto is_valid = hn::Gt(dot(geometric_normal, geometric_normal), hn::Zero(f));
            const auto per_length = hn::Div(hn::Set(f, 1), hn::Sqrt(dot(normal, normal)));
            const auto place = tile * PixelTiles::pixels + static_cast<std::size_t>(y * side + x);
            for (int axis = 0; axis < 3; ++axis) {
                position[axis] = hn::IfThenElseZero(is_valid, position[axis]);
                normal[axis] = hn::IfThenElseZero(is_valid, hn::Mul(normal[axis], per_length));
                hn::StoreU(position[axis], f, tiles.position[axis].data() + place);
                hn::StoreU(geometric_normal[axis], f, tiles.geometric_normal[axis].data() + place);
                hn::StoreU(normal[axis], f, tiles.normal[axis].data() + place);
            }
            positions.add(position, is_valid);
            geometric_normals.add(geometric_normal, is_valid);
            normals.add(normal, is_valid);
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(f, is_valid, bits);
            valid |= static_cast<std::uint64_t>(bits[0] & ((1u << lanes) - 1)) << (y * side + x);
        }
    }
    tiles.valid[tile] = valid;
    positions.store(tiles.position_boxes, tile, valid == 0);
    geometric_normals.store(tiles.geometric_normal_boxes, tile, valid == 0);
    normals.store(tiles.normal_boxes, tile, valid == 0);
    find_plane(tiles, tile);
}

}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::passes::ldm {

HWY_EXPORT(fill_tile);

void fill_pixel_tiles(PixelTiles& tiles, const SurfaceImages& images) {
    tiles.width = images.width;
    tiles.height = images.height;
    constexpr int side = PixelTiles::side;
    tiles.columns = (images.width + side - 1) / side;
    const auto rows = (images.height + side - 1) / side;
    const auto count = static_cast<std::size_t>(tiles.columns) * rows;
    constexpr std::size_t padding = 16;  // at least the lanes of a vector of floats
    tiles.valid.resize(count);
    tiles.plane_offset.resize(count + padding);
    tiles.off_plane.resize(count + padding);
    for (int axis = 0; axis < 3; ++axis) {
        for (auto* values : {&tiles.position[axis], &tiles.geometric_normal[axis], &tiles.normal[axis]})
            values->resize(count * PixelTiles::pixels);
        for (auto* boxes : {&tiles.position_boxes, &tiles.geometric_normal_boxes, &tiles.normal_boxes}) {
            boxes->centre[axis].resize(count + padding);
            boxes->half[axis].resize(count + padding);
        }
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
        for (auto tile = range.begin(); tile != range.end(); ++tile)
            HWY_DYNAMIC_DISPATCH(fill_tile)(tiles, tile, images);
    });
}

}  // namespace ir::passes::ldm
#endif
