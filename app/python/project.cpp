#include "app/python/bindings.h"
#include "app/python/convert.h"
#include "app/python/experiment.h"
#include "projects/document_json.h"
#include "projects/store.h"

namespace ir::python {
namespace {

using projects::LoadedProject;

LoadedProject open(const py::object& path) {
    return projects::load_project(to_path(path), engine::registry());
}

py::dict experiments_of(const LoadedProject& project) {
    py::dict experiments;
    for (const auto& experiment : project.project.experiments)
        experiments[py::str(experiment.id)] = Experiment(project.project, experiment.id, project.folder);
    return experiments;
}

py::dict sweeps_of(const LoadedProject& project) {
    py::dict sweeps;
    for (const auto& sweep : project.project.sweeps) {
        py::dict axes;
        for (const auto& axis : sweep.axes)
            axes[py::str(axis.key)] = to_python(projects::Json(axis.values).dump());
        sweeps[py::str(sweep.id)] = py::make_tuple(sweep.experiment, axes);
    }
    return sweeps;
}

py::list messages_of(const LoadedProject& project) {
    py::list texts;
    for (const auto& message : project.messages) texts.append(message.text);
    for (const auto& message : projects::unknown_key_messages(project.project, engine::registry()))
        texts.append(message.text);
    return texts;
}

}  // namespace

void add_project(py::module_& module) {
    py::class_<LoadedProject>(module, "Project",
                              "A project's folder, as it is read now. Nothing is written to it.")
        .def(py::init(&open), py::arg("folder"))
        .def_property_readonly("name", [](const LoadedProject& p) { return p.project.name; })
        .def_property_readonly("notes", [](const LoadedProject& p) { return p.project.notes; })
        .def_property_readonly("folder", [](const LoadedProject& p) { return p.folder.string(); })
        .def_property_readonly("experiments", &experiments_of,
                               "By id: copies, whose changes stay in them. The active preset is applied.")
        .def_property_readonly("sweeps", &sweeps_of,
                               "By id: the experiment that each varies, and its values by key")
        .def_property_readonly(
            "document", [](const LoadedProject& p) { return to_python(projects::to_json(p.project).dump()); },
            "project.json as a dict")
        .def_property_readonly("messages", &messages_of, "What was changed or not understood, a line each")
        .def("__repr__", [](const LoadedProject& p) { return "<Project '" + p.folder.string() + "'>"; });
}

}  // namespace ir::python
