#include <algorithm>
#include <tuple>

#include "renderers/gl/dispatch_items.h"
#include "renderers/methods/deep-screen-space/splatting/additive.h"
#include "shaders/methods/deep-screen-space/splatting/explain_additive.comp.h"

namespace ir::methods::deep_screen_space {
namespace {

constexpr std::uint64_t expected_shares = 4096;

/// Constants of explain_additive.comp.
struct ExplainAdditive {
    InfluenceConstants influence;
    SphereBounds bounds;
    ShareConstants share;
    unsigned seed;
    int levels;
    glm::ivec2 hierarchy_size, picked;
    bool stratified_sub_images;
    IR_FIELDS(influence, bounds, share, seed, levels, hierarchy_size, picked, stratified_sub_images)
};

void search(const graph::PassContext& p, graph::Slice slice, const Additive& additive) {
    const auto& splats = additive.splats;
    gl::ProgramSource source{
        {folder + "explain_additive.comp"},
        {{"KEPT", additive.is_light() ? "rgb" : "xxx"}, {"DARK_IS_IDLE", splats.dark_is_idle() ? "1" : "0"}}};
    const auto& program = p.use(with_share(std::move(source), additive));
    program.set(
        ExplainAdditive{.influence = influence_constants(splats),
                        .bounds = sphere_bounds(p.inputs().view),
                        .share = share_constants(p.inputs(), additive),
                        .seed = random_seed(p.inputs(), splats.parameters),
                        .levels = splats.hierarchy.levels,
                        .hierarchy_size = {splats.hierarchy.width, splats.hierarchy.height},
                        .picked = p.inputs().picked_pixel(),
                        .stratified_sub_images = splats.parameters.sub_images == SubImages::stratified});
    const auto capacity = static_cast<std::int64_t>(p.capacity(splats.surfels.records));
    gl::dispatch_items(program, capacity * slice.begin / surfel_parts, capacity * slice.end / surfel_parts);
}

float amount(const AdditiveShare& share) {
    float sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += share.given[c] + share.glossy[c];
    return sum;
}

/// Largest first, and what all of a level give.
void add_up(std::span<AdditiveShare> shares, std::span<AdditiveLevel> levels) {
    std::size_t count = 0;
    for (const auto& level : levels) count += level.surfels;
    shares = shares.first(std::min(count, shares.size()));
    std::ranges::sort(shares, [](const auto& a, const auto& b) {
        return std::tuple(-amount(a), a.level, a.surfel) < std::tuple(-amount(b), b.level, b.surfel);
    });
    for (auto& level : levels) std::ranges::fill(level.given, 0.0f);
    for (const auto& share : shares)
        for (std::size_t c = 0; c < 3; ++c) levels[share.level].given[c] += share.given[c];
}

}  // namespace

void explain_additive(graph::GraphBuilder& builder, const Additive& additive) {
    const auto declare = [&](const std::string& what, std::vector<graph::Field> fields,
                             std::uint64_t elements) {
        return builder.explanation("additive.explain." + what,
                                   {.fields = std::move(fields), .elements = elements, .cleared = true});
    };
    const auto shares = declare("surfels", record_fields<AdditiveShare>(), expected_shares);
    const auto levels = declare("levels", record_fields<AdditiveLevel>(),
                                static_cast<std::uint64_t>(additive.splats.hierarchy.levels));
    auto pass = builder.pass("explain what surfels add");
    additive.receivers.declare_reads(pass);
    if (additive.is_light()) pass.reads("SurfelLights", additive.splats.surfels.lights);
    if (additive.has_highlights()) additive.senders.read_by(pass);
    pass.reads("Surfels", additive.splats.surfels.records)
        .reads("Stored", additive.splats.surfels.stored)
        .reads("places", additive.splats.hierarchy.places)
        .reads("splatted", additive.splatted)
        .writes("Shares", shares.elements)
        .writes("Levels", levels.elements)
        .counts("ShareCount", shares.count)
        .counts("LevelCount", levels.count)
        .execute_sliced(surfel_parts,
                        [=](graph::PassContext& p, graph::Slice slice) { search(p, slice, additive); });
    builder.pass("add up what surfels add", graph::Queue::cpu)
        .reads(shares.elements, levels.elements)
        .writes(shares.elements, levels.elements)
        .execute([=](graph::PassContext& p) {
            add_up(p.elements<AdditiveShare>(shares.elements), p.elements<AdditiveLevel>(levels.elements));
        });
}

}  // namespace ir::methods::deep_screen_space
