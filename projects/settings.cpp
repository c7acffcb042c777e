#include "projects/settings.h"

namespace ir::projects {

Settings runnable_settings(const Experiment& experiment, const MethodDescription& method) {
    Settings known;
    for (const auto& [key, value] : effective(experiment).values)
        if (find(method.parameters, key)) known[key] = value;
    return completed(method.parameters, known);
}

}  // namespace ir::projects
