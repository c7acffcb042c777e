#include "app/engine/study_parts.h"

#include <algorithm>

#include "app/engine/kept_study.h"
#include "app/engine/moving.h"
#include "app/engine/study_plan.h"
#include "projects/keep.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "renderers/core/hash.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* parts_name = "parts";

Division::Place place_of(const fs::path& folder, const std::string& plot) {
    return {folder, study_file(folder, parts_name).parent_path() / parts_name, plot, ".json"};
}

std::string part_name_of(const std::string& plot, int index, int count) {
    return (fs::path(parts_name) / part_name(plot, index, count)).string();
}

}  // namespace

StudyParts::StudyParts(const projects::Project& project, const projects::ErrorPlot& plot,
                       const fs::path& folder, int count)
    : project_(project), plot_(plot), parts_(place_of(folder, plot.id), count) {
    // By its name, as a plot's place among others may change while it is divided.
    first_ = static_cast<int>(std::stoul(hash_bytes(plot.id).substr(0, 8), nullptr, 16) %
                              static_cast<unsigned long>(count));
}

Shard StudyParts::runs_of(const Shard& shard) const {
    return {(shard.index - 1 + parts_.count() - first_) % parts_.count() + 1, parts_.count()};
}

void StudyParts::keep(const ErrorStudy& study, const Shard& shard) const {
    keep_study(project_, plot_, parts_.project(), study, part_name_of(plot_.id, shard.index, parts_.count()));
}

/// What was made of another state of the project does not count.
std::optional<ErrorStudy> StudyParts::part(int index) const {
    const auto kept = load_study(parts_.project(), part_name_of(plot_.id, index, parts_.count()));
    if (!kept || is_stale(*kept, project_, plot_, projects::read_contents(project_, parts_.project())))
        return {};
    return kept->study;
}

std::vector<std::string> StudyParts::missing() const {
    return parts_.missing([&](int index) { return part(index) ? "" : "is not there"; });
}

std::optional<ErrorStudy> StudyParts::joined(Machine& machine) const {
    std::vector<ErrorStudy> parts;
    for (int index = 1; index <= parts_.count(); ++index) {
        auto found = part(index);
        if (!found) return {};
        parts.push_back(std::move(*found));
    }
    const auto now = projects::with_contents(project_, projects::read_contents(project_, parts_.project()));
    const auto runs = plan_study(now, plot_, scene_facts(machine.scenes(), now, parts_.project()));
    ErrorStudy study;
    study.plot = plot_.id;
    std::vector<std::size_t> taken(parts.size());
    for (std::size_t run = 0; run < runs.size(); ++run) {
        const auto from = (run + static_cast<std::size_t>(first_)) % parts.size();
        for (std::size_t i = 0; i < runs[run].points.size(); ++i) {
            const auto& points = parts[from].points;
            const auto next = taken[from]++;
            if (next >= points.size() || points[next].experiment != runs[run].experiment ||
                points[next].value != runs[run].points[i].value)
                throw Error(parts_.file(static_cast<int>(from) + 1).string() +
                            ": has other points than the plot; run its shard again");
            study.points.push_back(points[next]);
        }
    }
    for (const auto& part : parts) {
        if (part.points.empty()) continue;
        if (study.device.empty()) study.device = part.device;
        study.reference_noise = std::max(study.reference_noise, part.reference_noise);
        for (const auto& note : part.notes)
            if (std::find(study.notes.begin(), study.notes.end(), note) == study.notes.end())
                study.notes.push_back(note);
    }
    find_metrics(study);
    mark_front(study.points, plot_.metric);
    return study;
}

int parts_of_plot(const fs::path& folder, const std::string& plot) {
    return Division::count_at(place_of(folder, plot));
}

}  // namespace ir::engine
