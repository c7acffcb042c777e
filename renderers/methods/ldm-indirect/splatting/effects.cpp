// What each direction does to the picture, and to the pixel that a person picks.
#include <algorithm>

#include "renderers/core/record.h"
#include "renderers/image/luminance.h"
#include "renderers/methods/ldm-indirect/splatting/found.h"
#include "renderers/methods/ldm-indirect/splatting/host/leave_out.h"
#include "renderers/methods/ldm-indirect/splatting/stored.h"
#include "renderers/passes/ldm/effect_pixels.h"

namespace ir::methods::ldm_indirect {
namespace {

namespace ldm = passes::ldm;

/// Of a picture: each contribution is weighed for all maps.
constexpr int most_weighed = 1 << 18;
/// That are reserved for each pixel.
constexpr std::uint64_t expected_contributions = 1024;

/// Constants of contributions.comp.
struct FindContributions {
    Outlines outlines;
    ldm::EffectPixels pixels;
    IR_FIELDS(outlines, pixels)
};

ldm::EffectPixels grid_of(const graph::FrameInputs& inputs, const Parameters& parameters) {
    return ldm::effect_grid(inputs.view, most_weighed / parameters.maps.directions);
}

/// What photons add to the pixels of the grid.
struct Contributions {
    graph::BufferRef elements, found;
};

Contributions find_contributions(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                                 const StoredPhotons& photons) {
    const auto pixels = static_cast<std::uint64_t>(grid_of(builder.inputs(), photons.parameters).count());
    graph::BufferDesc desc;
    desc.text = {.key = "indirect.contributions",
                 .label = "Contributions of photons",
                 .doc = "Luminance that each photon adds to pixels of a grid, W/m²."};
    desc.fields = record_fields<Contribution>();
    desc.elements = pixels * expected_contributions;
    desc.growable = true;
    const Contributions result{
        builder.buffer(std::move(desc)),
        builder.buffer({.text = {.key = "indirect.contributions_found", .label = "Contributions found"},
                        .fields = {{"count", graph::FieldType::u32}},
                        .elements = 1,
                        .cleared = true})};
    const auto count = builder.counter({.key = "indirect.contribution_count",
                                        .label = "Contributions to pixels of a grid",
                                        .growth_of = result.elements});
    auto pass = builder.pass("find contributions");
    reads_footprints(pass, photons);
    reads_looks(pass, photons);
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal)
        .writes("Contributions", result.elements)
        .writes("Found", result.found)
        .counts("ContributionCount", count)
        .execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            gl::ProgramSource source{{folder + "contributions.comp"}};
            define_clipped(source, photons);
            const auto& program = p.use(source);
            program.set(
                FindContributions{outlines(p.inputs(), photons), grid_of(p.inputs(), photons.parameters)});
            set_units(p, program, photons);
            passes::dispatch_photons(p, program, photons, slice);
        });
    return result;
}

/// Pixels of the grid that show a surface.
std::size_t surfaces_of(std::span<const glm::vec4> geometric_normal, const scene::View& view,
                        const ldm::EffectPixels& grid) {
    std::size_t count = 0;
    for (int y = 0; y < grid.cells.y; ++y)
        for (int x = 0; x < grid.cells.x; ++x) {
            const auto pixel = glm::min(grid.first_pixel + grid.pixel_step * glm::ivec2(x, y),
                                        glm::ivec2(view.width, view.height) - 1);
            const auto place = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(view.width) +
                               static_cast<std::size_t>(pixel.x);
            count += glm::vec3(geometric_normal[place]) != glm::vec3(0);
        }
    return count;
}

std::vector<Contribution> contributions_of(std::span<const FoundPhoton> found) {
    std::vector<Contribution> result;
    for (const auto& p : found)
        if (p.side != 0)
            result.push_back({0, p.source, p.map | (p.side > 0 ? leg_along : 0u),
                              luminance(p.contribution[0], p.contribution[1], p.contribution[2])});
    return result;
}

std::string effect_doc(const std::string& of, const std::string& more) {
    return "By how much the luminance of the splatted irradiance changes " + of +
           " where one direction is left out, and the others carry its light. effect: root of the mean "
           "square. change: mean; above 0, it would be brighter without. centre: where its light comes "
           "from. " +
           more;
}

}  // namespace

void show_effects(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
                  const Splat& splat, const PixelPhotons& pixel, const Parameters& parameters) {
    const auto stored = splatted_photons(photons, splat, parameters);
    const auto found = find_contributions(builder, gbuffer, stored);
    const ldm::Options maps = parameters.maps;
    const auto directions = 2 * static_cast<std::uint64_t>(maps.directions);
    const auto of_picture = builder.output(
        "indirect.effects", {.fields = record_fields<DirectionEffect>(), .elements = directions});
    builder.pass("effects of directions", graph::Queue::cpu)
        .reads(found.elements, found.found, photons.primaries, gbuffer.geometric_normal)
        .writes(of_picture)
        .execute([=](graph::PassContext& p) {
            const auto all = p.elements<const Contribution>(found.elements);
            const auto count =
                std::min<std::size_t>(all.size(), p.elements<const std::uint32_t>(found.found)[0]);
            const auto pixels = surfaces_of(p.pixels<const glm::vec4>(gbuffer.geometric_normal),
                                            p.inputs().view, grid_of(p.inputs(), parameters));
            const auto effects = effects_of_leaving_out(
                {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)}, pixels,
                p.elements<const Primary>(photons.primaries), maps, p.inputs().threads);
            std::ranges::copy(effects, p.elements<DirectionEffect>(of_picture).begin());
        });
    const auto of_pixel = builder.explanation(
        "indirect.explain.effects", {.fields = record_fields<DirectionEffect>(), .elements = directions},
        {.key = "indirect.explain.effect_count", .label = "Effects explained"});
    builder.pass("effects of directions of a pixel", graph::Queue::cpu)
        .reads(pixel.photons, pixel.sum, photons.primaries)
        .writes(of_pixel.elements)
        .counts(of_pixel.count)
        .execute([=](graph::PassContext& p) {
            const auto all = contributions_of(found_photons(p, pixel));
            if (all.empty()) return;
            const auto effects = effects_of_leaving_out(all, 1, p.elements<const Primary>(photons.primaries),
                                                        maps, p.inputs().threads);
            std::ranges::copy(effects, p.elements<DirectionEffect>(of_pixel.elements).begin());
            p.add(of_pixel.count, static_cast<std::uint32_t>(effects.size()));
        });
}

std::vector<OutputDescription> effect_outputs() {
    return {{.key = "indirect.effects",
             .label = "Effect of each direction",
             .kind = OutputKind::sphere_values,
             .unit = "W/m²",
             .doc = effect_doc("over the picture", "Large pictures are sampled at a grid of at most " +
                                                       std::to_string(ldm::most_effect_pixels) +
                                                       " pixels, fewer with many maps."),
             .categories = {side_categories()}},
            {.key = "indirect.explain.effects",
             .label = "Effect of each direction on the pixel",
             .kind = OutputKind::sphere_values,
             .unit = "W/m²",
             .doc = effect_doc("at the pixel", "Light that comes directly stays."),
             .categories = {side_categories()},
             .when_empty = std::string(no_surface) + ", or no surface lights it",
             .explains = true}};
}

}  // namespace ir::methods::ldm_indirect
