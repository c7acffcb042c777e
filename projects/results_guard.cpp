#include "projects/results_guard.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace ir::projects {

ResultsGuard::ResultsGuard(const std::filesystem::path& project_folder) {
    const auto results = project_folder / "results";
    std::error_code ignored;
    std::filesystem::create_directories(results, ignored);
    descriptor_ =
        ::open((results / results_guard_name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor_ < 0) return;
    while (::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
}

ResultsGuard::~ResultsGuard() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace ir::projects
