#include <algorithm>

#include "renderers/methods/deep-screen-space/splatting/steps.h"

namespace ir::methods::deep_screen_space {
namespace {

using graph::ImageRef;

constexpr int largest_radius = 64;  // of the blur

gl::Format format_of(const graph::GraphBuilder& builder, ImageRef image) {
    return builder.images().at(static_cast<std::size_t>(image.index)).format;
}

/// Constants of unshuffle.comp.
struct Unshuffle {
    int level;
    IR_FIELDS(level)
};

ImageRef unshuffled(graph::GraphBuilder& builder, const Hierarchy& hierarchy, ImageRef stack,
                    const std::string& key, int level) {
    graph::ImageDesc desc;
    desc.text = {.key = key, .label = "Level " + std::to_string(level) + ", unshuffled"};
    desc.format = format_of(builder, stack);
    const auto image = builder.image(std::move(desc));
    builder.pass("unshuffle: " + key)
        .reads("places_texture", hierarchy.places)
        .reads("stack", stack)
        .writes("result", image)
        .compute({{folder + "unshuffle.comp"}}, image, Unshuffle{level});
    return image;
}

}  // namespace

LevelSums blur_levels(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                      const Hierarchy& hierarchy, ImageRef stack, const Parameters& parameters) {
    const auto& options = parameters.reconstruction.blur;
    const auto name = builder.images().at(static_cast<std::size_t>(stack.index)).text.key;
    LevelSums sums{stack, {}};
    for (int level = 0; level < hierarchy.levels; ++level) {
        const auto key = name + ".level_" + std::to_string(level);
        const auto image = unshuffled(builder, hierarchy, stack, key, level);
        auto wider = options;
        wider.radius = std::min(options.used_radius() << level, largest_radius);
        sums.levels.push_back(
            passes::blur(builder, gbuffer, image, wider,
                         {.key = key + ".blurred",
                          .label = "Level " + std::to_string(level) + ", blurred",
                          .doc = "Over " + std::to_string(wider.radius) + " pixels on either side."}));
    }
    return sums;
}

void show_unshuffled(graph::GraphBuilder& builder, const Hierarchy& hierarchy, ImageRef stack) {
    const auto levels =
        builder.output("additive.levels", {.format = format_of(builder, stack), .layers = hierarchy.levels});
    builder.pass("unshuffle levels")
        .reads("places_texture", hierarchy.places)
        .reads("stack", stack)
        .writes("result", levels)
        .execute([=](graph::PassContext& p) {
            const auto& program = p.use({{folder + "unshuffle.comp"}, {{"TO_STACK", "1"}}});
            const auto shape = p.shape(levels);
            for (int level = 0; level < hierarchy.levels; ++level) {
                program.set(Unshuffle{level});
                program.dispatch(shape.width, shape.height);
            }
        });
}

std::vector<OutputDescription> additive_outputs() {
    const Condition additive{"visibility", {false}};
    return {
        {.key = "additive.sum",
         .label = "Sum of surfels",
         .doc = "What all surfels do to a pixel, blurred level by level and added up, before it becomes the "
                "result. Ambient occlusion: form factors, whose sum exceeds 1 where surfels hide each other, "
                "and is more than what is closed wherever they do. Light: radiance that a white Lambert "
                "surface would reflect, W/(m² sr).",
         .active_when = additive},
        {.key = "additive.levels",
         .label = "Levels",
         .kind = OutputKind::stack,
         .doc =
             "What surfels add to each pixel on each level (a layer), that is by distance, before the blur.",
         .active_when = additive},
        {.key = "additive.splatted",
         .label = "Levels in sub-images",
         .kind = OutputKind::stack,
         .doc = "The same where it was splatted: a layer per level, pixels in the sub-images of their level.",
         .active_when = additive},
        {.key = "splats.cover",
         .label = "Splats of places",
         .kind = OutputKind::stack,
         .semantic = Semantic::count,
         .doc = "Red: how many splats cover a place of the hierarchical framebuffer, which is what is paid; "
                "green: how many of them have its surface within reach. A layer for each sample and, within "
                "it, level.",
         .active_when = additive},
        {.key = "additive.explain.surfels",
         .label = "Surfels added to the pixel",
         .kind = OutputKind::glyphs,
         .doc =
             "Surfels that were added to the pixel, those that give most first; found by a search over all "
             "surfels. surfel: 1 + index; level: where it was splatted; distance: m to its centre; given: "
             "occlusion, or what a white Lambert surface reflects of its light; glossy: what microfacets "
             "do. Before the blur.",
         .when_empty = no_surface,
         .explains = true,
         .active_when = additive},
        {.key = "additive.explain.levels",
         .label = "Levels of the pixel",
         .kind = OutputKind::table,
         .doc = "For each level how many surfels were added to the pixel, and what all of them give; kept: "
                "what the framebuffer holds, which has to be the same but for rounding.",
         .when_empty = no_surface,
         .explains = true,
         .active_when = additive},
    };
}

}  // namespace ir::methods::deep_screen_space
