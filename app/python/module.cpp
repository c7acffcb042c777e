#include "app/engine/version.h"
#include "app/python/bindings.h"

PYBIND11_MODULE(_core, module) {
    module.doc() = "The engine of Interreflect; use the package interreflect.";
    module.attr("__version__") = ir::engine::version();
    module.attr("commit") = ir::engine::commit();
    ir::python::add_errors(module);
    ir::python::add_descriptions(module);
    ir::python::add_machine(module);
    ir::python::add_scene(module);
    ir::python::add_picture(module);
    ir::python::add_experiment(module);
    ir::python::add_project(module);
    ir::python::add_compare(module);
    ir::python::add_sweep(module);
}
