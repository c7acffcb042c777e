/* Kills its process at one of the system calls by which it changes files: the KILL_AT-th, counted from 1, of those
 * below the folder KILL_BELOW. A write has then written half of its bytes. Without KILL_AT their number is written
 * to the file KILL_COUNT. Tests preload it. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_int calls;

static int is_below(const char *path) {
    const char *folder = getenv("KILL_BELOW");
    return folder && path && strncmp(path, folder, strlen(folder)) == 0;
}

static int is_open_below(int descriptor) {
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0) return 0;
    path[length] = '\0';
    return is_below(path);
}

/* Whether this call is the last. */
static int is_last(int is_counted) {
    const char *at = getenv("KILL_AT");
    if (!is_counted) return 0;
    return atomic_fetch_add(&calls, 1) + 1 == (at ? atoi(at) : -1);
}

static void die(void) {
    kill(getpid(), SIGKILL);
    for (;;) pause();
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int descriptor, const void *bytes, size_t count) {
    if (!is_last(is_open_below(descriptor))) return syscall(SYS_write, descriptor, bytes, count);
    syscall(SYS_write, descriptor, bytes, count / 2);
    die();
    return -1;
}

ssize_t writev(int descriptor, const struct iovec *parts, int count) {
    if (is_last(is_open_below(descriptor))) {
        if (count > 0) syscall(SYS_write, descriptor, parts[0].iov_base, parts[0].iov_len / 2);
        die();
    }
    return syscall(SYS_writev, descriptor, parts, count);
}

int fsync(int descriptor) {
    if (is_last(is_open_below(descriptor))) die();
    return (int)syscall(SYS_fsync, descriptor);
}

int rename(const char *from, const char *to) {
    if (is_last(is_below(to))) die();
    return REAL(rename)(from, to);
}

int link(const char *from, const char *to) {
    if (is_last(is_below(to))) die();
    return REAL(link)(from, to);
}

int unlink(const char *path) {
    if (is_last(is_below(path))) die();
    return REAL(unlink)(path);
}

int remove(const char *path) {
    if (is_last(is_below(path))) die();
    return REAL(remove)(path);
}

int mkdir(const char *path, mode_t mode) {
    if (is_last(is_below(path))) die();
    return REAL(mkdir)(path, mode);
}

static int open_file(const char *path, int flags, mode_t mode) {
    if (is_last((flags & (O_CREAT | O_TRUNC)) && is_below(path))) die();
    return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}

int open(const char *path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_file(path, flags, mode);
}

int open64(const char *path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_file(path, flags | O_LARGEFILE, mode);
}

__attribute__((destructor)) static void tell(void) {
    const char *file = getenv("KILL_COUNT");
    if (!file || getenv("KILL_AT")) return;
    FILE *out = fopen(file, "w");
    if (!out) return;
    fprintf(out, "%d\n", atomic_load(&calls));
    fclose(out);
}
