#include "app/engine/picture_parts.h"

#include "app/engine/pictures.h"
#include "projects/keep.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

std::string picture_key(const projects::Project& project, const projects::Experiment& experiment,
                        const fs::path& folder) {
    const auto now = projects::with_contents(project, projects::read_contents(project, folder));
    return projects::state_key(now, experiment, registry());
}

Division::Place place_of(const projects::Project& project, const projects::Experiment& experiment,
                         const fs::path& folder) {
    return {folder, folder / "results" / "parts", picture_key(project, experiment, folder), ".exr"};
}

Experiment part_of_picture(Experiment experiment, const Shard& shard) {
    experiment.shard = shard;
    return experiment;
}

}  // namespace

PictureParts::PictureParts(const projects::Project& project, const projects::Experiment& experiment,
                           fs::path folder, int count)
    : PictureParts(place_of(project, experiment, folder), count) {}

PictureParts::PictureParts(Division::Place place, int count)
    : key_(place.begin), parts_(std::move(place), count) {}

bool PictureParts::is_kept(std::uint64_t samples) const {
    const auto index = projects::ResultIndex::load(parts_.project());
    const auto* kept = index.find_state(key_);
    return kept && kept->samples >= samples;
}

std::vector<std::string> PictureParts::resume(Execution& execution) const {
    const auto part = parts_.file(execution.experiment().shard.index);
    if (!fs::exists(part)) return {};
    try {
        execution.restore(load_state(part));
        return {};
    } catch (const Error& error) {
        return {std::string("a part of the picture is not continued: ") + error.what()};
    }
}

void PictureParts::keep(const Execution& execution) const {
    const auto state = execution.state();
    if (!state) throw Error("there is no part of the picture to keep");
    const projects::ResultsGuard guard(parts_.project());  // else what is being written looks left over
    const auto part = parts_.file(execution.experiment().shard.index);
    real_file_system().create_directories(part.parent_path());
    store(part, *state, attributes(execution));
}

std::vector<std::string> PictureParts::missing(std::uint64_t samples) const {
    return parts_.missing([&](int index) -> std::string {
        const auto part = parts_.file(index);
        if (!fs::exists(part)) return "is not there";
        const auto there = stored_samples(part);
        if (there >= samples) return {};
        return "has " + std::to_string(there) + " of " + std::to_string(samples) + " samples";
    });
}

StoredState PictureParts::joined(const Execution& whole) const {
    StoredState all;
    const auto& method = find_method(whole.method().id);
    for (int index = 1; index <= parts_.count(); ++index) {
        const Shard shard{index, parts_.count()};
        auto part = load_state(parts_.file(index));
        if (part.fingerprint !=
            state_fingerprint(part_of_picture(whole.experiment(), shard), whole.scene().content_hash))
            throw Error(parts_.file(index).string() + ": is of another picture; remove it");
        if (index == 1) {
            all = std::move(part);
            continue;
        }
        try {
            method.join(all.history, part.history, shard);
        } catch (const Error& error) {
            throw Error(parts_.file(index).string() + ": " + error.what());
        }
        all.origins.insert(all.origins.end(), part.origins.begin(), part.origins.end());
    }
    all.fingerprint = state_fingerprint(whole.experiment(), whole.scene().content_hash);
    return all;
}

int parts_of_picture(const projects::Project& project, const projects::Experiment& experiment,
                     const fs::path& folder) {
    return Division::count_at(place_of(project, experiment, folder));
}

}  // namespace ir::engine
