#include <algorithm>
#include <set>

#include "projects/document_fields.h"
#include "projects/document_json.h"
#include "projects/migrations.h"
#include "projects/object_reader.h"
#include "projects/text.h"
#include "projects/validate.h"
#include "projects/value_reader.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

/// "notes" and the like may be empty; names default to the id.
template <class Item>
void read_head(ObjectReader& reader, Item& item) {
    item.id = reader.required_id("id");
    item.name = reader.text("name", item.id);
}

std::optional<std::array<double, 16>> read_transform(ObjectReader& reader) {
    const auto* json = reader.take("transform");
    if (!json) return std::nullopt;
    const bool good = json->is_array() && json->size() == 16 &&
                      std::all_of(json->begin(), json->end(), [](const Json& n) { return n.is_number(); });
    if (!good) reader.fail("transform", "must be an array of 16 numbers, column by column");
    return json->get<std::array<double, 16>>();
}

std::map<std::string, MaterialOverride> read_materials(ObjectReader& reader) {
    std::map<std::string, MaterialOverride> materials;
    const auto* json = reader.take("materials");
    if (!json) return materials;
    ObjectReader group(*json, reader.file(), reader.pointer_to_member("materials"));
    for (auto it = json->begin(); it != json->end(); ++it) {
        ObjectReader inner(*it, reader.file(), group.pointer_to_member(it.key()));
        auto& change = materials[it.key()];
        read_fields(inner, change, material_fields());
        change.extra = inner.rest();
    }
    return materials;
}

Scene read_scene(ObjectReader& reader) {
    Scene scene;
    read_head(reader, scene);
    reader.each("parts", [&](const Json& json, const std::string& pointer) {
        ObjectReader inner(json, reader.file(), pointer);
        ScenePart part;
        read_fields(inner, part, part_fields());
        part.transform = read_transform(inner);
        part.materials = read_materials(inner);
        part.extra = inner.rest();
        scene.parts.push_back(std::move(part));
    });
    if (scene.parts.empty()) reader.fail("parts", "is missing or empty; give at least one {\"source\": …}");
    return scene;
}

/// What binds several fields of an item, for the whole of it.
template <class Item>
void check(const ObjectReader& reader, const Item& item) {
    try {
        validate(item);
    } catch (const UsageError& error) {
        throw InputError(reader.file(), reader.pointer(), error.what());
    }
}

/// Reads an item that is nothing but its fields.
template <class Item>
auto read_with(const Fields<Item>& fields) {
    return [&fields](ObjectReader& reader) {
        Item item;
        read_head(reader, item);
        read_fields(reader, item, fields);
        check(reader, item);
        return item;
    };
}

LightSpec::Type read_light_type(ObjectReader& reader) {
    const auto name = reader.required_text("type");
    if (const auto type = light_type_of(name)) return *type;
    reader.fail("type", "'" + printable(name, 60) + "' is no light; give " + light_type_names());
}

void read_strength(ObjectReader& reader, LightSpec& light) {
    int given = 0;
    const auto allowed = allowed_quantities(light.type);
    for (const auto quantity : allowed) {
        const auto& text = quantity_text(quantity);
        if (!reader.has(text.key)) continue;
        light.quantity = quantity;
        read_value(reader, text, &light.amount);
        ++given;
    }
    if (given == 1) return;
    reader.fail(to_string(allowed.front()), given == 0 ? "is missing; give the light's strength"
                                                       : "stands beside flux; give one of them");
}

LightSpec read_light(ObjectReader& reader) {
    LightSpec light;
    light.type = read_light_type(reader);
    read_strength(reader, light);
    read_fields(reader, light, light_fields());
    check(reader, light);
    return light;
}

Environment read_environment(ObjectReader& reader) {
    Environment environment;
    const auto* json = reader.take("environment");
    if (!json || *json == "scene") return environment;
    if (json->is_array()) {
        environment.kind = Environment::Kind::constant;
        read_value(reader, constant_environment_text(), &environment.constant);
        return environment;
    }
    if (!json->is_object()) reader.fail("environment", "must be \"scene\", [r, g, b] or {\"source\": FILE}");
    ObjectReader inner(*json, reader.file(), reader.pointer_to_member("environment"));
    environment.kind = Environment::Kind::map;
    read_fields(inner, environment, map_fields());
    environment.extra = inner.rest();
    return environment;
}

