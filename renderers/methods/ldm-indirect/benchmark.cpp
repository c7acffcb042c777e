#include "renderers/methods/ldm-indirect/stages.h"

namespace ir::methods::ldm_indirect {
namespace {

using Column = graph::BenchmarkColumn;

/// What the paper counts as construction, tracing and splatting; not G-buffer, direct light and uploads.
const std::vector<std::string> construction{"map frames*", "meshlets", "build maps*"};
const std::vector<std::string> tracing{"RSM*",
                                       "emit photons",
                                       "begin photons",
                                       "see primary photons",
                                       "store primary photons",
                                       "trace photons*",
                                       "indirect.part* sums",
                                       "indirect.part* bases",
                                       "indirect.part* places",
                                       "store photons*"};
const std::vector<std::string> packing{"indirect.part* sums", "indirect.part* bases", "indirect.part* places",
                                       "store photons*"};
const std::vector<std::string> splatting{"splat photons*",        "stored photons",
                                         "measure footprints",    "upload arrivals",
                                         "atomic sums",           "count photons of bins*",
                                         "list photons of bins*", "gather photons of tiles*",
                                         "splat.bins*",           "make kernels"};

struct Setting {
    int directions = 128, resolution = 200, emission = 32;
};

graph::Benchmark::Variant variant(std::string label, const Setting& setting) {
    return {std::move(label),
            {{"directions", std::int64_t{setting.directions}},
             {"resolution", std::int64_t{setting.resolution}},
             {"emission", std::int64_t{setting.emission}},
             {"gloss", std::string("none")}}};
}

graph::Benchmark in_atrium(const char* name, const char* doc, int width, int height) {
    graph::Benchmark benchmark;
    benchmark.name = name;
    benchmark.doc = doc;
    benchmark.width = width;
    benchmark.height = height;
    for (const auto& part : {construction, tracing, splatting})
        benchmark.total_of.insert(benchmark.total_of.end(), part.begin(), part.end());
    benchmark.columns = {
        {.label = "Maps",
         .unit = "ms",
         .doc = "Building the layered depth maps.",
         .source = Column::PassTime{construction}},
        {.label = "Tracing",
         .unit = "ms",
         .doc = "The lights' images, emission, splitting, tracing and storing.",
         .source = Column::PassTime{tracing}},
        {.label = "of that packing",
         .unit = "ms",
         .doc = "Prefix sums and storing in a fixed order.",
         .source = Column::PassTime{packing}},
        {.label = "Splatting",
         .unit = "ms",
         .doc = "From stored photons to irradiance.",
         .source = Column::PassTime{splatting}},
        {.label = "Total", .unit = "ms", .doc = "Maps, tracing and splatting.", .source = Column::PassTime{}},
        {.label = "Photons",
         .doc = "That were stored.",
         .source = Column::Counter{"indirect.count"},
         .best = Column::Best::none},
        graph::memory_column(),
    };
    return benchmark;
}

}  // namespace

std::vector<graph::Benchmark> benchmarks() {
    auto small = in_atrium("ldm-indirect",
                           "Indirect light from layered depth maps at 320x320: 128 maps of 200x200, 32x32 "
                           "photons per image of a light, and what grows when one of these changes",
                           320, 320);
    small.variants = {
        variant("128 maps of 200², 32² photons", {}), variant("64 maps", {.directions = 64}),
        variant("256 maps", {.directions = 256}),     variant("16² photons", {.emission = 16}),
        variant("64² photons", {.emission = 64}),     variant("maps of 100²", {.resolution = 100}),
        variant("maps of 400²", {.resolution = 400})};
    auto published =
        in_atrium("ldm-indirect-published",
                  "Indirect light from 512 layered depth maps of 200x200 at 800x800, as published; "
                  "for GPUs. The paper's scenes and lights are not free: times of other scenes",
                  800, 800);
    published.variants = {variant("512 maps of 200², 32² photons", {.directions = 512}),
                          variant("512 maps of 200², 64² photons", {.directions = 512, .emission = 64})};
    return {small, published};
}

}  // namespace ir::methods::ldm_indirect
