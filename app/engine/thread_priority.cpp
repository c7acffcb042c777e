#include "app/engine/thread_priority.h"

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace ir::engine {
namespace {

/// Where both want the same core, the window gets nearly all of it.
[[maybe_unused]] constexpr int niceness = 19;

}  // namespace

void give_way_to_others() {
#ifdef __linux__
    // On Linux niceness belongs to threads and is inherited by those they start: software OpenGL's and TBB's.
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), niceness);
#endif
}

}  // namespace ir::engine
