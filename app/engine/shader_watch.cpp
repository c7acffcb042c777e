#include "app/engine/shader_watch.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

/// Editors write in several steps.
constexpr int pause_ms = 20;
/// Where the system has no descriptor left, it is asked again after this.
constexpr int retry_ms = 1000;
constexpr std::uint32_t changes = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE | IN_DELETE;

}  // namespace

ShaderWatch::ShaderWatch(fs::path folder, std::function<void()> changed)
    : folder_(std::move(folder)),
      changed_(std::move(changed)),
      stop_(::eventfd(0, EFD_CLOEXEC)),
      events_(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
    if (stop_ < 0) return;
    watch_folders();
    thread_ = std::thread([this] { wait(); });
}

ShaderWatch::~ShaderWatch() {
    if (thread_.joinable()) {
        ::eventfd_write(stop_, 1);
        thread_.join();
    }
    for (const int descriptor : {events_, stop_})
        if (descriptor >= 0) ::close(descriptor);
}

/// Those that are watched already stay so.
void ShaderWatch::watch_folders() const {
    ::inotify_add_watch(events_, folder_.c_str(), changes);
    std::error_code error;
    fs::recursive_directory_iterator entry(folder_, error), end;
    for (; !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        if (entry->is_directory(ignored)) ::inotify_add_watch(events_, entry->path().c_str(), changes);
    }
}

bool ShaderWatch::hear_all() const {
    alignas(inotify_event) std::array<char, 4096> heard;
    for (;;) {
        const auto bytes = ::read(events_, heard.data(), heard.size());
        if (bytes <= 0) return bytes < 0 && errno == EAGAIN;
    }
}

bool ShaderWatch::begin_anew() {
    if (events_ >= 0) ::close(events_);
    events_ = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
    return events_ >= 0;
}

void ShaderWatch::wait() {
    for (;;) {
        std::array<pollfd, 2> descriptors{{{stop_, POLLIN, 0}, {events_, POLLIN, 0}}};
        if (::poll(descriptors.data(), descriptors.size(), events_ < 0 ? retry_ms : -1) < 0) {
            if (errno == EINTR) continue;
            return;
        }
        if (descriptors[0].revents != 0 || ::poll(descriptors.data(), 1, pause_ms) > 0) return;
        if ((events_ < 0 || !hear_all()) && !begin_anew()) continue;
        watch_folders();
        changed_();
    }
}

}  // namespace ir::engine
