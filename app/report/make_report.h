#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/report/report.h"
#include "projects/document.h"
#include "renderers/core/progress.h"

/// Reports of pictures in files. Nothing is rendered. All throw Cancelled, and InputError with one line.
namespace ir::report {

/// How long it takes, and until when.
struct Work {
    const CancelToken* cancel = nullptr;
    ProgressCallback progress = {};
    void tell(const std::string& what, double fraction) const {
        if (cancel) cancel->check();
        if (progress) progress(what, fraction);
    }
};

/// A picture of an experiment that the project does not keep.
struct Unkept {
    std::filesystem::path file = {};
    std::string problem = {};  ///< where there is no file: why, in one line
};

/// What of a project a report is of.
struct Subject {
    std::string comparison = {};                ///< its id: what it compares, alone; empty: all
    std::map<std::string, Unkept> unkept = {};  ///< by experiment; they go before kept results
};
/// Of an experiment or image.
bool takes_part(const projects::Project& project, const Subject& subject, const std::string& id);

/// Kept results of the experiments, foreign images, and kept numbers of the plots; what is missing or stale
/// is said. `folder` is the project's. Throws UsageError for a comparison that is not there.
Report report_of(const projects::Project& project, const std::filesystem::path& folder, const Work& work = {},
                 const Subject& subject = {});

/// Its pictures alone, with what is missing or stale.
Report pictures_of(const projects::Project& project, const std::filesystem::path& folder,
                   const Work& work = {});

/// `image` against `reference`, two picture files.
Report report_of(const std::filesystem::path& image, const std::filesystem::path& reference,
                 const Work& work = {});

/// More pictures make a page that nobody loads.
inline constexpr std::size_t usual_sweep_pictures = 12;
/// The list of a sweep and at most so many of its pictures, from the folder that it was rendered to.
Report report_of_sweep(const std::filesystem::path& folder, std::size_t pictures = usual_sweep_pictures,
                       const Work& work = {});

}  // namespace ir::report
