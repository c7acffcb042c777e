#include "renderers/methods/ldm-ao/benchmark.h"

#include <glm/glm.hpp>

#include "renderers/core/error.h"
#include "renderers/graph/graph.h"
#include "renderers/passes/ldm/directions.h"
#include "renderers/passes/raytracing/embree_timing.h"

namespace ir::methods::ldm_ao {
namespace {

constexpr int compared_directions = 128;
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

std::map<std::string, double> trace_with_embree(const graph::Graph& graph, const graph::FrameInputs& inputs) {
    const auto positions = vectors_of(graph, "gbuffer.position");
    const auto normals = vectors_of(graph, "gbuffer.geometric_normal");
    std::vector<glm::vec3> directions;
    for (const auto& direction : passes::ldm::leopardi_directions(compared_directions)) {
        directions.emplace_back(direction.centre);
        directions.emplace_back(-direction.centre);
    }
    const auto timing =
        passes::time_embree_ao(*inputs.scene, *inputs.world, positions, normals, directions, inputs.threads);
    return {{"build", timing.build_ms}, {"trace", timing.trace_ms}};
}

Settings settings(int directions, int resolution, const std::string& storage, const std::string& builder) {
    return {{"directions", std::int64_t{directions}},
            {"resolution", std::int64_t{resolution}},
            {"storage", storage},
            {"builder", builder}};
}

}  // namespace

std::vector<graph::Benchmark> benchmarks() {
    graph::Benchmark against_rays;
    against_rays.name = "ldm-ao";
    against_rays.doc =
        "Layered depth maps, 128 of 200x200, built and traced by each builder and storage at 800x800 without "
        "a limit of "
        "distance, against Embree (medium BVH, coherent occluded16) on the same lines";
    for (const auto* builder : {"compute", "raster"})
        for (const auto* storage : {"arrays", "linked-lists"})
            against_rays.variants.push_back({std::string(builder) + ", " + storage,
                                             settings(compared_directions, 200, storage, builder)});
    against_rays.total_of = {"map frames*", "build maps*", "trace*", "accessibility"};
    against_rays.peers = {{"embree", trace_with_embree}};

    graph::Benchmark memory;
    memory.name = "ldm-ao-memory";
    memory.doc =
        "Memory and time at the published setting, 512 maps of 200x200 at 800x800 (805.5 MB there), by "
        "storage";
    for (const auto* storage : {"arrays", "linked-lists"})
        memory.variants.push_back({storage, settings(512, 200, storage, "compute")});
    memory.total_of = against_rays.total_of;
    return {against_rays, memory};
}

}  // namespace ir::methods::ldm_ao
