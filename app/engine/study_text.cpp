#include "app/engine/error_study.h"
#include "app/engine/measure.h"
#include "app/engine/number_text.h"
#include "projects/object_reader.h"
#include "renderers/core/limits.h"

namespace ir::engine {
namespace {

using projects::Json;
using projects::ObjectReader;

Json point_json(const ErrorPoint& point) {
    Json json{{"experiment", point.experiment}, {"value", point.value}, {"frames", point.frames}};
    if (!point.problem.empty()) {
        json["problem"] = point.problem;
        return json;
    }
    json["ms"] = point.ms;
    put_errors(json, point.errors, point.pixels);
    json["pixels"] = point.pixels;
    json["skipped"] = point.skipped;
    json["memory_bytes"] = point.memory_bytes;
    json["on_front"] = point.on_front;
    return json;
}

ErrorPoint read_point(ObjectReader& reader) {
    ErrorPoint point;
    point.experiment = reader.required_text("experiment");
    if (const auto* value = reader.take("value")) point.value = *value;
    point.frames = int(reader.integer("frames", 1, 1, max_frames));
    point.problem = reader.text("problem");
    point.ms = reader.number("ms", 0, 0);
    point.errors = read_errors(reader);
    point.pixels = reader.natural("pixels", 0);
    point.skipped = reader.natural("skipped", 0);
    point.memory_bytes = reader.natural("memory_bytes", 0);
    point.on_front = reader.flag("on_front", false);
    return point;
}

}  // namespace

std::string study_json(const ErrorStudy& study) {
    Json json{{"plot", study.plot}, {"device", study.device}, {"metrics", study.metrics}};
    json["reference_noise"] = number_json(study.reference_noise);
    if (!study.notes.empty()) json["notes"] = study.notes;
    json["points"] = Json::array();
    for (const auto& point : study.points) json["points"].push_back(point_json(point));
    return projects::pretty_json(json);
}

ErrorStudy study_from_json(const std::string& text, const std::string& file) {
    const Json json = projects::parse_json(text, file);
    ObjectReader reader(json, file, "");
    ErrorStudy study;
    study.plot = reader.text("plot");
    study.device = reader.text("device");
    study.metrics = read_texts(reader, "metrics");
    if (const auto* noise = reader.take("reference_noise"))
        study.reference_noise = number_from(*noise, "", reader, "reference_noise");
    study.notes = read_texts(reader, "notes");
    reader.each("points", [&](const Json& item, const std::string& pointer) {
        ObjectReader inner(item, file, pointer);
        study.points.push_back(read_point(inner));
    });
    return study;
}

std::string study_csv(const ErrorStudy& study) {
    std::string text = "experiment,value,frames,ms";
    for (const auto& metric : study.metrics) text += "," + csv_field(metric);
    text += ",pixels,skipped,memory_bytes,on_front,problem\r\n";
    for (const auto& point : study.points) {
        const bool is_there = point.problem.empty();
        text += csv_field(point.experiment) + "," + csv_value(point.value) + "," +
                std::to_string(point.frames) + "," + (is_there ? csv_number(point.ms) : "");
        for (const auto& metric : study.metrics) {
            const auto error = point.errors.find(metric);
            text += "," + (is_there && error != point.errors.end() ? csv_number(error->second) : "");
        }
        for (const auto count :
             {std::uint64_t(point.pixels), std::uint64_t(point.skipped), point.memory_bytes})
            text += "," + (is_there ? std::to_string(count) : "");
        text += std::string(",") + (point.on_front ? "1" : "0") + "," + csv_field(point.problem) + "\r\n";
    }
    return text;
}

}  // namespace ir::engine
