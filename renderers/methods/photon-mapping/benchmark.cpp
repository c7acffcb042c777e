#include "renderers/methods/photon-mapping/stages.h"

#include <string>

namespace ir::methods::photon_mapping {
namespace {

/// What the published tables count, in their columns' order: reflective shadow maps, tracing, splatting,
/// filtering. G-buffer, direct light, uploads and the hierarchy of a scene that stands still are outside.
/// [Smal19 §8]
std::vector<std::string> published_passes() {
    return {"RSM*",
            "emission probability",
            "Haar pyramid*",
            "photon budget",
            "emission points",
            "emission.survivors *",
            "sample points",
            "leave sample points",
            "trace *",
            "land *",
            "photons.surface*",
            "store photons *",
            "count photons*",
            "splat.bins*",
            "list photons of bins",
            "surfaces to splat on",
            "splat photons",
            "filter surfaces",
            "temporal filter",
            "à-trous *"};
}

struct Setting {
    int photons = 100'000, bounces = 1, passes = 4;
    std::string resolution = "half", tracer = "compute";
};

graph::Benchmark::Variant variant(std::string label, const Setting& setting) {
    return {std::move(label),
            {{"photons", std::int64_t{setting.photons}},
             {"max_bounces", std::int64_t{setting.bounces}},
             {"filter_passes", std::int64_t{setting.passes}},
             {"splat_resolution", setting.resolution},
             {"tracer", setting.tracer}}};
}

/// From stored photons to unfiltered irradiance.
std::vector<std::string> splatting_passes() {
    return {"count photons*", "splat.bins*", "list photons of bins", "surfaces to splat on", "splat photons"};
}

/// Kernels that the device draws and gathers, also with the BRDF of each photon, and that the host adds up.
void add_splatting(std::vector<graph::Benchmark::Variant>& variants, int photons) {
    const auto add = [&](const char* label, Settings settings, Processor processor = Processor::gl) {
        settings["photons"] = std::int64_t{photons};
        variants.push_back({std::to_string(photons / 1000) + " k photons, " + label, settings, 1, processor});
    };
    const Value tiles = std::string("tiles");
    add("drawn", {});
    add("tiles", {{"splatting", tiles}});
    add("tiles, full BRDF", {{"splatting", tiles}, {"receiver", std::string("full")}});
    add("drawn as planes", {{"inside_test", std::string("linear-depth")}});
    add("host", {}, Processor::host);
}

graph::Benchmark on_conference(const char* name, const char* doc, int width, int height) {
    graph::Benchmark benchmark;
    benchmark.name = name;
    benchmark.doc = doc;
    benchmark.scene = "builtin:conference";
    benchmark.width = width;
    benchmark.height = height;
    benchmark.total_of = published_passes();
    return benchmark;
}

}  // namespace

std::vector<graph::Benchmark> benchmarks() {
    auto scaled = on_conference("photon-mapping",
                                "Photon mapping at 480x270, a sixteenth of the published pixels: 100 000 "
                                "photons, 1 bounce, splatting at half resolution, 4 filter passes, and what "
                                "grows when one of these changes",
                                480, 270);
    scaled.variants = {
        variant("100 k photons, 1 bounce, half resolution, 4 passes, compute", {}),
        variant("25 k photons", {.photons = 25'000}),
        variant("400 k photons", {.photons = 400'000}),
        variant("3 bounces", {.bounces = 3}),
        variant("1 filter pass", {.passes = 1}),
        variant("full resolution", {.resolution = "full"}),
        variant("quarter resolution", {.resolution = "quarter"}),
        variant("Embree", {.tracer = "embree"}),
        variant("layered depth cube", {.tracer = "cube"}),
    };
    auto published = on_conference(
        "photon-mapping-published",
        "Photon mapping at 1920x1080 as published, for GPUs: the rows of [Smal19 table 8.2], and full "
        "resolution. Published on an RTX 2080 Ti in Sponza, ms for RSM, tracing, splatting, filtering, all: "
        "1 M photons 1.4, 0.7, 1.2, 3.1, 6.1; 2 M 1.8, 1.3, 2.3, 3.1, 9.0; 3 M 2.1, 1.8, 3.9, 3.1, 10.8; 1 M "
        "with 3 bounces 1.4, 1.3, 2.1, 3.1, 7.9",
        1920, 1080);
    published.variants = {
        variant("1 M photons, 1 bounce", {.photons = 1'000'000}),
        variant("2 M photons, 1 bounce", {.photons = 2'000'000}),
        variant("3 M photons, 1 bounce", {.photons = 3'000'000}),
        variant("1 M photons, 3 bounces", {.photons = 1'000'000, .bounces = 3}),
        variant("1 M photons, 1 bounce, full resolution", {.photons = 1'000'000, .resolution = "full"}),
    };
    auto splatting = on_conference(
        "photon-mapping-splatting",
        "Kernels drawn as ellipsoids, gathered by tiles, the same with the BRDF of each photon, drawn as "
        "planes, and added up on the host, at 480x270: the columns of [Smal19 table 6.1], over the number of "
        "photons. Published on an RTX 2080 Ti at 1920x1080, ms for ellipsoids, tiles, planes: Sponza, 500 k "
        "photons 1.3, 6.6, 1.5; conference room, 100 k photons 0.9, 7.4, 1.1",
        480, 270);
    splatting.total_of = splatting_passes();
    for (const int photons : {25'000, 100'000, 400'000}) add_splatting(splatting.variants, photons);
    splatting.columns = {
        {.label = "Splatting",
         .unit = "ms",
         .doc = "From stored photons to unfiltered irradiance.",
         .source = graph::BenchmarkColumn::PassTime{}},
        {.label = "of that lists",
         .unit = "ms",
         .doc = "Finding the photons of each tile.",
         .source =
             graph::BenchmarkColumn::PassTime{{"count photons of bins", "splat.bins*", "list photons*"}}},
        {.label = "Photons",
         .doc = "That were stored.",
         .source = graph::BenchmarkColumn::Counter{"photons.count"},
         .best = graph::BenchmarkColumn::Best::none},
        {.label = "Tiles a photon",
         .doc = "In how many lists a photon stands.",
         .source = graph::BenchmarkColumn::CounterRatio{"splat.bin_entries", "photons.count"},
         .best = graph::BenchmarkColumn::Best::none},
        graph::memory_column(),
    };
    return {scaled, published, splatting};
}

}  // namespace ir::methods::photon_mapping
