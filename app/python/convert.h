#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "projects/json.h"
#include "renderers/core/report.h"
#include "renderers/core/value.h"
#include "renderers/image/image.h"

/// Between Python's objects and ours.
namespace ir::python {

namespace py = pybind11;

py::object to_python(const std::string& json_text);
py::object to_python(const Value& value);

/// Of whatever Python's json module writes, and of NumPy's numbers and arrays. `what` begins the UsageError.
projects::Json to_json(py::handle object, const std::string& what);
/// Throws UsageError, which `what` begins, for what is no value.
Value to_value(py::handle object, const std::string& what);
/// Height × width, or height × width × channels. Throws UsageError for other arrays.
Image to_image(py::handle array, const std::string& what);
/// A text, or what os.fspath() takes.
std::string to_path(py::handle path);
/// One text, or several.
std::vector<std::string> to_texts(py::handle texts);

/// The image's own pixels, which nobody may change; `owner` holds them as long as there is an array.
py::array as_array(const Image& image, const std::shared_ptr<const void>& owner);
/// The elements of a buffer, one record each; `owner` as above.
py::array as_array(const std::vector<std::byte>& bytes, const std::vector<Field>& fields,
                   const std::shared_ptr<const void>& owner);

}  // namespace ir::python
