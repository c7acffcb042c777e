#include "projects/results_guard.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "renderers/core/error.h"
#include "renderers/core/file_system.h"

namespace ir::projects {

ResultsGuard::ResultsGuard(const std::filesystem::path& project_folder) {
    const auto results = project_folder / "results";
    real_file_system().create_directories(results);
    const auto file = results / results_guard_name;
    constexpr int flags = O_CLOEXEC | O_NOFOLLOW;
    descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | flags, 0666);
    // Somebody else's, in a folder that several people write: that is enough to lock it.
    if (descriptor_ < 0 && errno == EACCES &&
        ::faccessat(AT_FDCWD, results.c_str(), W_OK | X_OK, AT_EACCESS) == 0)
        descriptor_ = ::open(file.c_str(), O_RDONLY | flags);
    if (descriptor_ < 0) throw Error(results.string() + ": cannot be written: " + std::strerror(errno));
    int status;
    while ((status = ::flock(descriptor_, LOCK_EX)) != 0 && errno == EINTR) {
    }
    is_guarding_ = status == 0;
}

ResultsGuard::~ResultsGuard() {
    ::close(descriptor_);
}

}  // namespace ir::projects
