#include "projects/document_fields.h"
#include "projects/text.h"
#include "projects/value_reader.h"
#include "renderers/core/error.h"
#include "renderers/core/transport.h"

namespace ir::projects {
namespace {

/// Values of an experiment or preset while they are read.
struct Values {
    Settings& values;
    Json& extra_values;
    const MethodDescription* method;  ///< null: unknown, nothing can be checked
};

void read_value(const ObjectReader& group, const std::string& key, const Json& json, Values& into) {
    if (into.values.count(key) != 0 || into.extra_values.contains(key))
        group.fail(key, "stands in both transport and values; remove one");
    const auto value = to_value(json);
    const auto* parameter = into.method ? find(into.method->parameters, key) : nullptr;
    if (parameter && !value) group.fail(key, "must be a plain value, not " + std::string(json.type_name()));
    if (!value) {
        into.extra_values[key] = json;
        return;
    }
    try {
        into.values[key] = parameter ? parameter->checked(*value) : *value;
    } catch (const UsageError& error) {
        group.fail(key, printable(error.what(), 300));
    }
}

/// The groups "transport" and "values". Keys of the transport group that neither this build's transport nor
/// the method knows go to `extra_transport`, so that they are written back where they stood.
void read_groups(ObjectReader& reader, Values into, Json& extra_transport) {
    const Json* transport = reader.take("transport");
    if (transport) {
        ObjectReader group(*transport, reader.file(), reader.pointer_to_member("transport"));
        for (auto it = transport->begin(); it != transport->end(); ++it) {
            const bool is_parameter = into.method && find(into.method->parameters, it.key());
            if (is_transport_key(it.key()) || is_parameter)
                read_value(group, it.key(), *it, into);
            else
                extra_transport[it.key()] = *it;
        }
    }
    if (const Json* own = reader.take("values")) {
        ObjectReader group(*own, reader.file(), reader.pointer_to_member("values"));
        for (auto it = own->begin(); it != own->end(); ++it) read_value(group, it.key(), *it, into);
    }
}

ShaderChanges read_shaders(ObjectReader& reader) {
    ShaderChanges shaders;
    const Json* json = reader.take("shaders");
    if (!json) return shaders;
    ObjectReader group(*json, reader.file(), reader.pointer_to_member("shaders"));
    if (json->size() > most_changed_shaders)
        reader.fail("shaders", "has more than " + std::to_string(most_changed_shaders) + " files");
    for (auto it = json->begin(); it != json->end(); ++it) {
        std::string hunks;
        group.each(it.key(), [&](const Json& line, const std::string& pointer) {
            if (!line.is_string()) throw InputError(reader.file(), pointer, "must be a text in quotes");
            hunks += line.get<std::string>() + "\n";
        });
        if (const auto problem = problem_with_change(it.key(), hunks); !problem.empty())
            group.fail(it.key(), printable(problem, 300));
        shaders[it.key()] = std::move(hunks);
    }
    return shaders;
}

/// The version of the method that an experiment's values are of.
struct VersionRead {
    int version;
    bool
        is_given;  ///< by the file; else it is that of the build, or, in a file of an older schema, the first
};

/// Parameters that the file does not mention have their defaults; or, where they are newer than the file,
/// what made the picture then.
void complete(Experiment& experiment, const MethodDescription& method, const VersionRead& read,
              std::vector<Message>& messages) {
    for (const auto& parameter : method.parameters) {
        if (experiment.values.count(parameter.key) != 0) continue;
        const bool is_newer = parameter.since_version > read.version;
        const bool has_older = is_newer && parameter.value_in_older_projects.has_value();
        const Value value =
            has_older ? parameter.checked(*parameter.value_in_older_projects) : parameter.default_value;
        experiment.values[parameter.key] = value;
        if (!has_older && !(is_newer && read.is_given)) continue;
        const auto since = std::to_string(parameter.since_version);
        messages.push_back(
            {Severity::note, "project",
             "experiment '" + experiment.id + "': " + parameter.key + " was not in the file; " +
                 ir::to_string(value) +
                 (has_older ? " as before version " + since : " (new in version " + since + ")") +
                 " is taken"});
    }
}

Preset read_preset(const Json& json, const ObjectReader& outer, const std::string& pointer,
                   const MethodDescription* method) {
    ObjectReader reader(json, outer.file(), pointer);
    Preset preset;
    read_fields(reader, preset, preset_fields());
    read_groups(reader, {preset.values, preset.extra_values, method}, preset.extra_transport);
    preset.extra = reader.rest();
    return preset;
}

void read_presets(ObjectReader& reader, Experiment& experiment, const MethodDescription* method) {
    const auto* presets = reader.take("presets");
    if (presets) {
        ObjectReader group(*presets, reader.file(), reader.pointer_to_member("presets"));
        for (auto it = presets->begin(); it != presets->end(); ++it)
            experiment.presets[it.key()] =
                read_preset(*it, reader, group.pointer_to_member(it.key()), method);
    }
    experiment.active_preset = reader.text("active_preset");
    if (!experiment.active_preset.empty() && experiment.presets.count(experiment.active_preset) == 0)
        reader.fail("active_preset", "'" + printable(experiment.active_preset, 60) +
                                         "' is not among the presets; add it there");
}

}  // namespace

std::optional<Value> to_value(const Json& json) {
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_string()) return json.get<std::string>();
    if (json.is_number_float()) return json.get<double>();
    if (json.is_number_unsigned() && json.get<std::uint64_t>() > std::uint64_t{1} << 62) return std::nullopt;
    if (json.is_number_integer()) return json.get<std::int64_t>();
    return std::nullopt;
}

Experiment read_experiment(ObjectReader& reader, const Registry& registry, int schema_in_file,
                           std::vector<Message>& messages) {
    Experiment e;
    e.id = reader.required_id("id");
    e.name = reader.text("name", e.id);
    e.notes = reader.text("notes");
    e.scene = reader.text("scene");
    e.camera = reader.text("camera");
    e.lights = reader.text("lights", e.lights);
    e.method = reader.required_text("method");
    const auto* method = registry.find(e.method);
    const int newest = method ? method->version : 1;
    const bool has_version = reader.has("method_version");
    e.method_version = static_cast<int>(reader.integer("method_version", newest, 1, 1'000'000));
    read_groups(reader, {e.values, e.extra_values, method}, e.extra_transport);
    const bool is_older = !has_version && schema_in_file < schema_version;
    if (method) complete(e, *method, {is_older ? 1 : e.method_version, has_version}, messages);
    e.shaders = read_shaders(reader);
    read_fields(reader, e, experiment_fields());
    e.reference = reader.text("reference");
    read_presets(reader, e, method);
    reader.take("last_kept_key");  // of version 0.1; the index of the results says it
    return e;
}

}  // namespace ir::projects
