#include <pybind11/stl.h>

#include <algorithm>

#include "app/engine/compared_sides.h"
#include "app/python/bindings.h"
#include "app/python/convert.h"
#include "app/python/picture.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/image/metrics.h"

namespace ir::python {
namespace {

using engine::Side;

/// Of a picture, an array of pixels or a file.
Side side_of(const py::object& given, const std::string& name, const std::string& layer) {
    if (py::isinstance<Picture>(given)) {
        const auto& picture = given.cast<const Picture&>();
        if (layer.empty()) return picture.side(name);
        const auto* found = picture.layer(layer);
        if (!found)
            throw UsageError(name + " has no layer '" + layer + "'" + known_are(layer, picture.keys()));
        return engine::side_of(name, found->image, picture.layers, picture.attributes, layer);
    }
    if (py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__"))
        return engine::load_side(to_path(given), layer);
    return engine::side_of(name, to_image(given, name), {}, {});
}

void require_comparable(const Side& image, const Side& reference, const std::vector<std::string>& allowed) {
    const auto& kinds = engine::mismatch_kinds();
    for (const auto& kind : allowed)
        if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
            throw UsageError("allow_different: unknown '" + kind + "'" + known_are(kind, kinds));
    for (const auto& mismatch : engine::mismatches(image, reference))
        if (std::find(allowed.begin(), allowed.end(), mismatch.what) == allowed.end())
            throw UsageError(image.file + " cannot be compared with " + reference.file + ": different " +
                             mismatch.what + ": " + mismatch.text + " (allow_different=['" + mismatch.what +
                             "'] compares them all the same)");
}

py::dict compare(const py::object& image, const py::object& reference, const py::object& metrics,
                 const std::string& layer, const py::object& mask,
                 const std::optional<std::array<int, 4>>& rectangle, const py::object& allow_different,
                 std::optional<double> pixels_per_degree) {
    const auto a = side_of(image, "image", layer), b = side_of(reference, "reference", layer);
    const auto allowed = to_texts(allow_different);
    auto options = engine::metric_options(a, b);
    if (pixels_per_degree) options.flip.pixels_per_degree = *pixels_per_degree;
    if (rectangle)
        options.rectangle = Rectangle{(*rectangle)[0], (*rectangle)[1], (*rectangle)[2], (*rectangle)[3]};
    const auto mask_image = mask.is_none() ? Image() : to_image(mask, "mask");
    options.mask = mask_image.empty() ? nullptr : &mask_image;
    const auto names = metrics.is_none() ? engine::metrics_that_apply(a, b) : to_texts(metrics);
    MetricResult result;
    {
        const py::gil_scoped_release unlocked;
        const auto look = comparability(a.image, b.image, options.semantic);
        if (look.misfit == Misfit::size || look.misfit == Misfit::channels) throw UsageError(look.why);
        require_comparable(a, b, allowed);
        result = compute_metrics(a.image, b.image, names, options);
    }
    py::dict values;
    for (const auto& name : names) values[py::str(name)] = result.values.at(name);
    py::dict all;
    all["metrics"] = values;
    all["pixels"] = result.pixels;
    all["skipped"] = result.skipped;
    return all;
}

}  // namespace

void add_compare(py::module_& module) {
    module.def("_compare", &compare, py::arg("image"), py::arg("reference"), py::arg("metrics"),
               py::arg("layer"), py::arg("mask"), py::arg("rectangle"), py::arg("allow_different"),
               py::arg("pixels_per_degree"));
}

}  // namespace ir::python
