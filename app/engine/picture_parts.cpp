#include "app/engine/picture_parts.h"

#include "app/engine/division.h"
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

fs::path picture_parts_folder(const fs::path& folder) {
    return folder / "results" / "parts";
}

constexpr const char* state_extension = ".exr";

Experiment part_of_picture(Experiment experiment, const Shard& shard) {
    experiment.shard = shard;
    return experiment;
}

}  // namespace

PictureParts::PictureParts(const projects::Project& project, const projects::Experiment& experiment,
                           fs::path folder, int count)
    : folder_(std::move(folder)), key_(picture_key(project, experiment, folder_)), count_(count) {}

fs::path PictureParts::file(int index) const {
    return picture_parts_folder(folder_) / (part_name(key_, index, count_) + state_extension);
}

bool PictureParts::is_kept(std::uint64_t samples) const {
    const auto index = projects::ResultIndex::load(folder_);
    const auto* kept = index.find_state(key_);
    return kept && kept->samples >= samples;
}

std::vector<std::string> PictureParts::resume(Execution& execution) const {
    const auto part = file(execution.experiment().shard.index);
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
    const projects::ResultsGuard guard(folder_);  // else what is being written looks left over
    real_file_system().create_directories(picture_parts_folder(folder_));
    store(file(execution.experiment().shard.index), *state, attributes(execution));
}

std::vector<std::string> PictureParts::missing(std::uint64_t samples) const {
    std::vector<std::string> missing;
    for (int index = 1; index <= count_; ++index) {
        const auto part = file(index);
        if (!fs::exists(part)) {
            missing.push_back(part_text(index, count_) + " is not there");
            continue;
        }
        const auto there = stored_samples(part);
        if (there < samples)
            missing.push_back(part_text(index, count_) + " has " + std::to_string(there) + " of " +
                              std::to_string(samples) + " samples");
    }
    return missing;
}

StoredState PictureParts::joined(const Execution& whole) const {
    StoredState all;
    const auto& method = find_method(whole.method().id);
    for (int index = 1; index <= count_; ++index) {
        const Shard shard{index, count_};
        auto part = load_state(file(index));
        if (part.fingerprint !=
            state_fingerprint(part_of_picture(whole.experiment(), shard), whole.scene().content_hash))
            throw Error(file(index).string() + ": is of another picture; remove it");
        if (index == 1) {
            all = std::move(part);
            continue;
        }
        try {
            method.join(all.history, part.history, shard);
        } catch (const Error& error) {
            throw Error(file(index).string() + ": " + error.what());
        }
        all.origins.insert(all.origins.end(), part.origins.begin(), part.origins.end());
    }
    all.fingerprint = state_fingerprint(whole.experiment(), whole.scene().content_hash);
    return all;
}

void PictureParts::remove() const {
    const projects::ResultsGuard guard(folder_);  // others may be about to write there
    remove_parts(picture_parts_folder(folder_), key_, count_, state_extension);
}

int parts_of_picture(const projects::Project& project, const projects::Experiment& experiment,
                     const fs::path& folder) {
    return division_of(picture_parts_folder(folder), picture_key(project, experiment, folder),
                       state_extension);
}

}  // namespace ir::engine
