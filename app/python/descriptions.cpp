#include "app/engine/execution.h"
#include "app/python/bindings.h"
#include "app/python/convert.h"
#include "renderers/core/describe.h"
#include "renderers/core/resources_path.h"
#include "renderers/core/words.h"
#include "renderers/image/metrics.h"

namespace ir::python {
namespace {

std::vector<std::string> method_ids() {
    std::vector<std::string> ids;
    for (const auto* method : engine::registry().methods()) ids.push_back(method->id);
    return ids;
}

py::list list_of(const std::vector<std::string>& words) {
    py::list list;
    for (const auto& word : words) list.append(word);
    return list;
}

py::dict metric_docs() {
    py::dict docs;
    for (const auto& metric : metrics()) docs[py::str(metric.name)] = metric.doc;
    return docs;
}

}  // namespace

void add_descriptions(py::module_& module) {
    module.def(
        "methods", [] { return list_of(method_ids()); }, "Ids of all methods");
    module.def(
        "describe",
        [](const std::string& method) { return to_python(describe_json(engine::registry().at(method))); },
        py::arg("method"), "Parameters, outputs and all else that a method says of itself, as a dict");
    module.def(
        "manual", [](const std::string& method) { return describe_markdown(engine::registry().at(method)); },
        py::arg("method"), "A method's parameters and outputs as a page of the manual, in Markdown");
    module.def("metrics", &metric_docs, "Names of all metrics, and what each of them is");
    module.def(
        "samples_folder", [] { return samples_directory().string(); },
        "The folder with the projects that come with the program");
}

}  // namespace ir::python
