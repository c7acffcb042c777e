#include "app/engine/benchmarks.h"
#include "projects/json.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/methods/all_methods.h"

namespace ir::engine {

const std::vector<NamedBenchmark>& benchmarks() {
    static const std::vector<NamedBenchmark> all = [] {
        std::vector<NamedBenchmark> found;
        for (const auto* method : methods::all_methods()) {
            for (const auto& benchmark : method->benchmarks)
                found.push_back({method->description.id, benchmark});
            graph::Benchmark plain;
            plain.name = method->description.id + "-defaults";
            plain.doc = method->description.title + ", defaults at 400x300";
            plain.width = 400;
            plain.height = 300;
            plain.variants = {{"defaults", {}}};
            found.push_back({method->description.id, plain});
        }
        return found;
    }();
    return all;
}

const NamedBenchmark& find_benchmark(const std::string& name) {
    for (const auto& named : benchmarks())
        if (named.benchmark.name == name) return named;
    const auto names =
        words_of(benchmarks(), [](const NamedBenchmark& named) { return named.benchmark.name; });
    throw UsageError("unknown benchmark '" + name + "'" + known_are(name, names));
}

std::vector<graph::BenchmarkColumn> columns_of(const graph::Benchmark& benchmark) {
    using Column = graph::BenchmarkColumn;
    if (!benchmark.columns.empty()) return benchmark.columns;
    std::vector<graph::BenchmarkColumn> columns{
        {.label = "Total",
         .unit = "ms",
         .doc = benchmark.total_of.empty()
                    ? "All passes; median of the warm runs."
                    : "The passes that the benchmark is about; median of the warm runs.",
         .source = Column::PassTime{}}};
    for (const auto& peer : benchmark.peers)
        columns.push_back({.label = "Total / " + peer.label,
                           .doc = "The total divided by that of " + peer.label + " in the same run.",
                           .source = Column::TimeRatio{peer.label}});
    columns.push_back({.label = "Memory",
                       .unit = "B",
                       .doc = "Of all images and buffers, with what they have to spare.",
                       .source = Column::MemoryBytes{}});
    return columns;
}

std::string benchmark_list(bool json) {
    auto list = projects::Json::array();
    std::string text;
    for (const auto& [method, benchmark] : benchmarks()) {
        list.push_back({{"name", benchmark.name}, {"doc", benchmark.doc}});
        text += benchmark.name + "  " + benchmark.doc + "\n";
    }
    return json ? list.dump(2) + "\n" : text;
}

}  // namespace ir::engine