LightSet read_light_set(ObjectReader& reader) {
    LightSet set;
    read_head(reader, set);
    if (set.id == scene_lights)
        reader.fail("id", "'scene' stands for the scene's own lights; take another id");
    if (const auto* lights = reader.take("lights"); lights && lights->is_string()) {
        if (*lights != scene_lights)
            reader.fail("lights", "must be \"scene\", or an array of lights that may hold \"scene\", too");
        set.use_scene_lights = true;
    } else {
        reader.each("lights", [&](const Json& json, const std::string& pointer) {
            if (json == scene_lights) {
                set.use_scene_lights = true;
                return;
            }
            ObjectReader inner(json, reader.file(), pointer);
            set.lights.push_back(read_light(inner));
            set.light_extras.push_back(inner.rest());
        });
    }
    set.environment = read_environment(reader);
    return set;
}

Sweep read_sweep(ObjectReader& reader) {
    Sweep sweep;
    read_head(reader, sweep);
    read_fields(reader, sweep, sweep_fields());
    reader.each("axes", [&](const Json& json, const std::string& pointer) {
        ObjectReader inner(json, reader.file(), pointer);
        Sweep::Axis axis;
        read_fields(inner, axis, axis_fields());
        axis.extra = inner.rest();
        sweep.axes.push_back(std::move(axis));
    });
    return sweep;
}

/// A list of items with unique ids; keeps what nobody took of each.
template <class Item, class Read>
std::vector<Item> read_list(ObjectReader& reader, const std::string& key, Read read) {
    std::vector<Item> items;
    std::set<std::string> ids;
    reader.each(key, [&](const Json& json, const std::string& pointer) {
        ObjectReader inner(json, reader.file(), pointer);
        Item item = read(inner);
        if (!ids.insert(item.id).second)
            inner.fail("id", "'" + item.id + "' stands twice in " + key + "; give another id");
        item.extra = inner.rest();
        items.push_back(std::move(item));
    });
    return items;
}

}  // namespace

ReadProject read_project(const std::string& text, const std::string& file, const Registry& registry) {
    ReadProject result;
    Json json = parse_json(text, file);
    if (!json.is_object())
        throw InputError(file, "", "is no project; a project is an object {…} with a schema");
    result.schema_in_file = migrate(json, file, result.messages);

    ObjectReader reader(json, file, "");
    Project& project = result.project;
    reader.take("schema");
    project.name = reader.text("name");
    project.notes = reader.text("notes");
    project.scenes = read_list<Scene>(reader, "scenes", read_scene);
    project.cameras = read_list<Camera>(reader, "cameras", read_with(camera_fields()));
    project.lights = read_list<LightSet>(reader, "lights", read_light_set);
    project.motion = read_list<Motion>(reader, "motion", [](ObjectReader& inner) {
        Motion motion;
        read_head(inner, motion);
        read_motion(inner, motion);
        return motion;
    });
    project.images = read_list<ForeignImage>(reader, "images", read_with(image_fields()));
    project.experiments = read_list<Experiment>(reader, "experiments", [&](ObjectReader& inner) {
        return read_experiment(inner, registry, result.schema_in_file, result.messages);
    });
    project.comparisons = read_list<Comparison>(reader, "comparisons", read_with(comparison_fields()));
    project.sweeps = read_list<Sweep>(reader, "sweeps", read_sweep);
    project.plots = read_list<ErrorPlot>(reader, "plots", read_with(plot_fields()));
    project.analyses = read_list<Analysis>(reader, "analyses", read_with(analysis_fields()));
    project.shaders_allowed = reader.flag("shaders_allowed", true);
    project.extra = reader.rest();
    return result;
}

}  // namespace ir::projects
