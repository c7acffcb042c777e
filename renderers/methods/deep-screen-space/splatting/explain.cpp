#include "renderers/methods/deep-screen-space/splatting/explain.h"

#include <algorithm>
#include <tuple>

#include "renderers/gl/dispatch_items.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::methods::deep_screen_space {
namespace {

/// LESS in the order of the surfels.
void keep_nearest(const SplatCandidate& candidate, LevelSum& sum) {
    const bool nearer =
        sum.found == 0 || std::tuple(candidate.z, candidate.surfel) < std::tuple(sum.found_z, sum.found);
    if (!nearer) return;
    sum.found = candidate.surfel;
    sum.found_z = candidate.z;
}

void mark_deciding(std::span<LevelSum> sums, int levels, bool nearest_decides) {
    for (std::size_t first = 0; first < sums.size(); first += static_cast<std::size_t>(levels)) {
        LevelSum* deciding = nullptr;
        for (auto& sum : sums.subspan(first, static_cast<std::size_t>(levels)))
            if (sum.found != 0 && (!deciding || (nearest_decides && sum.found_z < deciding->found_z)))
                deciding = &sum;
        if (deciding) deciding->nearest = 1;
    }
}

}  // namespace

void judge(std::span<SplatCandidate> candidates, std::span<LevelSum> sums, int levels, bool nearest_decides) {
    const auto sum_of = [&](const SplatCandidate& c) -> LevelSum& {
        return sums[c.sample * static_cast<std::size_t>(levels) + c.level];
    };
    for (auto& sum : sums) sum.found_z = 1;
    for (const auto& c : candidates)
        if (c.outcome == SplatOutcome::hit) keep_nearest(c, sum_of(c));
    mark_deciding(sums, levels, nearest_decides);
    for (auto& c : candidates)
        if (c.outcome == SplatOutcome::hit && sum_of(c).found == c.surfel)
            c.outcome = sum_of(c).nearest ? SplatOutcome::wins : SplatOutcome::level;
    std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return std::tuple(a.sample, b.outcome, a.level, a.z, a.surfel) <
               std::tuple(b.sample, a.outcome, b.level, b.z, b.surfel);
    });
}

