#include "app/python/picture.h"

#include <algorithm>

#include "app/engine/pictures.h"
#include "app/python/bindings.h"
#include "app/python/convert.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/image/channels.h"

namespace ir::python {
namespace {

PicturePtr read(const py::object& path) {
    const auto file = to_path(path);
    const py::gil_scoped_release unlocked;
    auto picture = std::make_shared<Picture>();
    picture->layers = read_layers(file, &picture->attributes);
    return picture;
}

/// A buffer's records, or the pixels of a layer.
py::array array_of(const PicturePtr& picture, const std::string& key) {
    if (const auto buffer = picture->buffers.find(key); buffer != picture->buffers.end())
        return as_array(buffer->second.bytes, buffer->second.fields, picture);
    if (const auto* layer = picture->layer(key)) return as_array(layer->image, picture);
    throw py::key_error("there is no '" + key + "'" + known_are(key, picture->keys()) +
                        "; render(outputs=…) keeps more");
}

py::list channels_of(const Picture& picture, const std::string& key) {
    const auto* layer = picture.layer(key);
    if (!layer) throw py::key_error("there is no '" + key + "'" + known_are(key, picture.keys()));
    py::list names;
    for (const auto& name : layer->channels) names.append(name);
    return names;
}

py::object valid_of(const PicturePtr& picture) {
    if (const auto* layer = picture->layer("valid"))
        return as_array(layer->image, picture).attr("__gt__")(0.5f);
    const auto& image = picture->layers.front().image;
    return py::module_::import("numpy").attr("ones")(py::make_tuple(image.height, image.width),
                                                     py::arg("dtype") = py::bool_().get_type());
}

void save(const Picture& picture, const py::object& path) {
    const std::filesystem::path file = to_path(path);
    const py::gil_scoped_release unlocked;
    if (file.extension() == ".exr") return write_exr(file, picture.layers, picture.attributes);
    if (file.extension() != ".png") throw UsageError("'" + file.string() + "' must end in .exr or .png");
    Image colours;
    write_png(file, values_of(picture.layers.front().image, Semantic::radiance, colours));
}

template <class Map>
py::dict dict_of(const Map& map) {
    py::dict dict;
    for (const auto& [key, value] : map) dict[py::str(key)] = value;
    return dict;
}

py::list key_list(const Picture& picture) {
    py::list list;
    for (const auto& key : picture.keys()) list.append(key);
    return list;
}

}  // namespace

const ImageLayer* Picture::layer(const std::string& key) const {
    for (const auto& layer : layers)
        if (layer.name == key) return &layer;
    return key == main_key && !layers.empty() ? &layers.front() : nullptr;
}

std::vector<std::string> Picture::keys() const {
    std::vector<std::string> keys;
    for (const auto& layer : layers) {
        const auto& key = layer.name.empty() ? main_key : layer.name;
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
    return keys;
}

engine::Side Picture::side(const std::string& name) const {
    return engine::side_of(name, layers.front().image, layers, attributes);
}

PicturePtr picture_of(const engine::Execution& execution, const FrameReport& report,
                      const std::vector<std::string>& outputs) {
    const auto& graph = execution.graph();
    auto picture = std::make_shared<Picture>();
    picture->main_key = engine::main_key(execution);
    picture->layers = engine::layers(execution, outputs);
    picture->attributes = engine::attributes(execution);
    picture->statistics = engine::statistics_json(execution, report);
    for (const auto& warning : execution.scene().warnings) picture->messages.push_back(warning.text);
    for (const auto& message : report.messages) picture->messages.push_back(message.text);
    for (const auto& layer : picture->layers) {
        const auto* desc = graph.buffer_desc(layer.name);
        if (!desc) continue;
        const auto resource = std::find_if(report.resources.begin(), report.resources.end(),
                                           [&](const auto& each) { return each.key == layer.name; });
        const auto bytes_in_use = resource->elements * static_cast<std::uint64_t>(graph::stride(*desc));
        if (auto bytes = graph.read_buffer(layer.name, bytes_in_use))
            picture->buffers[layer.name] = {desc->fields, resource->elements, std::move(*bytes)};
    }
    return picture;
}

void add_picture(py::module_& module) {
    const auto array_doc =
        "Pixels of a layer, (height, width) or (height, width, channels), row 0 at the top; or the records of "
        "a buffer. The array shares the picture's memory, is read-only, and may outlive it.";
    py::class_<Picture, std::shared_ptr<Picture>>(
        module, "Picture",
        "What a rendering left, or an image file holds: a mapping from names to NumPy arrays. Names are those "
        "of the layers that the command line writes.")
        .def("__getitem__", &array_of, py::arg("key"), array_doc)
        .def("__contains__",
             [](const Picture& p, const std::string& key) { return p.layer(key) || p.buffers.count(key); })
        .def("__iter__", [](const Picture& p) { return py::iter(key_list(p)); })
        .def("__len__", [](const Picture& p) { return p.keys().size(); })
        .def("keys", &key_list, "Names of all layers")
        .def(
            "channels", &channels_of, py::arg("key"),
            "Names of a layer's channels, in the order of the array: of files it is that of the alphabet where "
            "the names are not R, G, B or X, Y, Z")
        .def_property_readonly(
            "image", [](const PicturePtr& p) { return as_array(p->layers.front().image, p); },
            "The main result")
        .def_property_readonly("valid", &valid_of,
                               "Where the main result means something: an array of bools, which is a copy")
        .def_property_readonly(
            "attributes", [](const Picture& p) { return dict_of(p.attributes); },
            "What the header of an EXR file says")
        .def_property_readonly(
            "statistics",
            [](const Picture& p) { return p.statistics.empty() ? py::dict() : to_python(p.statistics); },
            "Times, counters, memory and settings, as `render --json` has them; empty of a file")
        .def_property_readonly(
            "messages",
            [](const Picture& p) {
                py::list texts;
                for (const auto& text : p.messages) texts.append(text);
                return texts;
            },
            "What a reader of the picture should know, a line each")
        .def("save", &save, py::arg("file"),
             "Writes an .exr file, as the command line would, or the main result as a .png")
        .def("__repr__", [](const Picture& p) {
            const auto& image = p.layers.front().image;
            return "<Picture " + std::to_string(image.width) + "x" + std::to_string(image.height) + ": " +
                   listed(p.keys()) + ">";
        });
    module.def("read", &read, py::arg("file"),
               "An image file: all layers of an .exr, else the pixels in linear values");
}

}  // namespace ir::python
