#include "app/engine/benchmarks.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "renderers/core/error.h"
#include "renderers/methods/all_methods.h"

namespace ir::engine {
namespace {

using Json = nlohmann::ordered_json;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto n = values.size();
    return n == 0 ? 0 : n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

bool counts(const graph::Benchmark& benchmark, const std::string& pass) {
    if (benchmark.total_of.empty()) return true;
    return std::any_of(benchmark.total_of.begin(), benchmark.total_of.end(),
                       [&](const auto& pattern) { return graph::matches(pattern, pass); });
}

double ms_of(const PassReport& pass) {
    return pass.queue == "gl" ? pass.gpu_ms : pass.cpu_ms;
}

std::uint64_t bytes_made_by(const FrameReport& report, const std::string& pass) {
    std::uint64_t bytes = 0;
    for (const auto& resource : report.resources)
        if (resource.pass == pass) bytes += resource.bytes;
    return bytes;
}

double total_ms(const graph::Benchmark& benchmark, const FrameReport& report) {
    double total = 0;
    for (const auto& pass : report.passes)
        if (!pass.culled && counts(benchmark, pass.name)) total += ms_of(pass);
    return total;
}

/// Cold is the first frame of all, with growing buffers and the driver's compilation; warm is the median of
/// the others, each with everything built anew.
Json time_variant(Execution& execution, const graph::Benchmark& benchmark, int repeats) {
    graph::FrameOptions options;
    options.rebuild = true;
    Json row;
    std::map<std::string, std::vector<double>> by_pass;
    std::vector<double> totals;
    FrameReport report;
    for (int i = 0; i <= repeats; ++i) {
        execution.restart();
        report = execution.run_frame(options);
        if (i == 0) {
            row["cold_wall_ms"] = report.wall_ms;
            row["cold_ms"] = total_ms(benchmark, report);
            continue;
        }
        totals.push_back(total_ms(benchmark, report));
        for (const auto& pass : report.passes)
            if (!pass.culled) by_pass[pass.name].push_back(ms_of(pass));
    }
    row["warm_ms"] = median(totals);
    for (const auto& pass : report.passes)
        if (!pass.culled)
            row["passes"].push_back({{"name", pass.name},
                                     {"queue", pass.queue},
                                     {"ms", median(by_pass[pass.name])},
                                     {"in_total", counts(benchmark, pass.name)},
                                     {"bytes_made", bytes_made_by(report, pass.name)}});
    row["memory_bytes"] = report.memory_bytes;
    row["counters"] = report.counters;
    return row;
}

Json time_peer(Execution& execution, const graph::Benchmark::Peer& peer, int repeats) {
    Json row;
    std::map<std::string, std::vector<double>> by_part;
    std::vector<double> totals;
    for (int i = 0; i <= repeats; ++i) {
        double total = 0;
        for (const auto& [part, ms] : peer.run(execution.graph(), execution.inputs())) {
            total += ms;
            if (i > 0) by_part[part].push_back(ms);
        }
        if (i == 0)
            row["cold_ms"] = total;
        else
            totals.push_back(total);
    }
    row["warm_ms"] = median(totals);
    for (const auto& [part, values] : by_part) row["parts"][part] = median(values);
    return row;
}

Json run_one(Machine& machine, const std::string& method, const graph::Benchmark& benchmark,
             const BenchmarkOptions& options) {
    Experiment experiment;
    experiment.scene = options.scene.empty() ? benchmark.scene : options.scene;
    experiment.method = method;
    if (options.scene.empty()) experiment.camera_name = benchmark.camera;
    experiment.camera = options.camera;
    experiment.width = benchmark.width;
    experiment.height = benchmark.height;
    if (benchmark.sky) {
        experiment.replace_lights = true;
        experiment.environment = scene::Environment{*benchmark.sky, nullptr};
    }
    Json json{{"scene", experiment.scene}, {"size", {experiment.width, experiment.height}}};
    for (const auto& variant : benchmark.variants) {
        experiment.settings = variant.settings;
        Execution execution(machine, experiment);
        auto row = time_variant(execution, benchmark, options.repeats);
        row["label"] = variant.label;
        json["variants"].push_back(std::move(row));
        if (&variant != &benchmark.variants.back()) continue;
        for (const auto& peer : benchmark.peers) {
            auto peer_row = time_peer(execution, peer, options.repeats);
            for (auto& ours : json["variants"])
                ours["ratio_to_" + peer.label] =
                    ours["warm_ms"].get<double>() / peer_row["warm_ms"].get<double>();
            peer_row["label"] = peer.label;
            json["peers"].push_back(std::move(peer_row));
        }
    }
    return json;
}

struct Named {
    std::string method;
    graph::Benchmark benchmark;
};

/// The benchmarks that methods bring along, and one with the defaults of each method.
std::vector<Named> all_benchmarks() {
    std::vector<Named> all;
    for (const auto* method : methods::all_methods()) {
        for (const auto& benchmark : method->benchmarks) all.push_back({method->description.id, benchmark});
        graph::Benchmark plain;
        plain.name = method->description.id + "-defaults";
        plain.doc = method->description.title + ", defaults at 400x300";
        plain.width = 400;
        plain.height = 300;
        plain.variants = {{"defaults", {}}};
        all.push_back({method->description.id, plain});
    }
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
    for (const auto& [method, benchmark] : all_benchmarks()) {
        list.push_back({{"name", benchmark.name}, {"doc", benchmark.doc}});
        text += benchmark.name + "  " + benchmark.doc + "\n";
    }
    return json ? list.dump(2) + "\n" : text;
}

std::string run_benchmark(Machine& machine, const std::string& name, const BenchmarkOptions& options) {
    for (const auto& [method, benchmark] : all_benchmarks()) {
        if (name != benchmark.name) continue;
        Json json{{"benchmark", name},
                  {"method", method},
                  {"device", machine.context().info().renderer},
                  {"software", machine.context().info().software},
                  {"repeats", options.repeats}};
        json["results"] = run_one(machine, method, benchmark, options);
        if (options.json) return json.dump(2) + "\n";
        std::ostringstream text;
        print(text, json, "");
        return text.str();
    }
    throw UsageError("unknown benchmark '" + name + "'; there are:\n" + benchmark_list(false));
}

}  // namespace ir::engine
