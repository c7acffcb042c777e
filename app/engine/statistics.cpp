#include <nlohmann/json.hpp>

#include "app/engine/camera_pose.h"
#include "app/engine/execution.h"
#include "app/engine/version.h"
#include "renderers/core/light_use.h"

namespace ir::engine {
namespace {

using Json = nlohmann::ordered_json;

std::string severity_text(Severity severity) {
    return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "note";
}

Json picture_json(const Execution& execution) {
    const auto& experiment = execution.experiment();
    Json json{{"scene", scene::composition_name(experiment.composition())},
              {"scene_hash", execution.scene().content_hash},
              {"method", execution.method().id},
              {"method_version", execution.method().version}};
    json["values"] = Json::object();
    for (const auto& [key, value] : execution.settings())  // clang 14 captures neither of the two
        std::visit([&kept = json["values"][key]](const auto& plain) { kept = plain; }, value);
    for (const auto& [file, hunks] : experiment.shaders) json["shaders"][file] = change_text(hunks);
    if (const auto folder = shader_folder_digest(); !folder.empty()) json["shader_folder"] = folder;
    json["size"] = {experiment.width, experiment.height};
    json["seed"] = experiment.seed;
    json["frames"] = execution.committed_frames();
    json["time"] = experiment.time;
    json["camera"] = camera_json(execution.camera());
    return json;
}

}  // namespace

std::string statistics_json(const Execution& execution, const FrameReport& report) {
    Json json;
    json["schema_version"] = 1;  // projects/schemas/statistics.schema.json
    json["picture"] = picture_json(execution);
    json["version"] = version();
    json["commit"] = commit();
    json["build"] = build();
    json["command"] = command_line();
    json["backend"] = report.backend;
    json["device"] = report.device;
    json["processor"] = report.processor;
    json["frame"] = report.frame;
    json["complete"] = report.complete;
    json["wall_ms"] = report.wall_ms;
    json["passes"] = Json::array();
    for (const auto& pass : report.passes) {
        if (pass.culled) continue;
        json["passes"].push_back({{"name", pass.name},
                                  {"queue", pass.queue},
                                  {"gpu_ms", pass.gpu_ms},
                                  {"cpu_ms", pass.cpu_ms},
                                  {"slices", pass.slices}});
    }
    json["counters"] = report.counters;
    json["memory_bytes"] = report.memory_bytes;
    json["peak_memory_bytes"] = report.peak_memory_bytes;
    json["resources"] = Json::array();
    for (const auto& resource : report.resources) {
        Json row{{"key", resource.key},       {"pass", resource.pass},   {"kind", to_string(resource.kind)},
                 {"format", resource.format}, {"bytes", resource.bytes}, {"computed", resource.available}};
        if (resource.width > 0) {
            row["size"] = {resource.width, resource.height};
            row["levels"] = resource.levels;
            row["layers"] = resource.layers;
        } else {
            row["elements"] = resource.elements;
        }
        json["resources"].push_back(std::move(row));
    }
    json["lights"] = Json::parse(to_json(report.lights));
    for (const auto& each : report.printed)
        json["printed"].push_back(
            {{"pass", each.pass}, {"place", each.place}, {"label", each.label}, {"text", each.text}});
    json["messages"] = Json::array();
    for (const auto& message : report.messages)
        json["messages"].push_back({{"severity", severity_text(message.severity)},
                                    {"source", message.source},
                                    {"text", message.text}});
    return json.dump(2);
}

}  // namespace ir::engine
