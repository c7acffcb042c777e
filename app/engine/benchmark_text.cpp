#include <nlohmann/json.hpp>
#include <sstream>

#include "app/engine/benchmark_report.h"
#include "app/engine/number_text.h"
#include "renderers/image/metrics.h"

namespace ir::engine {
namespace {

using projects::Json;

/// Beside a number that JSON cannot say.
void add_reason(Json& json, const std::string& name, double number) {
    if (const auto why = why_not_finite(number); !why.empty()) json["reasons"][name] = why;
}

Json peer_json(const BenchmarkRow& row) {
    if (!row.problem.empty()) return {{"label", row.label}, {"problem", row.problem}};
    Json json{{"cold_ms", row.cold_ms}, {"warm_ms", row.warm_ms}};
    for (const auto& [part, ms] : row.parts) json["parts"][part] = ms;
    json["label"] = row.label;
    return json;
}

Json variant_json(const BenchmarkRow& row) {
    if (!row.problem.empty()) return {{"label", row.label}, {"problem", row.problem}};
    Json json{{"cold_wall_ms", row.cold_wall_ms}, {"cold_ms", row.cold_ms}, {"warm_ms", row.warm_ms}};
    for (const auto& pass : row.passes)
        json["passes"].push_back({{"name", pass.name},
                                  {"queue", pass.queue},
                                  {"ms", pass.ms},
                                  {"in_total", pass.in_total},
                                  {"bytes_made", pass.bytes_made}});
    json["memory_bytes"] = row.memory_bytes;
    json["counters"] = row.counters;
    json["label"] = row.label;
    for (const auto& [peer, ratio] : row.ratios) {
        json["ratio_to_" + peer] = number_json(ratio);
        add_reason(json, "ratio_to_" + peer, ratio);
    }
    return json;
}

Json numbers_json(const BenchmarkReport& report) {
    Json json{{"benchmark", report.name},    {"method", report.method},   {"device", report.device},
              {"software", report.software}, {"repeats", report.repeats}, {"date", report.date}};
    if (!report.notes.empty()) json["notes"] = report.notes;
    auto& results = json["results"];
    results = {{"scene", report.scene}, {"size", {report.width, report.height}}};
    for (const auto& row : report.rows)
        if (row.is_peer)
            results["peers"].push_back(peer_json(row));
        else
            results["variants"].push_back(variant_json(row));
    return json;
}

void add_table(Json& json, const BenchmarkReport& report) {
    json["columns"] = Json::array();
    for (const auto& column : report.columns)
        json["columns"].push_back({{"label", column.label}, {"unit", column.unit}, {"doc", column.doc}});
    json["table"] = Json::array();
    for (const auto& row : report.rows) {
        Json line{{"label", row.label}, {"is_peer", row.is_peer}, {"cells", Json::array()}};
        for (const auto& cell : row.cells) {
            if (cell) add_reason(line, report.columns[line["cells"].size()].label, *cell);
            line["cells"].push_back(cell ? number_json(*cell) : Json());
        }
        if (!row.problem.empty()) line["problem"] = row.problem;
        json["table"].push_back(std::move(line));
    }
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

std::string benchmark_json(const BenchmarkReport& report) {
    auto json = numbers_json(report);
    add_table(json, report);
    return json.dump(2) + "\n";
}

std::string benchmark_text(const BenchmarkReport& report) {
    std::ostringstream text;
    text << benchmark_table(report) << "\n";
    print(text, numbers_json(report), "");
    return text.str();
}

}  // namespace ir::engine
