#include "app/engine/film.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <sstream>
#include <thread>

#include "app/engine/from_project.h"
#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "projects/motion.h"
#include "projects/samples.h"
#include "projects/store.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"

extern char** environ;

namespace ir::engine {
namespace {

constexpr int per_second = 30;  // 1 / projects::frame_seconds
static_assert(per_second * projects::frame_seconds == 1);

std::filesystem::path program_in_path(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const auto file = std::filesystem::path(folder) / name;
        std::error_code ignored;  // what is no folder, or closed to us, has none
        if (!folder.empty() && std::filesystem::is_regular_file(file, ignored) &&
            ::access(file.c_str(), X_OK) == 0)
            return file;
    }
    return {};
}

Experiment resolved(const FilmSubject& subject) {
    return from_project(subject.project, subject.experiment, subject.folder);
}

/// One turn about the target, counter-clockwise seen from above, in `pictures` equal steps.
projects::Motion turn_of(const scene::Camera& camera, double from, int pictures) {
    projects::Motion motion;
    const auto axis = glm::normalize(glm::dvec3(camera.up));
    for (int i = 0; i <= pictures; ++i) {
        const double angle = 2 * glm::pi<double>() * i / pictures;
        projects::Motion::Key key;
        key.time = from + i * projects::frame_seconds;
        key.target = camera.target;
        key.up = camera.up;
        key.eye = key.target + glm::angleAxis(angle, axis) * (glm::dvec3(camera.eye) - key.target);
        motion.keys.push_back(key);
    }
    motion.loop = true;
    return motion;
}

/// Lets the camera of the experiment turn from `start` on.
void add_turn(Experiment& experiment, const scene::Scene& scene, double start, double seconds) {
    if (!experiment.camera) {
        const auto* named = scene.find_camera(experiment.camera_name);
        experiment.camera = named ? *named : scene.cameras.front();
        experiment.camera_name.clear();
    }
    const int pictures = std::max(1, int(std::lround(seconds * per_second)));
    experiment.camera_motion = turn_of(*experiment.camera, start, pictures);
}

/// Runs a program and waits for it; a cancelled one is ended. What it complains of goes into the file `said`.
/// Throws Error, with the first line of that, where it fails.
void run_program(std::vector<std::string> words, const std::filesystem::path& said,
                 const CancelToken* cancel) {
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, said.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                       S_IRUSR | S_IWUSR);
    pid_t child = 0;
    const int problem = ::posix_spawn(&child, arguments[0], &files, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&files);
    if (problem != 0) throw Error(words.front() + " cannot be started");
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
        if (cancel && cancel->is_cancelled()) {
            ::kill(child, SIGTERM);
            ::waitpid(child, &status, 0);
            throw Cancelled();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (status == 0) return;
    if (cancel) cancel->check();  // Ctrl+C ends both
    std::ifstream text(said);
    std::string line;
    std::getline(text, line);
    throw Error(words.front() + " failed" + (line.empty() ? "" : ": " + projects::printable(line, 300)));
}

}  // namespace

bool is_video(const std::filesystem::path& file) {
    const auto ending = file.extension().string();
    return !ending.empty() && (std::string(video_endings) + ",").find(ending + ",") != std::string::npos;
}

void check_film_file(const std::filesystem::path& out) {
    if (is_video(out) && program_in_path("ffmpeg").empty())
        throw UsageError(out.string() +
                         ": videos are made by ffmpeg, which is not in PATH; install it, or give a folder, "
                         "which gets PNG files");
    if (!is_video(out) && std::filesystem::exists(out / projects::project_file_name))
        throw UsageError(out.string() + " is a project's folder; give another one");
}

std::filesystem::path film_picture(const std::filesystem::path& folder, int number) {
    char name[16];
    std::snprintf(name, sizeof name, "%04d.png", number);
    return folder / name;
}

