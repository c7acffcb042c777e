#include "app/python/bindings.h"
#include "renderers/core/error.h"

namespace ir::python {
namespace {

namespace py = pybind11;

/// A failure of ours as an exception of the package.
template <class Failure>
py::object add(py::module_& module, const char* name, const char* doc, const py::object& bases) {
    auto& exception = py::register_exception<Failure>(module, name, bases);
    exception.attr("__module__") = "interreflect";
    exception.attr("__doc__") = doc;
    return exception;
}

}  // namespace

void add_errors(py::module_& module) {
    const auto python = [](PyObject* type) { return py::reinterpret_borrow<py::object>(type); };
    const auto error =
        add<Error>(module, "Error", "Something failed; its text is one line that says what mends it.",
                   python(PyExc_RuntimeError));
    add<InputError>(module, "InputError", "A file that cannot be used.", error);
    add<UsageError>(module, "UsageError", "A wrong name, key or value.",
                    py::make_tuple(error, python(PyExc_ValueError)));
    add<BudgetError>(
        module, "BudgetError",
        "The memory budget or a limit of the device does not allow the work; names what to lower.",
        py::make_tuple(error, python(PyExc_MemoryError)));
    add<Cancelled>(module, "Cancelled", "An event ended the work. Nothing is wrong.",
                   python(PyExc_Exception));
}

}  // namespace ir::python
