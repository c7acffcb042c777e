#include "app/cli/picture_file.h"

#include "app/cli/run_frames.h"
#include "app/engine/pictures.h"
#include "renderers/core/error.h"
#include "renderers/image/channels.h"

namespace ir::cli {

void require_picture(const std::string& file, const std::vector<std::string>& dumps) {
    const auto extension = std::filesystem::path(file).extension();
    if (extension != ".exr" && extension != ".png")
        throw UsageError("--out '" + file + "' must end in .exr or .png");
    if (extension == ".png" && !dumps.empty())
        throw UsageError("--dump cannot be used with --out '" + file + "'; layers need a file.exr");
    require_folder_of(file, "--out");
}

void write_picture(const std::filesystem::path& file, const engine::Execution& execution,
                   const std::vector<std::string>& dumps) {
    if (file.extension() == ".exr") {
        compress_exr_in_threads();
        write_exr(file, engine::layers(execution, dumps), engine::attributes(execution));
        return;
    }
    Image colours;  // a result's fourth channel is no opacity
    write_png(file, values_of(engine::main_result(execution), Semantic::radiance, colours));
}

}  // namespace ir::cli
