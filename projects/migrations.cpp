#include "projects/migrations.h"

#include <map>
#include <numbers>

#include "projects/document.h"
#include "projects/document_json.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"
#include "renderers/core/transport.h"

namespace ir::projects {
namespace {

/// `json` with the member `from` replaced by `to` = `value`, at its place.
void replace_member(Json& object, const std::string& from, const std::string& to, Json value) {
    Json result = Json::object();
    for (auto it = object.begin(); it != object.end(); ++it) {
        if (it.key() == from)
            result[to] = std::move(value);
        else
            result[it.key()] = std::move(*it);
    }
    object = std::move(result);
}

template <class Change>
void for_each_object(Json& project, const char* list, Change change) {
    const auto found = project.find(list);
    if (found == project.end() || !found->is_array()) return;
    for (auto& item : *found)
        if (item.is_object()) change(item);
}

/// Schema 1 knew scenes of one file: {"file": …, "hash": …}.
void scene_1_to_2(Json& scene) {
    if (!scene.contains("file") || scene.contains("parts")) return;
    Json part = Json::object({{"source", scene["file"]}});
    if (scene.contains("hash")) part["content_hash"] = scene["hash"];
    scene.erase("hash");
    replace_member(scene, "file", "parts", Json::array({part}));
}

/// Schema 1 wrote the field of view in radians.
void camera_1_to_2(Json& camera) {
    const auto found = camera.find("fov_y");
    if (found == camera.end() || !found->is_number() || camera.contains("fov_y_degrees")) return;
    const double degrees = found->get<double>() * 180 / std::numbers::pi;
    replace_member(camera, "fov_y", "fov_y_degrees", degrees);
}

/// Schema 1 wrote lights as on the command line.
void lights_1_to_2(Json& set) {
    const auto lights = set.find("lights");
    if (lights == set.end() || !lights->is_array()) return;
    for (auto& light : *lights) {
        if (!light.is_string()) continue;
        try {
            light = to_json(parse_light(light.get_ref<const std::string&>()));
        } catch (const UsageError&) {
            // Left as it is: the reader refuses it and names its place.
        }
    }
}

/// Schema 1 had "resolution": "WxH" and one group for all values.
void experiment_1_to_2(Json& experiment) {
    const auto resolution = experiment.find("resolution");
    if (resolution != experiment.end() && resolution->is_string() && !experiment.contains("size")) {
        try {
            const auto size = parse_size(resolution->get_ref<const std::string&>(), "resolution");
            replace_member(experiment, "resolution", "size", Json::array({size.x, size.y}));
        } catch (const UsageError&) {
            replace_member(experiment, "resolution", "size", *resolution);  // the reader refuses it there
        }
    }
    const auto values = experiment.find("values");
    if (values == experiment.end() || !values->is_object() || experiment.contains("transport")) return;
    Json transport = Json::object(), own = Json::object();
    for (auto it = values->begin(); it != values->end(); ++it)
        (is_transport_key(it.key()) ? transport : own)[it.key()] = *it;
    experiment["values"] = std::move(own);
    experiment["transport"] = std::move(transport);
}

void project_1_to_2(Json& project) {
    for_each_object(project, "scenes", scene_1_to_2);
    for_each_object(project, "cameras", camera_1_to_2);
    for_each_object(project, "lights", lights_1_to_2);
    for_each_object(project, "experiments", experiment_1_to_2);
}

/// Schema 2 had no plots: what stands there is somebody's own key and is kept as one.
void project_2_to_3(Json& project) {
    const auto found = project.find("plots");
    if (found == project.end()) return;
    std::string key = "plots_of_schema_2";
    while (project.contains(key)) key += '_';
    replace_member(project, "plots", key, *found);
}

/// Schema 3 knew motions of cameras alone; "moves" and "loop" were somebody's own keys.
void motion_3_to_4(Json& motion) {
    for (const char* key : {"moves", "loop"}) {
        const auto found = motion.find(key);
        if (found == motion.end()) continue;
        std::string kept = std::string(key) + "_of_schema_3";
        while (motion.contains(kept)) kept += '_';
        replace_member(motion, key, kept, *found);
    }
    motion["moves"] = "camera";
}

void project_3_to_4(Json& project) {
    for_each_object(project, "motion", motion_3_to_4);
}

/// Keys of parameters and outputs of some methods, by the name that they had.
using Renamed = std::map<std::string, std::string>;

void rename_keys(Json& values, const Renamed& names) {
    if (!values.is_object()) return;
    for (const auto& [from, to] : names)
        if (values.contains(from) && !values.contains(to)) replace_member(values, from, to, values[from]);
}

void rename_text(Json& object, const char* member, const Renamed& names) {
    const auto found = object.find(member);
    if (found == object.end() || !found->is_string()) return;
    const auto name = names.find(found->get<std::string>());
    if (name != names.end()) *found = name->second;
}

/// Wherever they stand.
void rename(Json& project, const Renamed& names) {
    for_each_object(project, "experiments", [&](Json& experiment) {
        if (const auto values = experiment.find("values"); values != experiment.end())
            rename_keys(*values, names);
        const auto presets = experiment.find("presets");
        if (presets == experiment.end() || !presets->is_object()) return;
        for (auto& preset : *presets)
            if (preset.is_object() && preset.contains("values")) rename_keys(preset["values"], names);
    });
    for_each_object(project, "comparisons",
                    [&](Json& comparison) { rename_text(comparison, "output", names); });
    for_each_object(project, "plots", [&](Json& plot) { rename_text(plot, "over", names); });
    for_each_object(project, "sweeps", [&](Json& sweep) {
        for_each_object(sweep, "axes", [&](Json& axis) { rename_text(axis, "key", names); });
    });
}

void project_4_to_5(Json& project) {
    rename(project, {{"least_distance", "min_distance"},
                     {"least_roughness", "min_roughness"},
                     {"largest_dip", "max_dip"},
                     {"greatest_axis", "max_axis"},
                     {"hierarchy.least", "hierarchy.min"},
                     {"least_axis_pixels", "min_axis_pixels"},
                     {"hierarchy.most", "hierarchy.max"}});
}

void project_5_to_6(Json& project) {
    rename(project, {{"radius_min", "min_radius"},
                     {"radius_max", "max_radius"},
                     {"radius_texels", "min_radius_texels"},
                     {"ray_length_floor", "min_ray_length_scale"},
                     {"stretch_max", "max_stretch"}});
}

int schema_of(const Json& project, const std::string& file) {
    const auto found = project.find("schema");
    if (found == project.end() || !found->is_number_integer())
        throw InputError(file, "/schema", "is missing or no integer; this is no Interreflect project");
    const auto schema = found->get<std::int64_t>();
    if (schema > schema_version || (found->is_number_unsigned() && schema < 0))
        throw InputError(file, "/schema",
                         "is newer than the " + std::to_string(schema_version) +
                             " that this build reads; open it with a newer Interreflect");
    if (schema < 1) throw InputError(file, "/schema", "must be at least 1");
    return static_cast<int>(schema);
}

}  // namespace

const std::vector<Migration>& migrations() {
    static const std::vector<Migration> steps{
        {1,
         "scenes consist of parts, fields of view are in degrees, lights are structured, sizes are pairs, "
         "transport values are a group",
         project_1_to_2},
        {2, "projects have plots of the error", project_2_to_3},
        {3, "motions say what they move: cameras, lights or parts of scenes", project_3_to_4},
        {4, "keys of parameters and outputs say min and max", project_4_to_5},
        {5, "keys of parameters begin with min and max", project_5_to_6},
    };
    return steps;
}

int migrate(Json& project, const std::string& file, std::vector<Message>& messages) {
    const int schema_in_file = schema_of(project, file);
    for (int schema = schema_in_file; schema < schema_version; ++schema) {
        const auto& step = migrations().at(static_cast<std::size_t>(schema - 1));
        step.apply(project);
        project["schema"] = schema + 1;
        messages.push_back({Severity::note, "project",
                            "upgraded from schema " + std::to_string(schema) + " to " +
                                std::to_string(schema + 1) + ": " + step.summary});
    }
    return schema_in_file;
}

}  // namespace ir::projects
