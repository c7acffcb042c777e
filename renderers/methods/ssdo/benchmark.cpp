#include "renderers/methods/ssdo/passes.h"

namespace ir::methods::ssdo {
namespace {

using Column = graph::BenchmarkColumn;

const std::vector<std::string> blurring{"remove materials*", "blur*", "put materials back*"};

graph::Benchmark::Variant variant(int samples, bool blur, const std::string& estimator) {
    return {std::to_string(samples) + " samples" + (blur ? ", blur" : "") +
                (estimator == "published" ? ", published" : ""),
            {{"samples", std::int64_t{samples}}, {"blur", blur}, {"estimator", estimator}}};
}

}  // namespace

std::vector<graph::Benchmark> benchmarks() {
    graph::Benchmark benchmark;
    benchmark.name = "ssdo";
    benchmark.doc =
        "Screen-space directional occlusion and one bounce within 1 m, over the number of samples and the "
        "blur. Differences are to 1024 samples without a blur: the noise, not what the picture misses";
    benchmark.scene = "builtin:cornell";
    benchmark.width = benchmark.height = 256;
    benchmark.variants = {variant(1024, false, "density")};
    for (const int samples : {8, 16, 64})
        for (const bool blur : {false, true}) benchmark.variants.push_back(variant(samples, blur, "density"));
    benchmark.variants.push_back(variant(16, true, "published"));
    benchmark.total_of = {"directional occlusion", "add environment light", "indirect light"};
    benchmark.total_of.insert(benchmark.total_of.end(), blurring.begin(), blurring.end());
    benchmark.columns = {{.label = "Gathering",
                          .unit = "ms",
                          .doc = "Directional occlusion and indirect light.",
                          .source = Column::PassTime{{"directional occlusion", "indirect light"}}},
                         {.label = "Blur",
                          .unit = "ms",
                          .doc = "With materials taken out and put back.",
                          .source = Column::PassTime{blurring}},
                         {.label = "Total",
                          .unit = "ms",
                          .doc = "Without G-buffer and shadow maps.",
                          .source = Column::PassTime{}},
                         {.label = "RMS difference",
                          .unit = "W/(m² sr)",
                          .doc = "To the first variant.",
                          .source = Column::Difference{}},
                         graph::memory_column()};
    return {benchmark};
}

}  // namespace ir::methods::ssdo
