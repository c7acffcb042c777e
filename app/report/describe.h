#pragma once

#include <filesystem>

#include "app/report/report.h"
#include "renderers/core/progress.h"

/// What all reports say of their pictures, from what the files tell.
namespace ir::report {

/// The layer and what its file says. Throws InputError.
Picture read_picture(const std::string& name, const std::filesystem::path& file);

/// Light is exposed automatically as in the window, by the last picture, which is the reference where there
/// is one; what has one channel is shown from 0 to 1, or to its largest value.
Shown shown_range(const std::vector<Picture>& pictures);

/// All pairs of a gallery by all metrics that apply, as `compare --metric all` measures them; why a pair is
/// not measured is a note. Throws Cancelled.
Table measure(const Gallery& gallery, const CancelToken* cancel);

/// Of each gallery whose files tell any.
std::vector<Settings> settings_of(const std::vector<Gallery>& galleries);
/// Of all pictures of the galleries.
Table provenance_of(const std::vector<Gallery>& galleries);

}  // namespace ir::report
