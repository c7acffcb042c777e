#include "renderers/methods/deep-screen-space/benchmark.h"

namespace ir::methods::deep_screen_space {
namespace {

using Column = graph::BenchmarkColumn;
using Passes = std::vector<std::string>;

/// What the paper counts; not G-buffer, shadow maps, direct light and uploads. The bounds of positions, which
/// cull splats, belong to shuffling, the framebuffer's layout too.
const Passes tessellation{"cull *",          "split *",       "count surfels",
                          "fine surfels",    "thin surfels",  "pack surfels",
                          "order triangles", "place surfels", "count stored surfels",
                          "shade surfels",   "surfels.*"};
const Passes shuffling{"framebuffer layout", "shuffle", "bounds of positions", "directions"};
const Passes splatting{"splat"};
const Passes unshuffling{"combine levels", "unshuffle*"};
const Passes reduction{"visibility", "light of the winners", "add levels*"};
const Passes blurring{"reconstruction", "blur*"};

Column time(const char* label, const char* doc, const Passes& passes) {
    return {.label = label, .unit = "ms", .doc = doc, .source = Column::PassTime{passes}};
}
Column bytes(const char* label, const char* doc, const Passes& resources) {
    return {.label = label, .unit = "B", .doc = doc, .source = Column::ResourceBytes{resources}};
}
Column count(const char* label, const char* doc, const char* key) {
    return {.label = label, .doc = doc, .source = Column::Counter{key}, .best = Column::Best::none};
}

std::vector<Column> columns() {
    return {
        time("Tessellation", "Culling, splitting, placing, thinning and shading surfels.", tessellation),
        time("Shuffling", "Layout, shuffled positions, their bounds, and directions.", shuffling),
        time("Splatting", "All surfels onto all levels and samples.", splatting),
        time("Unshuffling", "The finest level with a hit, at each pixel.", unshuffling),
        time("Reduction", "What the samples met becomes visibility or light.", reduction),
        time("Blurring", "Reconstruction from the samples of neighbours.", blurring),
        time("Total", "The stages before.", {}),
        count("Patches", "Triangles and parts of triangles that are tessellated.", "surfels.patches"),
        count("Fine", "Surfels before thinning.", "surfels.fine"),
        count("Surfels", "After thinning.", "surfels.kept"),
        bytes("MIP", "Pyramids of the minimum and maximum positions.", {"hierarchy.min", "hierarchy.max"}),
        bytes("Layout", "Lookup images of shuffling and unshuffling.",
              {"hierarchy.layout", "hierarchy.places"}),
        bytes("Positions", "Shuffled positions.", {"hierarchy.positions"}),
        bytes("Directions", "The direction buffer.", {"bounce.directions"}),
        bytes("Layers", "Depth and winner for each sample and level.", {"splats.depth", "splats.winner"}),
        bytes("Surfel buffers", "Before and after thinning.", {"surfels", "surfels.fine"}),
        graph::memory_column(),
    };
}

/// Half the published 768 × 512 each way, so that a processor can draw it; `--size 768x512` is the paper's.
graph::Benchmark on(const char* name, const char* doc, const char* scene) {
    graph::Benchmark benchmark;
    benchmark.name = name;
    benchmark.doc = doc;
    benchmark.scene = scene;
    benchmark.width = 384;
    benchmark.height = 256;
    benchmark.columns = columns();
    for (const auto& part : {tessellation, shuffling, splatting, unshuffling, reduction, blurring})
        benchmark.total_of.insert(benchmark.total_of.end(), part.begin(), part.end());
    return benchmark;
}

const Settings of_light{{"paths", std::string("full")}, {"max_distance", 0.0}};

/// All is within the first shell.
constexpr const char* exact_rays = "exact rays in place of discs";
const Settings all_exact{{"trade_off", 1e-6}};

Settings with(Settings settings, const char* key, Value value) {
    settings[key] = std::move(value);
    return settings;
}

}  // namespace

std::vector<graph::Benchmark> benchmarks() {
    auto graveyard = on("deep-screen-space-graveyard", "Stages, counts and memory of ambient occlusion",
                        "builtin:graveyard");
    graveyard.variants = {{"with visibility", {}},
                          {"without culled splats", {{"splat_culling", false}}},
                          {"full discs in place of shells", {{"shells", std::string("full-discs")}}},
                          {exact_rays, all_exact},
                          {"surfels of 2014", {{"placement", std::string("barycentric")}}},
                          {"without visibility", {{"visibility", false}}}};
    auto still_life = on("deep-screen-space-still-life",
                         "Stages, counts and memory of one bounce among glossy things", "builtin:still-life");
    still_life.variants = {{"with visibility", of_light},
                           {exact_rays, with(of_light, "trade_off", all_exact.at("trade_off"))},
                           {"without visibility", with(of_light, "visibility", false)}};
    auto dominoes = on("deep-screen-space-dominoes",
                       "Stages, counts and memory of one bounce on a polished floor", "builtin:dominoes");
    dominoes.variants = still_life.variants;
    auto growth = on("deep-screen-space-growth", "What grows with surfels, levels, samples and resolution",
                     "builtin:graveyard");
    growth.variants = {{"the defaults", {}},
                       {"surfels of 3 px", {{"surfel_radius", 3.0}}},
                       {"surfels of 0.75 px", {{"surfel_radius", 0.75}}},
                       {"2 levels", {{"levels", std::int64_t{2}}}},
                       {"4 levels", {{"levels", std::int64_t{4}}}},
                       {"1 sample", {{"samples", std::int64_t{1}}}},
                       {"16 samples", {{"samples", std::int64_t{16}}}},
                       {.label = "half the resolution", .settings = {}, .scale = 0.5f},
                       {.label = "twice the resolution", .settings = {}, .scale = 2}};
    return {graveyard, still_life, dominoes, growth};
}

}  // namespace ir::methods::deep_screen_space
