#include "app/python/convert.h"

#include "renderers/core/error.h"

namespace ir::python {
namespace {

py::module_ json_module() {
    return py::module_::import("json");
}

/// For json.dumps: NumPy's numbers and arrays, and paths.
py::object plain(const py::object& object) {
    if (py::hasattr(object, "tolist")) return object.attr("tolist")();
    if (py::hasattr(object, "__fspath__")) return object.attr("__fspath__")();
    throw py::type_error(
        py::str("a {} cannot be written as JSON").format(py::type::of(object).attr("__name__")));
}

py::capsule keep_alive(const std::shared_ptr<const void>& owner) {
    return {new std::shared_ptr<const void>(owner),
            [](void* held) { delete static_cast<std::shared_ptr<const void>*>(held); }};
}

py::array read_only(py::array array) {
    array.attr("flags").attr("writeable") = false;
    return array;
}

const char* type_name(FieldType type) {
    switch (type) {
        case FieldType::u32:
            return "u4";
        case FieldType::i32:
            return "i4";
        default:
            return "f4";
    }
}

}  // namespace

py::object to_python(const std::string& json_text) {
    return json_module().attr("loads")(json_text);
}

py::object to_python(const Value& value) {
    return std::visit([](const auto& plain) { return py::cast(plain); }, value);
}

projects::Json to_json(py::handle object, const std::string& what) {
    try {
        const auto text = json_module()
                              .attr("dumps")(object, py::arg("default") = py::cpp_function(plain),
                                             py::arg("ensure_ascii") = false)
                              .cast<std::string>();
        return projects::parse_json(text, what);
    } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) throw;
        throw UsageError(what + ": " + std::string(py::str(error.value())));
    }
}

Value to_value(py::handle object, const std::string& what) {
    const auto item = py::hasattr(object, "dtype") && py::hasattr(object, "item")
                          ? py::object(object.attr("item")())
                          : py::reinterpret_borrow<py::object>(object);
    if (py::isinstance<py::bool_>(item)) return item.cast<bool>();
    if (py::isinstance<py::int_>(item)) {
        int overflow = 0;
        const auto number = PyLong_AsLongLongAndOverflow(item.ptr(), &overflow);
        if (overflow != 0) throw UsageError(what + ": " + std::string(py::str(item)) + " is too large");
        return std::int64_t{number};
    }
    if (py::isinstance<py::float_>(item)) return item.cast<double>();
    if (py::isinstance<py::str>(item)) return item.cast<std::string>();
    throw UsageError(what + ": give True or False, a number or a text");
}

Image to_image(py::handle object, const std::string& what) {
    const auto array = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(object);
    if (!array) {
        PyErr_Clear();
        throw UsageError(what + " is no array of numbers");
    }
    if ((array.ndim() != 2 && array.ndim() != 3) || array.size() == 0 ||
        (array.ndim() == 3 && array.shape(2) > 4))
        throw UsageError(what + " must have the shape (height, width) or (height, width, 1 to 4 channels)");
    Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)),
                array.ndim() == 3 ? static_cast<int>(array.shape(2)) : 1);
    std::copy_n(array.data(), image.pixels.size(), image.pixels.begin());
    return image;
}

std::string to_path(py::handle path) {
    return py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

std::vector<std::string> to_texts(py::handle texts) {
    if (py::isinstance<py::str>(texts)) return {texts.cast<std::string>()};
    std::vector<std::string> result;
    for (const auto text : texts) result.push_back(text.cast<std::string>());
    return result;
}

py::array as_array(const Image& image, const std::shared_ptr<const void>& owner) {
    std::vector<py::ssize_t> shape{image.height, image.width};
    if (image.channels > 1) shape.push_back(image.channels);
    return read_only(py::array(py::dtype::of<float>(), shape, image.pixels.data(), keep_alive(owner)));
}

py::array as_array(const std::vector<std::byte>& bytes, const std::vector<Field>& fields,
                   const std::shared_ptr<const void>& owner) {
    py::list members;
    for (const auto& field : fields) {
        if (field.count > 1)
            members.append(py::make_tuple(field.name, type_name(field.type), py::make_tuple(field.count)));
        else
            members.append(py::make_tuple(field.name, type_name(field.type)));
    }
    const auto type = py::dtype::from_args(members);
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(bytes.size()) / type.itemsize()};
    return read_only(py::array(type, shape, bytes.data(), keep_alive(owner)));
}

}  // namespace ir::python
