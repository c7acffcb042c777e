#pragma once

#include <cstdint>
#include <limits>

namespace ir {

/// How the disk treats this program's own system calls. The linker puts us between (--wrap).
struct FaultyDisk {
    std::int64_t room = std::numeric_limits<std::int64_t>::max();  ///< bytes until it is full
    std::int64_t max_at_once = room;                               ///< bytes that one write takes
    bool interrupts = false;                                       ///< every second write
    bool fails_to_sync = false, fails_to_close = false;            ///< what it has seemed to take
    bool loses_bytes = false;                                      ///< when it closes, and says nothing
    bool loses_answers = false;  ///< as a network may: what was renamed seems not to be
    int stale_reads = 0;         ///< of files that were replaced meanwhile
};

/// For as long as it lives; one at a time.
class DiskFault {
  public:
    explicit DiskFault(const FaultyDisk& disk);
    ~DiskFault();
    DiskFault(const DiskFault&) = delete;
    DiskFault& operator=(const DiskFault&) = delete;
};

}  // namespace ir
