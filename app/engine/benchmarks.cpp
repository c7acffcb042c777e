#include "app/engine/benchmarks.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "renderers/core/error.h"

namespace ir::engine {
namespace {

using Json = nlohmann::ordered_json;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto n = values.size();
    return n == 0 ? 0 : n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// One method with its defaults on one scene: what each pass costs, cold and warm.
Json time_experiment(Machine& machine, const Experiment& experiment, int repeats) {
    std::map<std::string, std::vector<double>> warm;
    std::vector<double> walls;
    Json row{{"method", experiment.method},
             {"scene", experiment.scene},
             {"size", {experiment.width, experiment.height}}};
    Execution execution(machine, experiment);
    graph::FrameOptions options;
    options.rebuild = true;
    for (int i = 0; i <= repeats; ++i) {
        execution.restart();
        const auto report = execution.run_frame(options);
        if (i == 0) {
            row["cold_ms"] = report.wall_ms;
            row["memory_bytes"] = report.memory_bytes;
            row["counters"] = report.counters;
            continue;
        }
        walls.push_back(report.wall_ms);
        for (const auto& pass : report.passes)
            if (!pass.culled) warm[pass.name].push_back(pass.queue == "gl" ? pass.gpu_ms : pass.cpu_ms);
        if (i == repeats) {
            for (const auto& pass : report.passes) {
                if (pass.culled) continue;
                std::uint64_t bytes = 0;
                for (const auto& resource : report.resources)
                    if (resource.pass == pass.name) bytes += resource.bytes;
                row["passes"].push_back({{"name", pass.name},
                                         {"queue", pass.queue},
                                         {"ms", median(warm[pass.name])},
                                         {"bytes_made", bytes}});
            }
        }
    }
    row["warm_ms"] = median(walls);
    return row;
}

Json benchmark_methods(Machine& machine, const BenchmarkOptions& options) {
    Json rows = Json::array();
    for (const auto* method : registry().methods()) {
        Experiment experiment;
        experiment.scene = options.scene.empty() ? "builtin:atrium" : options.scene;
        experiment.method = method->id;
        experiment.width = 400;
        experiment.height = 300;
        rows.push_back(time_experiment(machine, experiment, options.repeats));
    }
    return rows;
}

struct Benchmark {
    const char* name;
    const char* doc;
    Json (*run)(Machine&, const BenchmarkOptions&);
};

const std::vector<Benchmark>& benchmarks() {
    static const std::vector<Benchmark> all{
        {"methods", "Every method with its defaults at 400x300 on builtin:atrium", benchmark_methods},
    };
    return all;
}

/// Numbers of a report as indented lines.
void print(std::ostream& out, const Json& json, const std::string& indent) {
    for (const auto& [key, value] : json.items()) {
        const auto label = json.is_array() ? std::string("-") : key + ":";
        if (value.is_structured() && !value.empty() && (value.is_object() || value.front().is_structured())) {
            out << indent << label << "\n";
            print(out, value, indent + "  ");
        } else {
            out << indent << label << " " << (value.is_string() ? value.get<std::string>() : value.dump())
                << "\n";
        }
    }
}

}  // namespace

std::string benchmark_list(bool json) {
    Json list = Json::array();
    std::string text;
    for (const auto& benchmark : benchmarks()) {
        list.push_back({{"name", benchmark.name}, {"doc", benchmark.doc}});
        text += std::string(benchmark.name) + "  " + benchmark.doc + "\n";
    }
    return json ? list.dump(2) + "\n" : text;
}

std::string run_benchmark(Machine& machine, const std::string& name, const BenchmarkOptions& options) {
    for (const auto& benchmark : benchmarks()) {
        if (name != benchmark.name) continue;
        Json json{{"benchmark", name},
                  {"device", machine.context().info().renderer},
                  {"software", machine.context().info().software},
                  {"repeats", options.repeats}};
        json["results"] = benchmark.run(machine, options);
        if (options.json) return json.dump(2) + "\n";
        std::ostringstream text;
        print(text, json, "");
        return text.str();
    }
    throw UsageError("unknown benchmark '" + name + "'; there are:\n" + benchmark_list(false));
}

}  // namespace ir::engine
