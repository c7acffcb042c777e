#include "renderers/methods/ambient-occlusion-volumes/volumes.h"

namespace ir::methods::ambient_occlusion_volumes {
namespace {

using graph::BenchmarkColumn;

Settings bounced(std::int64_t samples, double reach) {
    return {{"samples", samples}, {"max_distance", reach}};
}

Settings additive(double reach) {
    return {{"visibility", false}, {"max_distance", reach}, {"falloff", std::string("smooth")}};
}

std::vector<BenchmarkColumn> columns() {
    return {
        {.label = "Total",
         .unit = "ms",
         .doc = "Culling, drawing and blurring.",
         .source = BenchmarkColumn::PassTime{}},
        {.label = "Volumes",
         .unit = "ms",
         .doc = "Drawing them: additive, or once for each sample.",
         .source = BenchmarkColumn::PassTime{{"additive", "bounced z"}}},
        {.label = "Cull",
         .unit = "ms",
         .doc = "Bounds of what tiles of the picture show, and volumes against them.",
         .source = BenchmarkColumn::PassTime{{"picture bounds", "cull volumes"}}},
        {.label = "Blur",
         .unit = "ms",
         .doc = "With visibility the reconstruction.",
         .source = BenchmarkColumn::PassTime{{"blur*", "reconstruction"}}},
        {.label = "Drawn",
         .doc = "Volumes that may reach what the picture shows.",
         .source = BenchmarkColumn::Counter{"volumes.drawn"},
         .best = BenchmarkColumn::Best::none},
        {.label = "Maximum on a pixel",
         .doc = "Volumes that cover one pixel.",
         .source = BenchmarkColumn::LargestValue{"volumes.covering"},
         .best = BenchmarkColumn::Best::none},
        graph::memory_column(),
    };
}

}  // namespace

std::vector<graph::Benchmark> benchmarks() {
    graph::Benchmark b;
    b.name = "ambient-occlusion-volumes";
    b.doc =
        "Ambient occlusion volumes, additive as published in 2010 and with the bounced z-buffer: samples, "
        "distances, and what culling is worth; a small picture, since the time goes into fragments";
    b.scene = "builtin:atrium?detail=0.1";
    b.camera = "nave";
    b.width = b.height = 100;
    b.variants = {
        {"additive, 0.5 m", additive(0.5)},          {"additive, 1 m", additive(1)},
        {"bounced, 1 sample, 1 m", bounced(1, 1)},   {"bounced, 4 samples, 0.5 m", bounced(4, 0.5)},
        {"bounced, 4 samples, 1 m", bounced(4, 1)},  {"bounced, 4 samples, 1 m, no culling", bounced(4, 1)},
        {"bounced, 16 samples, 1 m", bounced(16, 1)}};
    b.variants[5].settings["culling"] = false;
    b.total_of = {"picture bounds", "cull volumes", "additive", "compensate",    "directions",
                  "bounced z",      "visibility",   "blur*",    "reconstruction"};
    b.columns = columns();
    return {b};
}

}  // namespace ir::methods::ambient_occlusion_volumes
