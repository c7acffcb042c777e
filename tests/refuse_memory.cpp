// Refuses memory to its program: the REFUSE_AT-th allocation that code of the program itself asks operator
// new for, counted from 1, throws std::bad_alloc. Those of libraries are left alone: some cannot unwind.
// Without REFUSE_AT their number is written to the file REFUSE_COUNT. Tests preload it.
#include <link.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> asked{0};

struct Span {
    std::uintptr_t first = 0, end = 0;
};

/// Where the program's own code lies, which comes first in the list of what is loaded.
Span code_of_program() {
    Span span;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* found) {
            for (int i = 0; i < info->dlpi_phnum; ++i) {
                const auto& header = info->dlpi_phdr[i];
                if (header.p_type != PT_LOAD || !(header.p_flags & PF_X)) continue;
                const auto first = info->dlpi_addr + header.p_vaddr;
                *static_cast<Span*>(found) = {first, first + header.p_memsz};
            }
            return 1;
        },
        &span);
    return span;
}

bool is_refused(const void* caller) {
    static const Span program = code_of_program();
    const auto place = reinterpret_cast<std::uintptr_t>(caller);
    if (place < program.first || place >= program.end) return false;
    static const char* at = std::getenv("REFUSE_AT");
    const long now = ++asked;
    return at && now == std::atol(at);
}

void* memory(std::size_t bytes, std::size_t alignment, const void* caller) {
    if (is_refused(caller)) throw std::bad_alloc();
    void* found = nullptr;
    if (bytes == 0) bytes = 1;
    if (alignment <= alignof(std::max_align_t))
        found = std::malloc(bytes);
    else if (::posix_memalign(&found, alignment, bytes) != 0)
        found = nullptr;
    if (!found) throw std::bad_alloc();
    return found;
}

__attribute__((destructor)) void tell() {
    const char* file = std::getenv("REFUSE_COUNT");
    if (!file || std::getenv("REFUSE_AT")) return;
    if (std::FILE* out = std::fopen(file, "w")) {
        std::fprintf(out, "%ld\n", asked.load());
        std::fclose(out);
    }
}

}  // namespace

void* operator new(std::size_t bytes) {
    return memory(bytes, 1, __builtin_return_address(0));
}
void* operator new[](std::size_t bytes) {
    return memory(bytes, 1, __builtin_return_address(0));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return memory(bytes, std::size_t(alignment), __builtin_return_address(0));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
    return memory(bytes, std::size_t(alignment), __builtin_return_address(0));
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
