#include <pybind11/stl.h>

#include "app/engine/sweep_run.h"
#include "app/python/bindings.h"
#include "app/python/convert.h"
#include "app/python/experiment.h"
#include "projects/sweep.h"
#include "projects/validate.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"

namespace ir::python {
namespace {

using engine::SweepRow;

projects::Sweep sweep_of(const Experiment& experiment, const py::dict& axes) {
    projects::Sweep sweep;
    sweep.id = sweep.name = "sweep";
    sweep.experiment = experiment.item().id;
    for (const auto& [key, values] : axes) {
        const auto name = key.cast<std::string>();
        const auto json = to_json(py::list(py::reinterpret_borrow<py::object>(values)), name);
        sweep.axes.push_back({name, {json.begin(), json.end()}});
    }
    validate(sweep);
    return sweep;
}

engine::SweepOptions options_of(const Machine& machine, const Watch& watch,
                                std::optional<std::int64_t> samples, int repeats,
                                const py::object& references) {
    if (samples && (*samples < 0 || *samples > max_samples))
        throw UsageError("reference: give a number of samples from 1 to " + std::to_string(max_samples));
    if (repeats < 0 || repeats > max_repeats)
        throw UsageError("repeats: give a number from 0 to " + std::to_string(max_repeats));
    engine::SweepOptions options;
    options.is_judged = samples.has_value();
    options.samples = static_cast<std::uint64_t>(samples.value_or(0));
    options.repeats = repeats;
    if (!references.is_none()) options.references = to_path(references);
    options.frame.memory_budget = machine.memory_budget();
    options.frame.cancel = watch.token();
    return options;
}

/// The table as text of CSV. A variation that fails is a row.
std::string sweep(const Experiment& given, const py::dict& axes, std::optional<std::int64_t> samples,
                  int repeats, const py::object& references, const py::object& progress,
                  const py::object& cancel, const py::object& each, const std::shared_ptr<Machine>& chosen) {
    const auto machine = chosen ? chosen : Machine::standard();
    const Experiment experiment = given;  // what Python changes meanwhile is not of this sweep
    const auto points =
        projects::sweep_points(experiment.project(), sweep_of(experiment, axes), engine::registry());
    Watch watch(progress, cancel);
    auto options = options_of(*machine, watch, samples, repeats, references);
    const auto tell = watch.callback();
    std::size_t number = 0;
    options.frame.progress = [&](const std::string& what, double part) {
        tell(points[number].experiment.id + ", " + what,
             (static_cast<double>(number) + part) / static_cast<double>(points.size()));
    };
    return watch.around([&] {
        return machine->use(watch, [&](engine::Machine& m) {
            engine::SweepRun run(m, experiment.project(), experiment.folder(), options);
            engine::SweepTable table;
            for (; number < points.size(); ++number) {
                auto row = run.planned(points[number]);
                bool was_refused = false;
                const auto pictured = [&](const engine::Execution& execution, const FrameReport& report) {
                    const auto picture = picture_of(execution, report, {});
                    const py::gil_scoped_acquire locked;
                    if (!each.is_none())
                        each(to_python(row.coordinates.dump()), std::const_pointer_cast<Picture>(picture));
                    return std::string();
                };
                if (row.problem == SweepRow::not_rendered)
                    run.render(points[number], row, pictured, was_refused);
                table.rows.push_back(std::move(row));
            }
            return engine::table_csv(table);
        });
    });
}

}  // namespace

void add_sweep(py::module_& module) {
    module.def("_sweep", &sweep, py::arg("experiment"), py::arg("axes"), py::arg("samples"),
               py::arg("repeats"), py::arg("references"), py::arg("progress"), py::arg("cancel"),
               py::arg("each"), py::arg("machine"));
}

}  // namespace ir::python
