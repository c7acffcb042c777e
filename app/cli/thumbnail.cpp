// `interreflect-cli thumbnail`: what a file manager shows of a project.
#include <algorithm>
#include <filesystem>

#include "app/cli/command.h"
#include "app/cli/output_files.h"
#include "app/cli/run_frames.h"
#include "app/cli/temporary_folder.h"
#include "app/engine/live_session.h"
#include "projects/last_picture.h"
#include "renderers/core/error.h"
#include "renderers/image/channels.h"
#include "renderers/image/exr.h"

namespace ir::cli {
namespace {

namespace fs = std::filesystem;

int write_thumbnail(const std::string& project, const std::string& file, int side) {
    OutputFiles files;
    files.reads("PROJECT", project);
    files.writes("FILE", file);
    require_folder_of(file, "FILE");
    const TemporaryFolder folder;
    const auto picture = folder.path() / "picture.exr";
    if (!projects::copy_last_picture(project, picture))
        throw Error(project + ": keeps no picture; render it with --keep, or keep one in the window");
    const auto image = read_image(picture);
    const int width = image.height > image.width ? std::max(1, side * image.width / image.height) : side;
    Image colours;
    write_png(file, values_of(engine::thumbnail(image, width), Semantic::radiance, colours));
    return done;
}

}  // namespace

void add_thumbnail(CLI::App& app, Run& run) {
    struct Flags {
        std::string project, file;
        int size = 256;
    };
    auto flags = std::make_shared<Flags>();
    auto* command = app.add_subcommand("thumbnail", "A small PNG of the picture that a project kept last");
    command->add_option("PROJECT", flags->project, "Project folder, or a packed project")
        ->required()
        ->check(no_scene());
    command->add_option("FILE", flags->file, "PNG file")->required();
    command->add_option("--size", flags->size, "Pixels of the longer side at most")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command->callback([flags, &run] {
        run = [flags] { return write_thumbnail(flags->project, flags->file, flags->size); };
    });
}

}  // namespace ir::cli
