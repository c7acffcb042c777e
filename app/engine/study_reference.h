#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/execution.h"
#include "projects/document.h"
#include "renderers/image/exr.h"
#include "renderers/image/image.h"

namespace ir::engine {

/// What the pictures of a study are judged by.
struct StudyReference {
    Image image, valid;              ///< valid: empty where nothing marks pixels
    double noise = 0;                ///< RMSE that it has left itself; 0: unknown
    ImageAttributes attributes;      ///< how it was made; of a foreign image none
    std::string kept_on;             ///< date of the kept result that it was read from; empty: of none
    std::vector<std::string> notes;  ///< where it comes from, what is not known of it
};

/// Square root of the mean variance over valid pixels and colour channels: the RMSE against the truth that is
/// expected of a picture with this variance per pixel. `valid` may be empty.
double noise_of(const Image& variance, const Image& valid);

/// The picture that a project keeps of the experiment; nothing where it keeps none. `now` is the project with
/// the contents of its files. Throws InputError.
std::optional<StudyReference> kept_picture(const projects::Project& now,
                                           const projects::Experiment& experiment,
                                           const std::filesystem::path& folder);

/// The foreign image, the kept result where that is current, or else the picture rendered now. `id` names an
/// experiment or an image of the project. With `keeps` a picture whose samples add up is kept in the
/// project's results, also one that is cancelled. Throws Cancelled, Error, InputError, UsageError with one
/// line.
StudyReference study_reference(Machine& machine, const projects::Project& project, const std::string& id,
                               const std::filesystem::path& folder, const graph::FrameOptions& options,
                               bool keeps = false);

}  // namespace ir::engine
