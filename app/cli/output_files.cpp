#include "app/cli/output_files.h"

#include "projects/store.h"
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

}  // namespace ir::cli
