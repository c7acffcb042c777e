#include "projects/plots.h"

#include <algorithm>

namespace ir::projects {

std::vector<std::string> plot_keys(const Project& project, const ErrorPlot& plot, const Registry& registry) {
    std::vector<std::string> keys{"frames", "seed"};
    for (const auto& id : plot.experiments) {
        const auto* experiment = find_item(project.experiments, id);
        const auto* method = experiment ? registry.find(experiment->method) : nullptr;
        if (!method) continue;
        for (const auto& parameter : method->parameters)
            if (std::find(keys.begin(), keys.end(), parameter.key) == keys.end())
                keys.push_back(parameter.key);
    }
    return keys;
}

std::vector<int> doubling_frames(int frames) {
    std::vector<int> result;
    for (std::int64_t n = 1; n < frames; n *= 2) result.push_back(static_cast<int>(n));
    result.push_back(frames);
    return result;
}

std::size_t count_points(const Project& project, const ErrorPlot& plot) {
    std::size_t count = 0;
    for (const auto& id : plot.experiments) {
        const auto* experiment = find_item(project.experiments, id);
        if (!experiment) continue;
        const bool doubles = plot.over == "frames" && plot.values.empty();
        count += doubles ? doubling_frames(effective(*experiment).frames).size() : plot.values.size();
    }
    return count;
}

std::string study_path(const std::string& plot) {
    return "plots/" + plot + ".json";
}

}  // namespace ir::projects