namespace {

constexpr std::uint64_t expected_candidates = 4096;

/// Candidates and sums are first what the device found, and then what the host made of it: buffers of their
/// own in between would be kept where their keys are asked for, and the explanation of another pixel would
/// find them done.
graph::CountedBuffer declare(graph::GraphBuilder& builder, const std::string& what,
                             std::vector<graph::Field> fields, std::uint64_t elements) {
    return builder.explanation("splats.explain." + what,
                               {.fields = std::move(fields), .elements = elements, .cleared = true});
}

void dispatch_surfels(const graph::PassContext& p, const gl::Program& program, const Splats& splats,
                      graph::Slice slice) {
    const auto capacity = static_cast<std::int64_t>(p.capacity(splats.surfels.records));
    gl::dispatch_items(program, capacity * slice.begin / surfel_parts, capacity * slice.end / surfel_parts);
}

/// Constants of explain_splat.glsl.
struct ExplainSplat {
    VisibleLevel level;
    SphereBounds bounds;
    unsigned seed;
    int levels, samples, first_sample;
    glm::ivec2 hierarchy_size;
    bool stratified_sub_images;
    IR_FIELDS(level, bounds, seed, levels, samples, first_sample, hierarchy_size, stratified_sub_images)
};

ExplainSplat explain_splat(const graph::FrameInputs& inputs, const Splats& splats) {
    return {.level = visible_level(splats),
            .bounds = sphere_bounds(inputs.view),
            .seed = random_seed(inputs, splats.parameters),
            .levels = splats.hierarchy.levels,
            .samples = splats.samples,
            .first_sample = splats.first_sample,
            .hierarchy_size = {splats.hierarchy.width, splats.hierarchy.height},
            .stratified_sub_images = splats.parameters.sub_images == SubImages::stratified};
}

/// Constants of explain_pixel.comp.
struct ExplainPixel {
    ExplainSplat splat;
    glm::ivec2 picked;
    IR_FIELDS(splat, picked)
};

/// Constants of explain_choice.comp.
struct ExplainChoice {
    glm::ivec2 picked;
    unsigned chosen;
    IR_FIELDS(picked, chosen)
};

void read_splats(graph::PassBuilder& pass, const VisibleSplats& visible) {
    pass.reads("Surfels", visible.splats.surfels.records)
        .reads("Stored", visible.splats.surfels.stored)
        .reads("places", visible.splats.hierarchy.places)
        .reads(visible.gbuffer.position)
        .reads("directions", visible.directions.directions)
        .reads(visible.gbuffer.geometric_normal)
        .reads("winners", visible.winner);
    read_acceptance(pass, visible);
}

void search(const graph::PassContext& p, graph::Slice slice, const VisibleSplats& visible) {
    const auto& program = p.use(with_acceptance({{folder + "explain_pixel.comp"}}, visible.splats));
    program.set(ExplainPixel{explain_splat(p.inputs(), visible.splats), p.inputs().picked_pixel()});
    dispatch_surfels(p, program, visible.splats, slice);
}

void judge_found(const graph::PassContext& p, const graph::CountedBuffer& candidates,
                 const graph::CountedBuffer& levels, const Splats& splats, int all_samples) {
    const int level_count = splats.hierarchy.levels;
    const auto rows = static_cast<std::size_t>(all_samples * level_count);
    const auto all_sums = p.elements<LevelSum>(levels.elements);
    if (all_sums.size() < rows) return;  // it grows
    const auto sums = all_sums.first(rows);
    const auto found = p.elements<SplatCandidate>(candidates.elements);
    std::size_t count = 0;
    for (const auto& sum : sums) count += std::size_t{sum.missed} + sum.too_far + sum.refused + sum.hits;
    judge(found.first(std::min(found.size(), count)), sums, level_count, nearest_decides(splats));
}

void explain_pixel(graph::GraphBuilder& builder, const SplatExplanation& explanation,
                   const VisibleSplats& visible, const std::string& batch) {
    auto pass = builder.pass("explain splats onto the pixel" + batch);
    read_splats(pass, visible);
    pass.reads("depths", visible.depth)
        .writes("Candidates", explanation.candidates.elements)
        .writes("Sums", explanation.levels.elements)
        .counts("CandidateCount", explanation.candidates.count)
        .counts("SumCount", explanation.levels.count)
        .execute_sliced(surfel_parts,
                        [=](graph::PassContext& p, graph::Slice slice) { search(p, slice, visible); });
}

graph::BufferRef choose_surfel(graph::GraphBuilder& builder, const VisibleSplats& visible) {
    const auto choice = builder.output(
        "splats.explain.choice",
        {.fields = {{"closeness"}, {"surfel", graph::FieldType::u32}}, .elements = 1, .cleared = true});
    for (const char* find : {"1", "2"})
        builder.pass(std::string("choose the surfel, step ") + find)
            .reads("Surfels", visible.splats.surfels.records)
            .reads("Stored", visible.splats.surfels.stored)
            .reads(visible.gbuffer.position)
            .writes("Choice", choice)
            .execute_sliced(surfel_parts, [=](graph::PassContext& p, graph::Slice slice) {
                gl::ProgramSource source{{folder + "explain_choice.comp"}};
                source.defines["FIND"] = find;
                const auto& program = p.use(source);
                program.set(
                    ExplainChoice{p.inputs().picked_pixel(),
                                  static_cast<unsigned>(std::max(0, p.inputs().inspection.item("surfel")))});
                dispatch_surfels(p, program, visible.splats, slice);
            });
    return choice;
}

void explain_surfel(graph::GraphBuilder& builder, const SplatExplanation& explanation,
                    const VisibleSplats& visible, const std::string& batch) {
    auto pass = builder.pass("explain splats of the surfel" + batch);
    read_splats(pass, visible);
    pass.reads("Choice", explanation.choice)
        .reads("hit_levels", visible.hit_level)
        .writes("Sums", explanation.surfel.elements)
        .writes("cover_image", explanation.cover)
        .counts("SumCount", explanation.surfel.count);
    passes::bounce::compute_by_tiles(pass, builder,
                                     with_acceptance({{folder + "explain_surfel.comp"}}, visible.splats),
                                     explain_splat(builder.inputs(), visible.splats));
}

}  // namespace

SplatExplanation declare_explanation(graph::GraphBuilder& builder, const VisibleSplats& visible,
                                     int all_samples) {
    const int levels = visible.splats.hierarchy.levels;
    SplatExplanation result;
    result.candidates = declare(builder, "candidates", record_fields<SplatCandidate>(), expected_candidates);
    result.levels = declare(builder, "levels", record_fields<LevelSum>(),
                            static_cast<std::uint64_t>(all_samples * levels));
    result.surfel =
        declare(builder, "surfel", record_fields<SurfelSum>(), static_cast<std::uint64_t>(levels));
    result.choice = choose_surfel(builder, visible);
    result.cover = builder.output("splats.explain.cover", {.format = gl::Format::r16f, .layers = levels});
    return result;
}

