#include "renderers/methods/hbao/passes.h"

#include <array>

namespace ir::methods::hbao {
namespace {

/// 512 directions with up to 128 steps, each pixel alike and nothing blurred.
Settings authors_baseline(double radius) {
    return {{"directions", std::int64_t{512}},
            {"steps", std::int64_t{128}},
            {"turning", std::string("none")},
            {"blur", false},
            {"max_distance", radius}};
}

Settings sensible(double radius) {
    return {{"max_distance", radius}};
}

}  // namespace

std::vector<graph::Benchmark> benchmarks() {
    graph::Benchmark settings;
    settings.name = "hbao";
    settings.doc =
        "Horizon-based ambient occlusion within 1 m: the sensible setting, and the 512 directions with up to "
        "128 steps of Aalund 2015's baseline, on a small picture because of the latter";
    settings.width = settings.height = 200;
    settings.variants = {{"sensible, 16 directions, 12 steps", sensible(1)},
                         {"authors' baseline, 512 directions, 128 steps", authors_baseline(1)}};
    settings.total_of = {"march", "resolve", "blur*"};

    graph::Benchmark radii = settings;
    radii.name = "hbao-radius";
    radii.doc = "The sensible setting over the radius, from 0.25 to 12.8 m and without a limit";
    radii.width = radii.height = 800;
    radii.variants.clear();
    const std::array<std::pair<const char*, double>, 8> sweep{{{"0.25 m", 0.25},
                                                               {"0.5 m", 0.5},
                                                               {"1 m", 1},
                                                               {"2 m", 2},
                                                               {"4 m", 4},
                                                               {"8 m", 8},
                                                               {"12.8 m", 12.8},
                                                               {"unlimited", 0}}};
    for (const auto& [label, radius] : sweep) radii.variants.push_back({label, sensible(radius)});
    return {settings, radii};
}

}  // namespace ir::methods::hbao
