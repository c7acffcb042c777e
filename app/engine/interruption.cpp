#include "app/engine/interruption.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace ir::engine {
namespace {

/// `timeout`, batch systems and shells that pass signals on deliver one interruption more than once.
constexpr std::int64_t same_ns = 500'000'000;

CancelToken token;
std::atomic<int> first_signal{0};
std::atomic<std::int64_t> first_ns{0};
int wake_up[2] = {-1, -1};
bool tells = false;

int status_of(int signal) {
    return 128 + signal;
}

/// Everything here is async-signal-safe.
void on_signal(int signal) {
    const int error = errno;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t now_ns = std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
    std::int64_t first = 0;
    if (first_ns.compare_exchange_strong(first, now_ns)) {
        constexpr char text[] = "\r\033[Kstopping at the next slice; once more ends at once\n";
        [[maybe_unused]] auto ignored = tells ? write(STDERR_FILENO, text, sizeof text - 1) : 0;
        first_signal = signal;
        token.cancel();
        ignored = write(wake_up[1], "", 1);
    } else if (now_ns - first >= same_ns) {
        _exit(status_of(first_signal));
    }
    errno = error;
}

}  // namespace

void watch_interruptions() {
    if (wake_up[0] < 0 && pipe2(wake_up, O_CLOEXEC | O_NONBLOCK) != 0) wake_up[0] = wake_up[1] = -1;
    tells = isatty(STDERR_FILENO) != 0;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(signal, &action, nullptr);
    }
}

const CancelToken& interruption() {
    return token;
}

int interruption_status() {
    return status_of(first_signal);
}

int interruption_descriptor() {
    return wake_up[0];
}

}  // namespace ir::engine