void make_video(const std::filesystem::path& folder, const std::filesystem::path& video,
                const CancelToken* cancel) {
    const auto partial =
        video.parent_path() / ("." + video.stem().string() + ".partial" + video.extension().string());
    std::vector<std::string> words{program_in_path("ffmpeg").string(),
                                   "-y",
                                   "-nostdin",
                                   "-loglevel",
                                   "error",
                                   "-framerate",
                                   std::to_string(per_second),
                                   "-start_number",
                                   "1",
                                   "-i",
                                   (folder / "%04d.png").string()};
    // Common players want colours at half the resolution, and for that even sides.
    if (video.extension() != ".gif")
        for (const char* word : {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"})
            words.emplace_back(word);
    words.push_back("file:" + partial.string());
    std::error_code ignored;
    try {
        run_program(words, folder / "ffmpeg.txt", cancel);
        real_file_system().rename(partial, video);
    } catch (...) {
        std::filesystem::remove(partial, ignored);
        throw;
    }
}

int count_pictures(const Film& film, double begin, double moves_until) {
    const bool is_turn = film.until <= 0 && film.turntable > 0;
    const double seconds = is_turn ? film.turntable : (film.until > 0 ? film.until : moves_until) - begin;
    if (seconds < 0 || (film.until <= 0 && seconds == 0)) return 0;
    // A turn's last picture is the one before its first.
    const double pictures = std::floor(seconds * per_second + 1e-6) + (is_turn ? 0 : 1);
    return int(std::clamp<double>(pictures, 1, max_film_pictures + 1));
}

int check_film(Machine& machine, const FilmSubject& subject, const Film& film) {
    check_film_file(film.out);
    const auto run = projects::effective(subject.experiment);
    const auto scene = machine.scenes().load(resolved(subject).composition());
    const int pictures = count_pictures(
        film, run.time, std::max(double(scene->duration()), projects::moves_until(subject.project, run)));
    if (pictures == 0 && film.until > 0)
        throw UsageError("the film ends before it begins, at " + to_string(Value{run.time}) + " s");
    if (pictures == 0)
        throw UsageError("nothing moves from " + to_string(Value{run.time}) +
                         " s on; give --turntable SECONDS, --until SECONDS, or the project a motion");
    if (pictures > max_film_pictures)
        throw UsageError("the film has more than " + std::to_string(max_film_pictures) +
                         " pictures; make it shorter");
    return pictures;
}

FrameReport make_film(Machine& machine, const FilmSubject& subject, const Film& film,
                      const std::filesystem::path& folder, const graph::FrameOptions& options) {
    const int pictures = check_film(machine, subject, film);
    const auto first = resolved(subject);
    const auto scene = machine.scenes().load(first.composition());
    // A picture that adds up samples is of one moment, at which the project says where everything is.
    const auto at = [&](double time) {
        auto experiment = subject.experiment;
        experiment.time = time;
        auto run = from_project(subject.project, experiment, subject.folder, first.environment);
        if (film.turntable > 0) {
            run.camera = first.camera;
            add_turn(run, *scene, first.time, film.turntable);
        }
        return run;
    };
    Execution execution(machine, at(first.time));
    FrameReport total;
    for (const auto& warning : execution.scene().warnings)
        total.messages.push_back({Severity::warning, "scene", warning.text});
    for (int i = 0; i < pictures; ++i) {
        auto one = options;
        if (options.progress)
            one.progress = [&, i](const std::string& what, double part) {
                options.progress(
                    "picture " + std::to_string(i + 1) + " of " + std::to_string(pictures) + ", " + what,
                    (i + part) / pictures);
            };
        if (execution.accumulates()) execution.update(at(first.time + i * projects::frame_seconds));
        auto report = execution.accumulates() ? run_frames(execution, one) : execution.run_frame(one);
        for (const auto& message : report.messages) add_message(total.messages, message);
        report.messages = std::move(total.messages);
        report.wall_ms += total.wall_ms;
        total = std::move(report);
        write_png(film_picture(folder, i + 1), displayed_result(execution), film.exposure);
    }
    if (const auto next = film_picture(folder, pictures + 1); std::filesystem::exists(next))
        add_message(total.messages, {Severity::note, "film",
                                     "the folder has further pictures of another film, from " +
                                         next.filename().string() + " on"});
    if (is_video(film.out)) make_video(folder, film.out, options.cancel);
    return total;
}

}  // namespace ir::engine
