#include "renderers/methods/ldm-ao/passes.h"

#include <glm/glm.hpp>
#include <limits>

#include "renderers/core/error.h"
#include "renderers/graph/graph.h"
#include "renderers/passes/ldm/directions.h"
#include "renderers/passes/ldm/parameters.h"
#include "renderers/passes/raytracing/embree_timing.h"

namespace ir::methods::ldm_ao {
namespace {

namespace ldm = passes::ldm;

/// Pixels of a tile stand together, so that a packet's rays start close to each other.
constexpr int tile = 4;

std::vector<glm::vec3> vectors_of(const graph::Graph& graph, const std::string& key) {
    const auto image = graph.read_image(key);
    if (!image) throw Error("benchmark: buffer '" + key + "' was not computed");
    std::vector<glm::vec3> vectors;
    vectors.reserve(static_cast<std::size_t>(image->width) * image->height);
    for (int y = 0; y < image->height; y += tile)
        for (int x = 0; x < image->width; x += tile)
            for (int v = y; v < std::min(y + tile, image->height); ++v)
                for (int u = x; u < std::min(x + tile, image->width); ++u)
                    vectors.emplace_back(image->at(u, v, 0), image->at(u, v, 1), image->at(u, v, 2));
    return vectors;
}

/// Milliseconds that Embree takes for the lines of `directions` maps, up to `max_distance` metres.
graph::Benchmark::Peer embree(int directions, float max_distance) {
    const auto run = [=](const graph::Graph& graph, const graph::FrameInputs& inputs,
                         const CancelToken& cancel) {
        const auto positions = vectors_of(graph, "gbuffer.position");
        const auto normals = vectors_of(graph, "gbuffer.geometric_normal");
        std::vector<glm::vec3> lines;
        for (const auto& direction : ldm::leopardi_directions(directions)) {
            lines.emplace_back(direction.centre);
            lines.emplace_back(-direction.centre);
        }
        const auto timing = passes::time_embree_ao(*inputs.scene, *inputs.world, positions, normals, lines,
                                                   max_distance, inputs.threads, cancel);
        return std::map<std::string, double>{{"build", timing.build_ms}, {"trace", timing.trace_ms}};
    };
    return {"embree", run};
}

Settings settings(int directions, int resolution, const std::string& storage, const std::string& builder) {
    return {{"directions", std::int64_t{directions}},
            {"resolution", std::int64_t{resolution}},
            {"storage", storage},
            {"builder", builder},
            {"nodes", std::string("plain")}};  // which all storages have
}

/// Of both processors.
const std::vector<std::string> all_passes{
    "map frames*", "meshlets", "kept maps", "build maps*", "trace*", "build and trace maps", "accessibility"};

/// Choices of parameter "storage".
std::vector<Choice> storages() {
    const auto descriptions = ldm::map_parameters({.outermost = true, .sloped = true}).descriptions();
    return find(descriptions, "storage")->choices;
}

using Column = graph::BenchmarkColumn;

std::vector<Column> columns() {
    return {{"Build", "ms", "Views of the maps, and all passes that build them.",
             Column::PassTime{{"map frames*", "meshlets", "build maps*"}}},
            {"Trace", "ms", "All passes that query the maps, and accessibility; on the host with building.",
             Column::PassTime{{"trace*", "build and trace maps", "accessibility"}}},
            {"Total", "ms", "Building and tracing.", Column::PassTime{}},
            {"Fragments", "", "Made by rasterising the scene into all maps.",
             Column::Counter{"ldm.fragments"}, Column::Best::none},
            {"Maps", "B", "Without spare and scratch space.", Column::Counter{"ldm.bytes"}},
            {"Per fragment", "B", "Memory of the maps per fragment.",
             Column::CounterRatio{"ldm.bytes", "ldm.fragments"}},
            {"All buffers", "B", "With spare and scratch space, scene and G-buffer.", Column::MemoryBytes{}}};
}

/// Every storage by the compute builder, without a limit of distance.
std::vector<graph::Benchmark::Variant> by_storage(int directions, int resolution) {
    std::vector<graph::Benchmark::Variant> variants;
    for (const auto& storage : storages()) {
        auto set = settings(directions, resolution, storage.key, "compute");
        set["max_distance"] = 0.0;  // else outermost depths are not enough
        variants.push_back({.label = storage.key, .settings = set, .processor = Processor::gl});
    }
    return variants;
}

graph::Benchmark against_rays() {
    graph::Benchmark benchmark;
    benchmark.name = "ldm-ao";
    benchmark.doc =
        "Layered depth maps, 128 of 200x200, built and traced by each builder and storage at 800x800 without "
        "a limit of distance, against Embree (medium BVH, coherent occluded16) on the same lines";
    auto set = settings(128, 200, "arrays", "compute");
    set["max_distance"] = 0.0;
    benchmark.variants.push_back({.label = "host", .settings = set, .processor = Processor::host});
    for (const auto* builder : {"compute", "raster"})
        for (const auto* storage : {"arrays", "linked-lists"}) {
            set["builder"] = std::string(builder);
            set["storage"] = std::string(storage);
            benchmark.variants.push_back({.label = std::string(builder) + ", " + storage,
                                          .settings = set,
                                          .processor = Processor::gl});
        }
    benchmark.total_of = all_passes;
    benchmark.peers = {embree(128, std::numeric_limits<float>::infinity())};
    return benchmark;
}

graph::Benchmark figure8() {
    constexpr float max_distance = 12.8f;
    graph::Benchmark benchmark;
    benchmark.name = "ldm-ao-figure8";
    benchmark.doc =
        "The published setting of Sponza, 512 maps of 200x200 at 800x800 with hits up to 12.8 m (1280 units "
        "of a centimetre) that count by their distance, against Embree (medium BVH, coherent packets of 16) "
        "asking for the closest hits up to there along the same lines";
    for (const auto* storage : {"arrays", "packed-arrays", "linked-lists"}) {
        auto set = settings(512, 200, storage, "compute");
        set["max_distance"] = double{max_distance};
        set["falloff"] = std::string("smooth");  // else any hit up to there would do, also for Embree
        if (benchmark.variants.empty()) {
            benchmark.variants.push_back({.label = "host", .settings = set, .processor = Processor::host});
            auto sloped = set;
            sloped["nodes"] = std::string("sloped");
            benchmark.variants.push_back(
                {.label = "host, sloped nodes", .settings = sloped, .processor = Processor::host});
        }
        benchmark.variants.push_back({.label = storage, .settings = set, .processor = Processor::gl});
    }
    benchmark.total_of = all_passes;
    benchmark.peers = {embree(512, max_distance)};
    benchmark.columns = columns();
    benchmark.columns.push_back(
        {"To Embree", "", "Total, divided by Embree's.", Column::TimeRatio{"embree"}});
    return benchmark;
}

graph::Benchmark memory() {
    graph::Benchmark benchmark;
    benchmark.name = "ldm-ao-memory";
    benchmark.doc =
        "Memory and time at the published setting, 512 maps of 200x200 at 800x800 (805.5 MB there), by "
        "storage";
    for (const auto* storage : {"arrays", "packed-arrays", "linked-lists", "lists-then-sort", "pages"})
        benchmark.variants.push_back({.label = storage,
                                      .settings = settings(512, 200, storage, "compute"),
                                      .processor = Processor::gl});
    benchmark.total_of = all_passes;
    benchmark.columns = columns();
    return benchmark;
}

graph::Benchmark every_storage() {
    graph::Benchmark benchmark;
    benchmark.name = "ldm-storages";
    benchmark.doc =
        "Every storage of layered depth maps, 64 of 100x100 at 200x150 without a limit of distance: time, "
        "memory and how far its picture is from that of the first";
    benchmark.width = 200;
    benchmark.height = 150;
    benchmark.variants = by_storage(64, 100);
    benchmark.total_of = all_passes;
    benchmark.columns = columns();
    for (const auto& column : std::vector<Column>{
             {"Nodes", "", "Depths that are stored.", Column::Counter{"ldm.nodes"}, Column::Best::none},
             {"Mean layers", "", "Nodes per texel.", Column::CounterRatio{"ldm.nodes", "ldm.texels"},
              Column::Best::none},
             {"Maximum layers", "", "At one texel, of all maps.", Column::LargestValue{"ldm.layers"},
              Column::Best::none},
             {"Dropped", "", "Fragments that had no room.", Column::Counter{"ldm.dropped"}},
             {"Difference", "", "RMS of accessibility to the first variant.", Column::Difference{}},
             {"Largest difference", "", "Of accessibility to the first variant, at any pixel.",
              Column::Difference{Column::Difference::Norm::largest}}})
        benchmark.columns.push_back(column);
    return benchmark;
}

graph::Benchmark growth() {
    graph::Benchmark benchmark;
    benchmark.name = "ldm-ao-growth";
    benchmark.doc =
        "How time and memory grow with the number of maps of 200x200, and with the resolution of "
        "128 maps; arrays, at 400x300";
    benchmark.width = 400;
    benchmark.height = 300;
    for (int directions = 32; directions <= 512; directions *= 2)
        benchmark.variants.push_back({.label = std::to_string(directions) + " maps",
                                      .settings = settings(directions, 200, "arrays", "compute"),
                                      .processor = Processor::gl});
    for (int resolution = 50; resolution <= 400; resolution *= 2)
        benchmark.variants.push_back({.label = std::to_string(resolution) + " texels a side",
                                      .settings = settings(128, resolution, "arrays", "compute"),
                                      .processor = Processor::gl});
    benchmark.total_of = all_passes;
    benchmark.columns = columns();
    return benchmark;
}

}  // namespace

std::vector<graph::Benchmark> benchmarks() {
    return {against_rays(), figure8(), memory(), every_storage(), growth()};
}

}  // namespace ir::methods::ldm_ao
