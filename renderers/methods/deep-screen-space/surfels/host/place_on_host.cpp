#include "renderers/methods/deep-screen-space/surfels/steps.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numeric>
#include <optional>
#include <vector>

#include "renderers/core/constants.h"
#include "renderers/core/parallel_for.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/surfels/host/curve.h"
#include "renderers/passes/raytracing/alpha_masks.h"
#include "renderers/passes/sampling/pcg.h"
#include "shaders/methods/deep-screen-space/surfels/stored.comp.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Every third bit of the result is one of the ten lowest of `value`.
std::uint32_t spread(std::uint32_t value) {
    std::uint32_t result = 0;
    for (int bit = 0; bit < 10; ++bit) result |= (value >> bit & 1u) << 3 * bit;
    return result;
}

/// Where the middle of a triangle lies on a Morton curve through the world.
std::uint32_t morton(const scene::World& world, std::size_t triangle) {
    const auto corner = [&](std::size_t i) { return world.positions[world.indices[3 * triangle + i]]; };
    const auto middle = (corner(0) + corner(1) + corner(2)) / 3.0f;
    const auto size = glm::max(world.bounds.max - world.bounds.min, glm::vec3(1e-30f));
    const float widest = std::max({size.x, size.y, size.z});
    const auto cell = glm::clamp((middle - world.bounds.min) / widest, 0.0f, 1.0f) * 1023.0f;
    const auto part = [&](int axis) {
        return std::isfinite(cell[axis]) ? spread(static_cast<std::uint32_t>(cell[axis])) << axis : 0u;
    };
    return part(0) | part(1) | part(2);
}

std::vector<std::uint32_t> order_of(const scene::World& world) {
    std::vector<std::uint32_t> keys(world.triangles()), order(world.triangles());
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = morton(world, i);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
    return order;
}

}  // namespace

graph::BufferRef order_triangles(graph::GraphBuilder& builder) {
    const auto triangles = static_cast<std::uint64_t>(builder.inputs().world->triangles());
    const auto order = builder.buffer({.text = {.key = "surfels.order",
                                                .label = "Order of triangles",
                                                .doc = "By where they lie: along a curve through space."},
                                       .name = "Order",
                                       .fields = {{"triangle", graph::FieldType::u32}},
                                       .elements = std::max<std::uint64_t>(1, triangles),
                                       .fingerprint = builder.inputs().geometry_fingerprint});
    builder.pass("order triangles", graph::Queue::cpu)
        .writes(order)
        .execute([=](graph::PassContext& context) {
            const auto sorted = order_of(*context.inputs().world);
            std::ranges::copy(sorted, context.elements<std::uint32_t>(order).begin());
        });
    return order;
}

namespace {

/// The patches of a run of triangles, in their order along the curve.
struct Cut {
    std::vector<WorthOfPatch> patches;
    std::uint64_t units = 0;  ///< of all
    std::uint32_t triangles = 0;
};

/// Surfels of a frame, in two rounds of `packing_parts` each: triangles are cut, then surfels placed.
class PlacingOnHost {
  public:
    explicit PlacingOnHost(const Parameters& parameters) : parameters_(parameters) {}

    void begin(const graph::PassContext& context, float reach, std::span<const std::uint32_t> order) {
        const auto& inputs = context.inputs();
        world_ = inputs.world;
        order_ = order;
        seed_ = random_seed(inputs, parameters_);
        curve_.emplace(*world_, ideal(inputs.view, parameters_), frustum(inputs.view, reach, parameters_),
                       seed_);
        masks_.emplace(*inputs.scene, *world_);
        cuts_.assign(static_cast<std::size_t>(packing_parts), {});
    }

    void cut(std::int64_t part) {
        auto& cut = cuts_[static_cast<std::size_t>(part)];
        const auto at = [&](std::int64_t i) {
            return static_cast<std::int64_t>(world_->triangles()) * i / packing_parts;
        };
        for (auto i = at(part); i < at(part + 1); ++i) {
            const auto before = cut.patches.size();
            curve_->cut(order_[static_cast<std::size_t>(i)], cut.patches);
            cut.triangles += cut.patches.size() > before;
        }
        for (const auto& patch : cut.patches) cut.units += patch.units;
    }

    struct Counts {
        std::uint32_t triangles = 0, patches = 0, units = 0, surfels = 0;
    };
    /// Between the rounds.
    Counts count() {
        Counts counts;
        first_units_.clear();
        units_ = 0;
        for (const auto& cut : cuts_) {
            first_units_.push_back(units_);
            units_ += cut.units;
            counts.triangles += cut.triangles;
            counts.patches += static_cast<std::uint32_t>(cut.patches.size());
        }
        counts.units = static_cast<std::uint32_t>(units_);
        const auto pieces = (units_ + units_of_surfel - 1) / units_of_surfel;
        // The last piece is a part of one: as likely as it is large.
        counts.surfels =
            static_cast<std::uint32_t>(pieces > 0 && unit_of(pieces - 1) >= units_ ? pieces - 1 : pieces);
        return counts;
    }

