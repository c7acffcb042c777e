#include "renderers/methods/reference/passes.h"

namespace ir::methods::reference {
namespace {

/// Under a white sky instead of the scene's lights, so that every scene can be used and other renderers can
/// be given the same.
graph::Benchmark under_white_sky(const char* name, const char* doc) {
    graph::Benchmark benchmark;
    benchmark.name = name;
    benchmark.doc = std::string(doc) +
                    ", 400x300, 32 paths per pixel, from rays and from the G-buffer. The counters tell "
                    "paths per second, and the time to an RMSE of 0.02 as time × (error / 0.02)²: it is "
                    "extrapolated from the estimated error, with which it falls as 1 / paths or faster";
    benchmark.width = 400;
    benchmark.height = 300;
    benchmark.sky = glm::vec3(1);
    benchmark.total_of = {"trace*"};
    return benchmark;
}

graph::Benchmark::Variant variant(const char* label, const char* paths, const char* primary,
                                  double max_distance, const char* materials = "lambert") {
    return {label,
            {{"paths", std::string(paths)},
             {"primary", std::string(primary)},
             {"samples", std::int64_t{32}},
             {"max_bounces", std::int64_t{5}},
             {"max_distance", max_distance},
             {"materials", std::string(materials)},
             {"normal_maps", materials != std::string("lambert")}}};
}

}  // namespace

std::vector<graph::Benchmark> benchmarks() {
    auto paths = under_white_sky("reference-paths", "Light paths of up to 5 bounces, diffuse");
    paths.variants = {variant("rays", "full", "rays", 0), variant("G-buffer", "full", "gbuffer", 0),
                      variant("rays, glTF materials", "full", "rays", 0, "gltf")};
    auto ao = under_white_sky("reference-ao", "Ambient occlusion within 3 m");
    ao.variants = {variant("rays", "ao", "rays", 3), variant("G-buffer", "ao", "gbuffer", 3)};
    return {paths, ao};
}

}  // namespace ir::methods::reference
