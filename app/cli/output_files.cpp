#include "app/cli/output_files.h"

#include "app/cli/run_frames.h"
#include "renderers/core/error.h"

namespace ir::cli {
namespace {

namespace fs = std::filesystem;

fs::path place_of(const std::string& file) {
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(file), ignored);
}

}  // namespace

void OutputFiles::reads(const std::string& what, const std::string& file) {
    std::error_code ignored;
    if (!file.empty() && fs::is_regular_file(file, ignored)) known_.emplace(place_of(file), what);
}

void OutputFiles::writes(const std::string& option, const std::string& file) {
    std::error_code ignored;
    if (file.empty() || file == "-" || (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)))
        return;
    const auto refused = [&](const std::string& why) {
        throw UsageError(option + " '" + file + "' " + why + "; choose another file");
    };
    if (project_ && projects::is_own_file(*project_, file)) refused("is a file of the project");
    const auto [known, is_new] = known_.emplace(place_of(file), option);
    if (!is_new) refused("is the file of " + known->second);
}

bool has_picture_ending(const std::string& file) {
    auto extension = std::filesystem::path(file).extension().string();
    for (char& letter : extension)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return extension == ".exr" || extension == ".png" || extension == ".hdr" || extension == ".jpg";
}

void require_picture(const std::string& file, const std::vector<std::string>& dumps) {
    const auto extension = std::filesystem::path(file).extension();
    if (extension != ".exr" && extension != ".png")
        throw UsageError("--out '" + file + "' must end in .exr or .png");
    if (extension == ".png" && !dumps.empty())
        throw UsageError("--dump cannot be used with --out '" + file + "'; layers need a file.exr");
    require_folder_of(file, "--out");
}

}  // namespace ir::cli