    void place(std::int64_t part, std::span<Surfel> surfels) const {
        const auto& cut = cuts_[static_cast<std::size_t>(part)];
        auto first = first_units_[static_cast<std::size_t>(part)];
        auto item = first / units_of_surfel;
        if (unit_of(item) < first) ++item;
        for (const auto& patch : cut.patches) {
            for (; unit_of(item) < first + patch.units && item < surfels.size(); ++item)
                surfels[item] = surfel(static_cast<std::uint32_t>(item), patch,
                                       static_cast<std::uint32_t>(unit_of(item) - first));
            first += patch.units;
        }
    }

  private:
    /// Where a surfel lies on the curve.
    std::uint64_t unit_of(std::uint64_t item) const {
        const auto random = passes::pcg4d({static_cast<std::uint32_t>(item), seed_, 0x5f3759dfu, 0u}).x;
        return item * units_of_surfel + random % units_of_surfel;
    }

    Surfel surfel(std::uint32_t item, const WorthOfPatch& worth, std::uint32_t unit) const {
        const auto& p = worth.patch;
        const auto random = passes::pcg4d({item, seed_, p.triangle, p.place});
        const auto units = static_cast<float>(worth.units);
        const float t = (static_cast<float>(unit) + passes::unit_float(random.x)) / units;
        const auto weights = curve_->weights_on(p, std::min(t, 0.99999994f));
        const auto barycentrics = glm::packUnorm2x16(weights);
        const float radius =
            is_there(p.triangle, barycentrics) ? std::sqrt(curve_->ideal_area_of(p) / pi) : 0;
        return {.centre_ws = curve_->position(p.triangle, weights),
                .triangle = p.triangle,
                .normal_ws = curve_->normal(p.triangle),
                .radius = radius,
                .barycentrics = barycentrics,
                .identity = random.z ^ passes::pcg(random.w),
                .order = item,
                .unused = 0};
    }

    bool is_there(std::uint32_t triangle, std::uint32_t barycentrics) const {
        if (triangle < world_->opaque_triangles) return true;
        const auto weights = glm::unpackUnorm2x16(barycentrics);
        return masks_->is_covered(triangle - static_cast<std::uint32_t>(world_->opaque_triangles), weights.x,
                                  weights.y);
    }

    Parameters parameters_;
    const scene::World* world_ = nullptr;
    std::span<const std::uint32_t> order_;
    unsigned seed_ = 0;
    std::optional<Curve> curve_;
    std::optional<passes::AlphaMasks> masks_;
    std::vector<Cut> cuts_;
    std::vector<std::uint64_t> first_units_;
    std::uint64_t units_ = 0;
};

}  // namespace

Placed place_on_host(graph::GraphBuilder& builder, float reach, std::uint64_t reserve,
                     const Parameters& parameters, const std::string& fingerprint) {
    const auto kept = declare_records(builder, reserve, fingerprint);
    Patches patches;
    patches.total = declare_units(builder);
    patches.triangles = declare_triangles_left(builder);
    patches.list.count = builder.counter(patches_counter());
    patches.left =
        builder.buffer({.text = {.key = "surfels.left",
                                 .label = "Triangles and patches left",
                                 .doc = "That are not culled."},
                        .fields = {{"triangles", graph::FieldType::u32}, {"patches", graph::FieldType::u32}},
                        .elements = 1,
                        .fingerprint = fingerprint});
    const auto surfels = declare_surfels(builder, kept, fingerprint);
    const auto order = order_triangles(builder);
    builder.pass("place surfels", graph::Queue::cpu)
        .has_two_bodies()
        .reads(order)
        .writes(kept.buffer, surfels.stored, patches.left)
        .counts(kept.count)
        .counts(patches.total)
        .counts(patches.triangles)
        .counts(patches.list.count)
        .execute_sliced(
            2 * packing_parts,
            [=, placing = std::make_shared<PlacingOnHost>(parameters)](graph::PassContext& context,
                                                                       graph::Slice slice) {
                if (slice.first) placing->begin(context, reach, context.elements<const std::uint32_t>(order));
                const auto threads = context.inputs().threads;
                parallel_for(threads, slice.begin, std::min(slice.end, packing_parts),
                             [&](std::int64_t part) { placing->cut(part); });
                if (slice.begin <= packing_parts && slice.end > packing_parts) {
                    const auto counts = placing->count();
                    context.add(patches.triangles, counts.triangles);
                    context.add(patches.list.count, counts.patches);
                    context.add(patches.total, counts.units);
                    context.add(kept.count, counts.surfels);
                    const auto left = context.elements<std::uint32_t>(patches.left);
                    left[0] = counts.triangles, left[1] = counts.patches;
                    const auto room = static_cast<std::uint32_t>(context.capacity(kept.buffer));
                    context.elements<StoredSurfels>(surfels.stored)[0] = {std::min(counts.surfels, room),
                                                                          counts.surfels};
                }
                const auto records = context.elements<Surfel>(kept.buffer);
                parallel_for(threads, std::max(slice.begin, packing_parts), slice.end,
                             [&](std::int64_t part) { placing->place(part - packing_parts, records); });
            },
            1);
    return {patches, surfels};
}

}  // namespace ir::methods::deep_screen_space
