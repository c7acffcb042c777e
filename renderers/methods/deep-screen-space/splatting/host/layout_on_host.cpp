#include "renderers/methods/deep-screen-space/splatting/hierarchy.h"

#include <array>
#include <utility>

#include "renderers/core/parallel_for.h"
#include "renderers/graph/image_layers.h"
#include "renderers/passes/sampling/pcg.h"
#include "shaders/methods/deep-screen-space/splatting/places.glsl.h"

namespace ir::methods::deep_screen_space {
namespace {

std::uint32_t packed_place(glm::uvec2 place) {
    return place.x | place.y << 16;
}

/// One of the 24 permutations of 0 … 3, applied to `digit`.
std::uint32_t permuted(std::uint32_t digit, std::uint32_t which) {
    std::array<std::uint32_t, 4> order{0, 1, 2, 3};
    for (std::uint32_t i = 3; i > 0; --i) {
        std::swap(order[i], order[which % (i + 1)]);
        which /= i + 1;
    }
    return order[digit];
}

/// sub_image_of of layout.comp.
glm::uvec2 sub_image_of(glm::uvec2 pixel, std::uint32_t level, unsigned seed) {
    glm::uvec2 sub_image(0);
    for (std::uint32_t depth = 0; depth < level; ++depth) {
        const auto node = pixel >> (level - depth), bits = (pixel >> (level - depth - 1)) & 1u;
        const auto random = (passes::pcg4d({node, level | depth << 8, seed}).x >> 16) * 24 >> 16;
        const auto digit = permuted(bits.x | bits.y << 1, random);
        sub_image = sub_image << 1u | glm::uvec2(digit & 1, digit >> 1);
    }
    return sub_image;
}

}  // namespace

void lay_out_on_host(graph::GraphBuilder& builder, const Hierarchy& hierarchy, unsigned seed) {
    const glm::uvec2 size(hierarchy.width, hierarchy.height);
    builder.pass("framebuffer layout", graph::Queue::cpu)
        .has_two_bodies()
        .writes(hierarchy.layout, hierarchy.places)
        .execute_sliced(std::int64_t{hierarchy.levels} * hierarchy.height, [=](graph::PassContext& p,
                                                                               graph::Slice slice) {
            const auto& view = p.inputs().view;
            const glm::uvec2 seen(view.width, view.height);
            const auto layout = graph::layers<std::uint32_t>(p, hierarchy.layout);
            const auto places = graph::layers<std::uint32_t>(p, hierarchy.places);
            parallel_for(p.inputs().threads, slice.begin, slice.end, [&](std::int64_t row) {
                const auto level = static_cast<std::uint32_t>(row / size.y);
                const auto y = static_cast<std::uint32_t>(row % size.y);
                for (std::uint32_t x = 0; x < size.x; ++x) {
                    const glm::uvec2 pixel(x, y);
                    const auto place = sub_image_of(pixel, level, seed) * (size >> level) + (pixel >> level);
                    const bool is_seen = x < seen.x && y < seen.y;
                    places[level][std::size_t{y} * size.x + x] = packed_place(place);
                    layout[level][std::size_t{place.y} * size.x + place.x] =
                        is_seen ? packed_place(pixel) : padding;
                }
            });
        });
}

}  // namespace ir::methods::deep_screen_space