void explain_splats(graph::GraphBuilder& builder, const SplatExplanation& explanation,
                    const VisibleSplats& visible, const passes::bounce::Batch& batch) {
    auto of_batch = visible;
    of_batch.splats.samples = batch.samples;
    of_batch.splats.first_sample = batch.first;
    explain_pixel(builder, explanation, of_batch, batch.name);
    explain_surfel(builder, explanation, of_batch, batch.name);
}

void judge_splats(graph::GraphBuilder& builder, const SplatExplanation& explanation,
                  const VisibleSplats& visible, int all_samples) {
    const auto candidates = explanation.candidates, levels = explanation.levels;
    builder.pass("judge splats onto the pixel", graph::Queue::cpu)
        .reads(candidates.elements, levels.elements)
        .writes(candidates.elements, levels.elements)
        .execute([=, splats = visible.splats](graph::PassContext& p) {
            judge_found(p, candidates, levels, splats, all_samples);
        });
}

namespace {

/// By SplatOutcome.
const std::vector<Category> outcomes{
    {0, "does not cover the pixel", tints::dark},
    {1, "the pixel's point lies in no shell of the level", tints::grey},
    {2, "the ray misses the disc", tints::sky},
    {3, "met beyond the maximum distance", tints::blue},
    {4, "does not count for the pixel, by discs, borders, backs or level 0", tints::purple},
    {5, "met, something is nearer on this level", tints::yellow},
    {6, "nearest on its level, another level decides", tints::vermilion},
    {7, "what the ray met", tints::green}};

}  // namespace

std::vector<OutputDescription> explanation_outputs() {
    std::vector<OutputDescription> outputs = {
        {.key = "splats.explain.candidates",
         .label = "Splats onto the pixel",
         .kind = OutputKind::glyphs,
         .doc = "Discs, as large as they were tested, of surfels that were splatted onto the pixel; found by "
                "a search over all surfels, and those of outcome 1 left out. surfel: 1 + index; sample, "
                "level: where it was splatted; shell: which its disc was enlarged for. "
                "distance: m along the ray to the disc's plane; z: what the depth test compares.",
         .categories = {{"outcome", outcomes}},
         .when_empty = no_surface,
         .explains = true},
        {.key = "splats.explain.levels",
         .label = "Levels of the pixel",
         .kind = OutputKind::table,
         .doc = "For each sample and level how many splats covered the pixel, and how many of them had which "
                "outcome (hits: 5 to 7). found: 1 + index of the nearest by the search, with its z; kept: "
                "what the framebuffer holds, which has to be the same. nearest: 1 on the level whose hit "
                "counts.",
         .when_empty = no_surface,
         .explains = true},
        {.key = "splats.explain.choice",
         .label = "Surfel explained",
         .kind = OutputKind::table,
         .doc = "surfel: 1 + index of the surfel that was chosen, or else of the one nearest to the picked "
                "pixel's point, with 1 / distance² in 1/m²; 0: none.",
         .explains = true},
        {.key = "splats.explain.surfel",
         .label = "Splats of the surfel",
         .kind = OutputKind::glyphs,
         .doc = "The chosen surfel's disc, as large as each level tests it in its own shell, and how many "
                "rays of the picture, of all samples, its splat on that level covered, met, and won on the "
                "level and in the end.",
         .explains = true},
        {.key = "splats.explain.cover",
         .label = "Where the surfel was splatted",
         .kind = OutputKind::stack,
         .doc =
             "What became of the chosen surfel's splat on each pixel, a layer per level; of all samples the "
             "outcome that went farthest.",
         .categories = {{"", outcomes}},
         .explains = true},
    };
    for (auto& output : outputs) output.active_when = {"visibility", {true}};
    return outputs;
}

SelectorDescription surfel_selector() {
    return {.key = "surfel",
            .label = "Surfel",
            .doc =
                "1 + index of a surfel, as winners are numbered. 0, or all: the one nearest to the picked "
                "pixel's point.",
            .count = 1 << 24};
}

}  // namespace ir::methods::deep_screen_space
