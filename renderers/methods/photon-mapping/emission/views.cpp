#include "renderers/methods/photon-mapping/emission/views.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/gl/dispatch_items.h"
#include "renderers/image/colour_map.h"
#include "renderers/methods/photon-mapping/emission/histogram.h"
#include "shaders/methods/photon-mapping/emission/show_samples.comp.h"

namespace ir::methods::photon_mapping {
namespace {

using graph::PassContext;

/// Elements of "emission.samples"; beyond, every n-th point is shown.
constexpr std::uint64_t max_elements = 1 << 20;
/// Points that are shown where no light is: the set as it would be.
constexpr unsigned points_without_light = 256;
/// Texels a side of "emission.points" at least, so that points stay apart.
constexpr int min_picture = 512;
/// Texels of a dot's radius at most; its dots cover about this part of the picture at most.
constexpr double max_radius = 3.5, max_covered = 0.15;

/// What is shown of the points on their way.
struct Shown {
    int source = 0;  ///< or Inspection::all
    int first_step = 0, steps = 1;
    std::uint64_t points = 0;  ///< of the frame, or of the set without light
    std::uint64_t stride = 1;  ///< odd: every other point of a radical inverse has one half
};

Shown shown_points(const Inspection& inspection, const Sources& sources, const EmissionMaps& maps,
                   const EmissionPoints& points, bool all_steps) {
    Shown shown;
    shown.source = shown_source(inspection, sources);
    const int step = inspection.item(warp_selector), count = 2 * maps.levels + 1;
    const bool all = all_steps || step == Inspection::all;
    shown.first_step = all ? 0 : std::clamp(step, 0, count - 1);
    shown.steps = all ? count : 1;
    shown.points = points.from_maps > 0 ? points.from_maps : points_without_light;
    if (!all_steps)
        while (shown.points / shown.stride * static_cast<std::uint64_t>(shown.steps) > max_elements)
            shown.stride += 2;
    return shown;
}

/// Said by the passes: they run where the points are wanted.
void note_traced(const PassContext& p, const EmissionPoints& points) {
    if (const auto traced = points.count - points.from_maps; traced > 0)
        p.notes().warn(std::to_string(traced) + " of " + std::to_string(points.count) +
                       " emission points are not in the maps shown: rays were traced for them");
}

/// Constants of steps.glsl.
struct WarpSteps {
    EmissionSets sets;
    int shown_source, first_step, step_count;
    unsigned points_without_light;
    IR_FIELDS(sets, shown_source, first_step, step_count, points_without_light)
};

WarpSteps warp_steps(const EmissionSets& sets, const Shown& shown) {
    return {sets, shown.source, shown.first_step, shown.steps, points_without_light};
}

/// Constants of show_points.comp.
struct ShowPoints {
    WarpSteps steps;
    bool survive;
    glm::vec3 colour;
    float radius;
    IR_FIELDS(steps, survive, colour, radius)
};

/// What the numbers of `field` say of points.
Categories fates(const std::string& field) {
    return {field, {{0, "the roulette ends it", tints::sky}, {1, "a photon leaves", tints::orange}}};
}

/// Constants of show_samples.comp.
struct ShowSamples {
    WarpSteps steps;
    unsigned stride, capacity;
    IR_FIELDS(steps, stride, capacity)
};

gl::ProgramSource source_of_view(const char* file, const Parameters& parameters) {
    return {{file}, {{"WARPS", parameters.emission == Emission::importance ? "1" : "0"}}};
}

void show_samples(graph::GraphBuilder& builder, const Sources& sources, const EmissionMaps& maps,
                  const EmissionPoints& points, const Parameters& parameters) {
    const auto shown = shown_points(builder.inputs().inspection, sources, maps, points, false);
    const auto steps = static_cast<std::uint64_t>(shown.steps);
    const auto elements = (shown.points + shown.stride - 1) / shown.stride * steps;
    const auto buffer = builder.output(
        "emission.samples", {.fields = record_fields<ShownSample>(), .elements = elements, .growable = true});
    const auto count = builder.counter(
        {.key = "emission.samples_shown", .label = "Emission points shown", .growth_of = buffer});
    const auto source = source_of_view("methods/photon-mapping/emission/show_samples.comp", parameters);
    const auto constants = warp_steps(emission_sets(builder.inputs(), sources, points, parameters), shown);
    builder.pass("show emission points")
        .reads("Sources", points.samples.sources)
        .reads("Candidates", points.candidates)
        .reads("probability_map", maps.probability)
        .reads("haar_pyramid", maps.haar)
        .writes("Shown", buffer)
        .counts("ShownCount", count)
        .execute([=](PassContext& p) {
            note_traced(p, points);
            if (shown.stride > 1)  // said by the pass: it runs where points are wanted
                p.notes().warn("of the emission points shown, one in " + std::to_string(shown.stride) +
                               " is, so that at most a million result");
            const auto& program = p.use(source);
            program.set(ShowSamples{constants, static_cast<unsigned>(shown.stride),
                                    static_cast<unsigned>(p.capacity(buffer))});
            gl::dispatch_items(program, 0, static_cast<std::int64_t>(shown.points));
        });
}

void show_picture(graph::GraphBuilder& builder, const Sources& sources, const EmissionMaps& maps,
                  const EmissionPoints& points, const Parameters& parameters) {
    auto shown = shown_points(builder.inputs().inspection, sources, maps, points, true);
    shown.source = std::max(0, shown.source);
    const int size = std::max(min_picture, maps.resolution);
    const auto image = builder.output(
        "emission.points",
        {.format = gl::Format::rgba16f, .extent = graph::Extent::fixed(size, size), .layers = shown.steps});
    const auto map_source = source_of_view("methods/photon-mapping/emission/show_map.comp", parameters);
    const auto dots_source = source_of_view("methods/photon-mapping/emission/show_points.comp", parameters);
    const auto constants = warp_steps(emission_sets(builder.inputs(), sources, points, parameters), shown);
    builder.pass("draw emission points")
        .reads("Sources", points.samples.sources)
        .reads("Candidates", points.candidates)
        .reads("probability_map", maps.probability)
        .reads("haar_pyramid", maps.haar)
        .writes("picture", image)
        .execute([=](PassContext& p) {
            note_traced(p, points);
            const auto& map = p.use(map_source);
            map.set(constants);
            map.dispatch(size, size, shown.steps);
            p.barrier();
            const auto& dots = p.use(dots_source);
            const double area =
                double(size) * size * max_covered / double(std::max<std::uint64_t>(1, shown.points));
            const auto radius = std::min(max_radius, std::sqrt(area / pi));
            // One colour after the other: where dots meet, the order of points does not show.
            for (const auto& fate : fates("").values) {
                dots.set(ShowPoints{constants, fate.value == 1, linear_from_srgb(fate.colour),
                                    static_cast<float>(radius)});
                gl::dispatch_items(dots, 0, static_cast<std::int64_t>(shown.points));
                p.barrier();
            }
        });
}

void show_histogram(graph::GraphBuilder& builder, const Sources& sources, const EmissionMaps& maps,
                    const EmissionPoints& points, const Parameters& parameters) {
    const auto shown = shown_points(builder.inputs().inspection, sources, maps, points, false);
    const int source = std::max(0, shown.source);
    const auto table = builder.output(
        "emission.histogram",
        {.fields = record_fields<HistogramCell>(), .elements = histogram_cells * histogram_cells + 1});
    const bool warps = parameters.emission == Emission::importance;
    builder.pass("emission histogram", graph::Queue::cpu)
        .reads(maps.probability, points.candidates)
        .writes(table)
        .execute([=](PassContext& p) {
            note_traced(p, points);
            const auto texels = texels_of(p.elements<const std::uint32_t>(points.candidates),
                                          points.from_maps, source, maps.resolution);
            const auto drawn = p.pixels<const float>(maps.probability, source);
            const std::vector<float> map = warps ? std::vector<float>(drawn.begin(), drawn.end())
                                                 : std::vector<float>(drawn.size(), 1.0f);
            const auto cells = histogram(map, maps.resolution, texels);
            std::ranges::copy(cells, p.elements<HistogramCell>(table).begin());
        });
}

}  // namespace

int shown_source(const Inspection& inspection, const Sources& sources) {
    const int source = inspection.item(source_selector);
    const int last = std::max(0, static_cast<int>(sources.layers.size()) - 1);
    return source == Inspection::all ? source : std::clamp(source, 0, last);
}

std::vector<std::uint32_t> texels_of(std::span<const std::uint32_t> candidates, std::uint64_t count,
                                     int source, int resolution) {
    std::vector<std::uint32_t> texels;
    for (const auto word : candidates.first(std::min<std::size_t>(candidates.size(), count)))
        if ((word >> 20 & 63) == static_cast<std::uint32_t>(source))
            texels.push_back((word & 1023) + static_cast<std::uint32_t>(resolution) * (word >> 10 & 1023));
    return texels;
}

void show_emission(graph::GraphBuilder& builder, const Sources& sources, const EmissionMaps& maps,
                   const EmissionPoints& points, const Parameters& parameters) {
    show_samples(builder, sources, maps, points, parameters);
    show_picture(builder, sources, maps, points, parameters);
    show_histogram(builder, sources, maps, points, parameters);
}

std::vector<OutputDescription> view_outputs() {
    return {
        {.key = "emission.samples",
         .label = "Warping of points",
         .kind = OutputKind::point_set,
         .semantic = Semantic::position,
         .doc = "The emission set of the map chosen in the unit square, upright, before (warp 0) and after "
                "each step of warping: horizontally (odd) and vertically (even) in turns, from the whole map "
                "to texels. All steps stand side by side, maps below each other. probability: of the texel "
                "that the point comes to.",
         .categories = {fates("survives")},
         .explains = true,
         .active_when = from_rsm()},
        {.key = "emission.points",
         .label = "Points over the map",
         .kind = OutputKind::stack,
         .semantic = Semantic::albedo,
         .doc =
             "The map chosen (of all maps the first), as coarse as each step of warping sees it, with a dot "
             "for each point of the emission set. Layer 0: before warping; then horizontally and "
             "vertically in turns.",
         .categories = {fates("")},
         .explains = true,
         .active_when = from_rsm()},
        {.key = "emission.histogram",
         .label = "Points against the map",
         .kind = OutputKind::table,
         .doc = "In 16 x 16 cells of the map chosen (of all maps the first) the number of points that its "
                "emission probabilities expect, and that were found. The last row (x and y are -1) is the "
                "sum: all points, chi square with cells below 5 expected points pooled, and its degrees of "
                "freedom. A low-discrepancy set stays far below them.",
         .explains = true,
         .active_when = from_rsm()}};
}

std::vector<SelectorDescription> emission_selectors() {
    return {
        {.key = source_selector,
         .label = "Map of a light",
         .doc = "The layer of the reflective shadow map whose emission points are shown. Lights without a "
                "layer have none: rectangles, disks, emissive surfaces, the environment, and point, spot "
                "and directional lights beyond 64 layers.",
         .count = max_layers},
        {.key = warp_selector,
         .label = "Step of warping",
         .doc = "0: the emission set as it is; then horizontally and vertically in turns, from the whole "
                "map to its texels.",
         .count = 21}};
}

}  // namespace ir::methods::photon_mapping
