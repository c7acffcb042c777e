#pragma once

#include <filesystem>
#include <string>

#include "app/engine/execution.h"

namespace ir::engine {

/// Pictures of an experiment from its time on, projects::frame_seconds after one another, as files.
struct Film {
    std::filesystem::path out;  ///< a folder, which gets 0001.png, 0002.png, …, or a video
    double until = 0;           ///< seconds of the last picture; 0: as long as something moves
    double turntable = 0;       ///< seconds of one turn of the camera about its target; 0: it does not turn
    double exposure = 0;        ///< stops
};

/// Endings of videos, with commas between them.
inline constexpr const char* video_endings = ".mp4, .webm, .mkv, .mov, .gif";
/// Whether the name has one of them: ffmpeg makes such a file.
bool is_video(const std::filesystem::path& file);

inline constexpr int max_film_pictures = 100'000;
/// Of an experiment that begins at `begin` and moves until `moves_until`, seconds. 0: nothing moves. At most
/// one more than the maximum.
int count_pictures(const Film& film, double begin, double moves_until);

/// Throws UsageError where no film can be put there: a video without ffmpeg, a project's folder.
void check_film_file(const std::filesystem::path& out);
/// The file of a film's picture in a folder, from 1 on: 0001.png.
std::filesystem::path film_picture(const std::filesystem::path& folder, int number);
/// A video of the folder's pictures, there whole or not at all. Throws Error where ffmpeg fails, and
/// Cancelled.
void make_video(const std::filesystem::path& folder, const std::filesystem::path& video,
                const CancelToken* cancel);

/// An experiment of a project in its folder.
struct FilmSubject {
    const projects::Project& project;
    const projects::Experiment& experiment;
    const std::filesystem::path& folder;
};

/// Throws UsageError, before anything is rendered: a video without ffmpeg, nothing that moves, no time.
/// Returns the number of pictures.
int check_film(Machine& machine, const FilmSubject& subject, const Film& film);

/// Renders all pictures. Where a method has a history each goes on from the one before; where samples add up
/// each has all samples of the experiment. A video's pictures are put into `folder`, which is there. The
/// report is that of the last picture, with the messages of the scene and of all. Throws as run_frames,
/// from_project and check_film, and Error where ffmpeg fails.
FrameReport make_film(Machine& machine, const FilmSubject& subject, const Film& film,
                      const std::filesystem::path& folder, const graph::FrameOptions& options);

}  // namespace ir::engine
