#include "projects/sweep.h"

#include <algorithm>
#include <string>

#include "projects/coordinate.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

[[noreturn]] void refuse(const Sweep& sweep, const std::string& problem) {
    throw UsageError("sweep '" + sweep.id + "': " + problem);
}

std::size_t count_points(const Sweep& sweep) {
    std::size_t count = 1;
    for (const auto& axis : sweep.axes) {
        if (axis.values.empty()) refuse(sweep, "axis '" + printable(axis.key, 60) + "' has no values");
        count *= axis.values.size();
        if (count > max_sweep_points)
            refuse(sweep, "has more than " + std::to_string(max_sweep_points) + " points; shorten its axes");
    }
    return count;
}

const Experiment& base_of(const Project& project, const Sweep& sweep, const Registry& registry) {
    const auto* base = find_item(project.experiments, sweep.experiment);
    if (!base) refuse(sweep, "there is no experiment '" + printable(sweep.experiment, 60) + "'");
    registry.at(base->method);  // throws, naming the known ones
    return *base;
}

Experiment with_value(const Project& project, const Sweep& sweep, const Experiment& experiment,
                      const std::string& key, const Json& value, const Registry& registry) {
    try {
        return with_coordinate(project, experiment, key, value, registry);
    } catch (const UsageError& error) {
        refuse(sweep, error.what());
    }
}

}  // namespace

std::vector<SweepPoint> sweep_points(const Project& project, const Sweep& sweep, const Registry& registry) {
    const auto& base = base_of(project, sweep, registry);
    const auto count = count_points(sweep);
    std::vector<SweepPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        SweepPoint point{effective(base), Json::object()};
        std::size_t rest = i, block = count;
        for (const auto& axis : sweep.axes) {
            block /= axis.values.size();
            const auto& json = axis.values[rest / block];
            rest %= block;
            point.experiment = with_value(project, sweep, point.experiment, axis.key, json, registry);
            point.coordinates[axis.key] = json;
        }
        auto number = std::to_string(i + 1);
        number.insert(0, 4 - std::min<std::size_t>(4, number.size()), '0');
        point.experiment.id = base.id.substr(0, 90) + '-' + number;
        point.experiment.last_kept_key.clear();
        points.push_back(std::move(point));
    }
    return points;
}

std::size_t check_sweep(const Project& project, const Sweep& sweep, const Registry& registry) {
    auto experiment = effective(base_of(project, sweep, registry));
    experiment.notes.clear();  // may be long, and are copied for each value
    const auto count = count_points(sweep);
    for (const auto& axis : sweep.axes) {
        for (const auto& value : axis.values)
            with_value(project, sweep, experiment, axis.key, value, registry);
        experiment = with_value(project, sweep, experiment, axis.key, axis.values.front(), registry);
    }
    return count;
}

std::string sweep_path(const std::string& sweep) {
    return "sweeps/" + sweep;
}

}  // namespace ir::projects
