#include "app/python/experiment.h"

#include <pybind11/stl.h>

#include "app/engine/from_project.h"
#include "app/engine/moving.h"
#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "app/python/bindings.h"
#include "app/python/convert.h"
#include "projects/document_fields.h"
#include "projects/document_json.h"
#include "projects/match.h"
#include "projects/recipe.h"
#include "projects/samples.h"
#include "projects/validate.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"

namespace ir::python {
namespace {

using projects::Json;

/// What the document's readers refuse comes from the caller here, not from a file.
template <class Read>
auto as_usage(Read read) {
    try {
        return read();
    } catch (const InputError& error) {
        throw UsageError(error.what());
    }
}

const std::string& field_doc(const char* key) {
    return projects::field_of(projects::experiment_fields(), key).text.doc;
}

projects::Camera read_camera(const py::object& pose) {
    const auto json = to_json(pose, "camera");
    return as_usage([&] {
        projects::ObjectReader reader(json, "camera", "");
        projects::Camera camera;
        read_fields(reader, camera, projects::camera_fields());
        const auto unknown = reader.rest();
        if (!unknown.empty()) {
            const auto known = words_of(projects::camera_fields(), [](const auto& f) { return f.text.key; });
            throw UsageError("camera: unknown '" + unknown.begin().key() + "'" +
                             known_are(unknown.begin().key(), known));
        }
        if (camera.name.empty()) camera.name = "camera";
        camera.id = projects::free_id("camera", {});
        validate(camera);
        return camera;
    });
}

/// A set of lights as the document has it, each light perhaps a text of the command line's.
projects::LightSet read_lights(const Json& lights, const Json& environment) {
    Json set{{"id", "lights"}, {"name", "lights"}, {"lights", lights}, {"environment", environment}};
    if (lights.is_array())
        for (auto& light : set["lights"])
            if (light.is_string() && light != projects::scene_lights)
                light = projects::to_json(projects::parse_light(light.get<std::string>()));
    const Json document{{"schema", projects::schema_version}, {"lights", {set}}};
    return as_usage([&] {
        const auto project =
            projects::read_project(document.dump(), "lights and environment", engine::registry()).project;
        for (const auto& unknown : projects::unknown_keys(project, engine::registry()))
            throw UsageError("lights and environment: " + unknown + " is unknown");
        return project.lights.front();
    });
}

Json environment_json(const py::object& environment) {
    if (environment.is_none()) return "scene";
    if (py::isinstance<py::str>(environment) || py::hasattr(environment, "__fspath__")) {
        const auto file = to_path(environment);
        return file == "scene" ? Json(file) : Json{{"source", std::filesystem::absolute(file).string()}};
    }
    return to_json(environment, "environment");
}

Inspection inspection_of(const Experiment& experiment, const std::optional<std::pair<int, int>>& pick,
                         const std::map<std::string, py::object>& choose) {
    Inspection inspection;
    const auto& size = experiment.item().size;
    if (pick) {
        const auto [x, y] = *pick;
        if (x < 0 || y < 0 || x >= size.x || y >= size.y)
            throw UsageError("pick: " + std::to_string(x) + "," + std::to_string(y) +
                             " lies outside the picture of " + std::to_string(size.x) + "x" +
                             std::to_string(size.y) + " pixels");
        inspection.x = x;
        inspection.y = y;
    }
    const auto& method = experiment.method();
    const auto settings = projects::runnable_settings(experiment.item(), method);
    for (const auto& [key, item] : choose) {
        const auto selector = std::find_if(method.selectors.begin(), method.selectors.end(),
                                           [&key = key](const auto& known) { return known.key == key; });
        if (selector == method.selectors.end())
            throw UsageError("choose: unknown '" + key + "'" +
                             known_are(key, words_of(method.selectors, &SelectorDescription::key)));
        const auto count = count_of(*selector, settings);
        const auto value = to_value(item, "choose: " + key);
        const auto* index = std::get_if<std::int64_t>(&value);
        if (value != Value{std::string("all")} && (!index || *index < 0 || *index >= count))
            throw UsageError("choose: " + key + ": give 0 to " + std::to_string(count - 1) + " or 'all'");
        inspection.chosen[key] = index ? static_cast<int>(*index) : Inspection::all;
    }
    return inspection;
}

PicturePtr render(const Experiment& experiment, const py::object& outputs, const py::object& progress,
                  const py::object& cancel, const std::optional<std::pair<int, int>>& pick,
                  const std::map<std::string, py::object>& choose, const std::shared_ptr<Machine>& chosen) {
    const auto machine = chosen ? chosen : Machine::standard();
    const auto resolved = experiment.resolved();
    const auto inspection = inspection_of(experiment, pick, choose);
    Watch watch(progress, cancel);
    graph::FrameOptions options;
    options.wanted = to_texts(outputs);
    options.memory_budget = machine->memory_budget();
    options.cancel = watch.token();
    options.progress = watch.callback();
    return watch.around([&] {
        return machine->use(watch, [&](engine::Machine& m) {
            engine::Execution execution(m, resolved);
            execution.inspect(inspection);
            const auto report = engine::run_frames(execution, options);
            engine::require_matches("outputs:", options.wanted, report);
            return picture_of(execution, report, options.wanted);
        });
    });
}

py::dict values_of(const Experiment& experiment) {
    py::dict values;
    for (const auto& [key, value] : projects::runnable_settings(experiment.item(), experiment.method()))
        values[py::str(key)] = to_python(value);
    return values;
}

std::string text_of(const Experiment& experiment) {
    const auto size = experiment.item().size;
    return "<Experiment " + experiment.method().id + " of '" + experiment.scene() + "', " +
           std::to_string(size.x) + "x" + std::to_string(size.y) + ">";
}

Experiment made(const std::string& method, const py::object& scene, const py::kwargs& changes) {
    Experiment experiment(method, to_path(scene));
    experiment.set(changes);
    return experiment;
}

Experiment copied(const Experiment& experiment, const py::kwargs& changes) {
    auto copy = experiment;
    copy.set(changes);
    return copy;
}

}  // namespace

Experiment::Experiment(const std::string& method, const std::string& scene)
    : project_(engine::project_of(scene, method)), id_(project_.experiments.front().id), is_single_(true) {}

Experiment::Experiment(projects::Project project, const std::string& id, std::filesystem::path folder)
    : project_(std::move(project)), id_(id), folder_(std::move(folder)) {
    item() = projects::effective(item());
}

const projects::Experiment& Experiment::item() const {
    return *find_item(project_.experiments, id_);
}
projects::Experiment& Experiment::item() {
    return *find_item(project_.experiments, id_);
}

const MethodDescription& Experiment::method() const {
    return engine::registry().at(item().method);
}

std::string Experiment::scene() const {
    if (is_single_) return project_.scenes.front().parts.front().source;
    return item().scene;
}

py::object Experiment::value(const std::string& key) const {
    if (const auto* field = find_field(projects::experiment_fields(), key)) {
        Json json = Json::object();
        auto copy = item();
        write_value(json, field->text, field->slot(copy), field->slot(copy));
        return to_python(json.at(key).dump());
    }
    parameter_named(method().parameters, key);
    return to_python(projects::runnable_settings(item(), method()).at(key));
}

void Experiment::set(const std::string& key, const py::object& value) {
    py::dict change;
    change[py::str(key)] = value;
    set(change);
}

void Experiment::set(const py::dict& changes) {
    auto changed = *this;
    std::optional<py::object> lights, environment;
    for (const auto& [name, given] : changes) {
        const auto key = name.cast<std::string>();
        const auto value = py::reinterpret_borrow<py::object>(given);
        if (key == "camera")
            changed.set_camera(value);
        else if (key == "lights")
            lights = value;
        else if (key == "environment")
            environment = value;
        else if (find_field(projects::experiment_fields(), key))
            changed.set_field(key, value);
        else
            changed.item().values[key] = parameter_named(changed.method().parameters, key)
                                             .checked(to_value(value, "parameter '" + key + "'"));
    }
    if (lights || environment)
        changed.set_lights(lights ? &*lights : nullptr, environment ? &*environment : nullptr);
    validate(changed.item());
    *this = std::move(changed);
}

void Experiment::set_field(const std::string& key, const py::object& value) {
    const auto& field = projects::field_of(projects::experiment_fields(), key);
    Json json = Json::object();
    json[key] = to_json(value, key);
    as_usage([&] {
        projects::ObjectReader reader(json, "experiment", "");
        read_value(reader, field.text, field.slot(item()));
    });
}

void Experiment::set_camera(const py::object& camera) {
    if (camera.is_none())
        item().camera.clear();
    else if (py::isinstance<py::str>(camera))
        engine::choose_camera(project_, item(), camera.cast<std::string>());
    else
        engine::add_camera(project_, item(), read_camera(camera));
}

/// A new set; what is not given is as in the set before.
void Experiment::set_lights(const py::object* lights, const py::object* environment) {
    if (lights && py::isinstance<py::str>(*lights) &&
        find_item(project_.lights, lights->cast<std::string>()) && !environment) {
        item().lights = lights->cast<std::string>();
        return;
    }
    projects::LightSet set;
    set.use_scene_lights = true;
    if (const auto* before = find_item(project_.lights, item().lights)) set = *before;
    const auto given = read_lights(lights ? to_json(*lights, "lights") : Json(projects::scene_lights),
                                   environment ? environment_json(*environment) : Json("scene"));
    if (lights) {
        set.lights = given.lights;
        set.light_extras = given.light_extras;
        set.use_scene_lights = given.use_scene_lights;
    }
    if (environment) set.environment = given.environment;
    set.name = "light";
    set.id = item().lights = projects::free_id_in(project_.lights, set.name);
    project_.lights.push_back(std::move(set));
}

engine::Experiment Experiment::resolved() const {
    if (is_single_) return engine::from_single(project_);
    return engine::from_project(project_, item(), folder_);
}

Experiment Experiment::match(std::uint64_t samples, const std::shared_ptr<Machine>& machine) const {
    const auto& registry = engine::registry();
    auto result = *this;
    if (is_single_) {
        result.item() = projects::ground_truth(item(), registry);
    } else {
        const auto chosen = machine ? machine : Machine::standard();
        Watch watch{py::none(), py::none()};
        const auto before = *this;  // another thread may change this one meanwhile
        result.item() = watch.around([&] {
            return chosen->use(watch, [&](engine::Machine& m) {
                const auto facts = engine::scene_facts(m.scenes(), before.project_, before.folder_);
                return projects::matching_reference(before.project_, before.item(), registry,
                                                    facts.is_animated);
            });
        });
        result.item().id = id_;
    }
    if (samples > 0) result.item() = projects::with_sample_count(result.item(), samples, registry);
    return result;
}

void add_experiment(py::module_& module) {
    const auto doc =
        "One scene by one method. Keywords are the method's parameters (describe(method) lists them), and\n\n"
        "size: " +
        field_doc("size") + "\nseed: " + field_doc("seed") + "\nframes: " + field_doc("frames") +
        "\ntime: " + field_doc("time") +
        "\ncamera: name of one of the scene's, id of one of the project's, or a dict such as "
        "{'eye': (0, 1, 5), 'target': (0, 1, 0), 'fov_y_degrees': 45}"
        "\nlights: 'scene', or a list of lights as the command line's --light or a project's document has "
        "them; 'scene' in the list stands for the scene's"
        "\nenvironment: radiance (r, g, b), a file, or 'scene'";
    const auto item_text = "A parameter's value, or that of size, seed, frames or time";
    py::class_<Experiment> type(module, "Experiment", doc.c_str());
    type.def(py::init(&made), py::arg("method"), py::arg("scene"))
        .def_property_readonly("method", [](const Experiment& e) { return e.method().id; })
        .def_property_readonly("scene", &Experiment::scene, "As it was asked for; of a project its id")
        .def_property_readonly("values", &values_of, "All parameters and their values")
        .def("__getitem__", &Experiment::value, py::arg("key"), item_text)
        .def("__setitem__", py::overload_cast<const std::string&, const py::object&>(&Experiment::set),
             py::arg("key"), py::arg("value"), item_text)
        .def(
            "set", [](Experiment& e, const py::kwargs& changes) { e.set(changes); },
            "Changes what is named, as the keywords of Experiment do. All or nothing.")
        .def("copy", &copied, "Another experiment, with changes as the keywords of Experiment do them")
        .def("match", &Experiment::match, py::arg("samples") = 0, py::kw_only(), py::arg("machine") = nullptr,
             "The ground truth that it is judged by: the same transport by the reference")
        .def(
            "document",
            [](const Experiment& e) {
                return to_python(
                    projects::to_json(projects::recipe_of(e.project(), e.item(), e.folder())).dump());
            },
            "All that is needed to render it again: a project document of this experiment alone, as a dict")
        .def("render", &render, py::arg("outputs") = py::tuple(), py::kw_only(),
             py::arg("progress") = py::none(), py::arg("cancel") = py::none(), py::arg("pick") = py::none(),
             py::arg("choose") = std::map<std::string, py::object>(), py::arg("machine") = nullptr,
             "Renders all frames.\n\n"
             "outputs: patterns of the buffers to keep beside the main result, such as 'gbuffer.*'\n"
             "progress: called as progress(text, fraction) while it works; an exception of it ends the work\n"
             "cancel: an event, such as threading.Event, that ends the work with Cancelled once it is set\n"
             "pick: pixel (x, y) that outputs which explain are computed for\n"
             "choose: items that such outputs show, by selector\n"
             "machine: what renders; None: one that all share\n\n"
             "Other threads of Python run meanwhile, and Ctrl-C ends it.")
        .def("__repr__", &text_of);
    for (const char* key : {"size", "seed", "frames", "time"})
        type.def_property(
            key,
            [key](const Experiment& e) {
                auto value = e.value(key);
                return py::isinstance<py::list>(value) ? py::object(py::tuple(value)) : value;
            },
            [key](Experiment& e, const py::object& value) { e.set(key, value); }, field_doc(key).c_str());
}

}  // namespace ir::python
