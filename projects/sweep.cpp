#include "projects/sweep.h"

#include <cstdio>

#include "projects/object_reader.h"
#include "projects/text.h"
#include "projects/validate.h"
#include "projects/value_reader.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

constexpr std::size_t most_points = 100'000;

[[noreturn]] void refuse(const Sweep& sweep, const std::string& problem) {
    throw UsageError("sweep '" + sweep.id + "': " + problem);
}

void set_parameter(Experiment& e, const MethodDescription& method, const std::string& key, const Json& json) {
    const auto* parameter = find(method.parameters, key);
    if (!parameter)
        throw UsageError("'" + printable(key, 60) + "' is neither a parameter of " + method.id +
                         " nor size, seed, frames, time, camera, lights or scene");
    const auto value = to_value(json);
    if (!value) throw UsageError("parameter '" + key + "' needs plain values");
    e.values[key] = parameter->checked(*value);
}

template <class List>
std::string known_id(const List& list, const Json& json, const std::string& none, const std::string& key) {
    if (json.is_string() && (json == none || find_item(list, json.get<std::string>()))) return json;
    throw UsageError("'" + printable(canonical_json(json), 60) + "' is no id for " + key);
}

/// One coordinate put into the experiment. The readers' messages already name the key.
void set_coordinate(Experiment& e, const Project& project, const MethodDescription& method,
                    const std::string& key, const Json& json) {
    const Json object = Json::object({{key, json}});
    const std::string file = "value";
    ObjectReader reader(object, file, "");
    if (key == "size")
        e.size = reader.optional_size(key).value_or(e.size);
    else if (key == "seed")
        e.seed = reader.natural(key, e.seed);
    else if (key == "frames")
        e.frames = static_cast<int>(reader.integer(key, e.frames, 1, 1'000'000'000));
    else if (key == "time")
        e.time = reader.number(key, e.time);
    else if (key == "scene")
        e.scene = known_id(project.scenes, json, "", key);
    else if (key == "camera")
        e.camera = known_id(project.cameras, json, "", key);
    else if (key == "lights")
        e.lights = known_id(project.lights, json, scene_lights, key);
    else
        set_parameter(e, method, key, json);
}

std::size_t count_points(const Sweep& sweep) {
    std::size_t count = 1;
    for (const auto& axis : sweep.axes) {
        if (axis.values.empty()) refuse(sweep, "axis '" + printable(axis.key, 60) + "' has no values");
        count *= axis.values.size();
        if (count > most_points)
            refuse(sweep, "has more than " + std::to_string(most_points) + " points; shorten its axes");
    }
    return count;
}

}  // namespace

std::vector<SweepPoint> sweep_points(const Project& project, const Sweep& sweep, const Registry& registry) {
    const auto* base = find_item(project.experiments, sweep.experiment);
    if (!base) refuse(sweep, "there is no experiment '" + printable(sweep.experiment, 60) + "'");
    const auto& method = registry.at(base->method);
    const auto count = count_points(sweep);
    std::vector<SweepPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        SweepPoint point{effective(*base), Json::object()};
        std::size_t rest = i, block = count;
        for (const auto& axis : sweep.axes) {
            block /= axis.values.size();
            const auto& json = axis.values[rest / block];
            rest %= block;
            try {
                set_coordinate(point.experiment, project, method, axis.key, json);
            } catch (const Error& error) {
                refuse(sweep, printable(error.what(), 300));
            }
            point.coordinates[axis.key] = json;
        }
        char number[16];
        std::snprintf(number, sizeof number, "-%04zu", i + 1);
        point.experiment.id = base->id.substr(0, 90) + number;
        point.experiment.last_kept_key.clear();
        points.push_back(std::move(point));
    }
    return points;
}

std::vector<SweepPoint> shard(const std::vector<SweepPoint>& points, int index, int count) {
    if (count < 1 || index < 1 || index > count)
        throw UsageError("shard: give I/N with I from 1 to N, as in 1/4");
    std::vector<SweepPoint> result;
    for (auto i = static_cast<std::size_t>(index - 1); i < points.size();
         i += static_cast<std::size_t>(count))
        result.push_back(points[i]);
    return result;
}

}  // namespace ir::projects
