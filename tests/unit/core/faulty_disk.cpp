#include "tests/unit/core/faulty_disk.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <optional>

namespace {

std::optional<ir::FaultyDisk> disk;
bool was_interrupted = false;

bool is_on_disk(int descriptor) {
    struct stat info {};
    return disk && ::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode);
}

int failing_with(int error) {
    errno = error;
    return -1;
}

}  // namespace

extern "C" {

ssize_t __real_write(int descriptor, const void* bytes, std::size_t count);
int __real_fsync(int descriptor);
int __real_close(int descriptor);
int __real_rename(const char* from, const char* to);
ssize_t __real_read(int descriptor, void* bytes, std::size_t count);

ssize_t __wrap_write(int descriptor, const void* bytes, std::size_t count) {
    if (!is_on_disk(descriptor)) return __real_write(descriptor, bytes, count);
    if (disk->interrupts && (was_interrupted = !was_interrupted)) return failing_with(EINTR);
    if (disk->room == 0 && count > 0) return failing_with(ENOSPC);
    const auto taken = std::min({static_cast<std::int64_t>(count), disk->room, disk->max_at_once});
    disk->room -= taken;
    return __real_write(descriptor, bytes, static_cast<std::size_t>(taken));
}

int __wrap_fsync(int descriptor) {
    if (is_on_disk(descriptor) && disk->fails_to_sync) return failing_with(EIO);
    return __real_fsync(descriptor);
}

int __wrap_close(int descriptor) {
    if (!is_on_disk(descriptor)) return __real_close(descriptor);
    struct stat info {};
    if (disk->loses_bytes && ::fstat(descriptor, &info) == 0 && info.st_size > 0 &&
        ::ftruncate(descriptor, info.st_size - 1) != 0)
        return -1;
    const int closed = __real_close(descriptor);
    return disk->fails_to_close ? failing_with(EDQUOT) : closed;
}

int __wrap_rename(const char* from, const char* to) {
    const int renamed = __real_rename(from, to);
    return renamed == 0 && disk && disk->loses_answers ? failing_with(ENOENT) : renamed;
}

ssize_t __wrap_read(int descriptor, void* bytes, std::size_t count) {
    if (!is_on_disk(descriptor) || disk->stale_reads == 0) return __real_read(descriptor, bytes, count);
    --disk->stale_reads;
    return failing_with(ESTALE);
}

}  // extern "C"

namespace ir {

DiskFault::DiskFault(const FaultyDisk& faulty) {
    disk = faulty;
}

DiskFault::~DiskFault() {
    disk.reset();
}

}  // namespace ir
