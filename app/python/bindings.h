#pragma once

#include <pybind11/pybind11.h>

/// Each adds a subject to the module.
namespace ir::python {

void add_errors(pybind11::module_& module);
void add_descriptions(pybind11::module_& module);
void add_machine(pybind11::module_& module);
void add_scene(pybind11::module_& module);
void add_picture(pybind11::module_& module);
void add_experiment(pybind11::module_& module);
void add_project(pybind11::module_& module);
void add_compare(pybind11::module_& module);
void add_sweep(pybind11::module_& module);

}  // namespace ir::python
