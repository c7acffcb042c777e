#include "renderers/scene/scene.h"

#include "app/python/bindings.h"
#include "app/python/convert.h"
#include "app/python/machine.h"

namespace ir::python {
namespace {

using ScenePtr = std::shared_ptr<scene::Scene>;

/// The file as it is now, for the machine's renderings, too.
ScenePtr load(const py::object& source, const std::shared_ptr<Machine>& machine) {
    const auto name = to_path(source);
    const auto chosen = machine ? machine : Machine::standard();
    Watch watch{py::none(), py::none()};
    const auto scene = watch.around([&] {
        return chosen->use(watch, [&](engine::Machine& m) {
            m.scenes().forget(name);
            return m.scenes().load(name);
        });
    });
    return std::const_pointer_cast<scene::Scene>(scene);  // Python only reads it
}

template <class Items>
py::list names_of(const Items& items) {
    py::list names;
    for (const auto& item : items) names.append(item.name);
    return names;
}

py::tuple vector_of(const glm::vec3& v) {
    return py::make_tuple(v.x, v.y, v.z);
}

}  // namespace

void add_scene(py::module_& module) {
    using scene::Scene;
    py::class_<Scene, ScenePtr>(
        module, "Scene",
        "A scene: a .gltf or .glb file, or builtin:NAME. It is read anew, also for the "
        "renderings of the machine that follow; they read a file once.")
        .def(py::init(&load), py::arg("source"), py::kw_only(), py::arg("machine") = nullptr)
        .def_readonly("name", &Scene::name, "As it was asked for")
        .def_readonly("content_hash", &Scene::content_hash, "Of everything in its files")
        .def_property_readonly("triangles", &Scene::instanced_triangles, "As many as are drawn")
        .def_property_readonly("duration", &Scene::duration, "Of its animation in seconds; 0: nothing moves")
        .def_property_readonly("cameras", [](const Scene& s) { return names_of(s.cameras); })
        .def_property_readonly("lights", [](const Scene& s) { return names_of(s.lights); })
        .def_property_readonly("materials", [](const Scene& s) { return names_of(s.materials); })
        .def_property_readonly(
            "bounds",
            [](const Scene& s) {
                const auto bounds = scene::bounds_of(s, 0);
                return py::make_tuple(vector_of(bounds.min), vector_of(bounds.max));
            },
            "Least and largest corner in metres, at time 0")
        .def_property_readonly(
            "warnings",
            [](const Scene& s) {
                py::list texts;
                for (const auto& warning : s.warnings) texts.append(warning.text);
                return texts;
            },
            "What the loader had to leave out, a line each")
        .def("__fspath__", [](const Scene& s) { return s.name; })
        .def("__repr__", [](const Scene& s) { return "<Scene '" + s.name + "'>"; });
}

}  // namespace ir::python
