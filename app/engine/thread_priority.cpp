#include "app/engine/thread_priority.h"

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace ir::engine {
namespace {

/// A tenth of the window's share where both want the same core.
[[maybe_unused]] constexpr int niceness = 10;

}  // namespace

void give_way_to_others() {
#ifdef __linux__
    // On Linux niceness belongs to threads and is inherited by those they start: software OpenGL's and TBB's.
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), niceness);
#endif
}

}  // namespace ir::engine
