#include "tests/watched_gl.h"

#include <EGL/egl.h>
#include <glad/gl.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace ir::test {
namespace {

std::mutex mutex;
std::map<std::string, int> living;
std::atomic<long> calls{0}, last_call{0}, of_later{0};
std::atomic<bool> is_lost{false}, was_lost{false};
std::atomic<long> storages{0}, refused_storage{0};
std::atomic<bool> has_no_memory{false}, was_refused{false};

/// Whether the call still reaches the driver. What lived in a context goes with it.
bool reaches_driver() {
    if (++calls == last_call) {
        const std::lock_guard lock(mutex);
        is_lost = was_lost = true;
        living.clear();
    }
    return !is_lost;
}

/// Whether the driver says that it has no memory for a buffer or an image.
bool is_refused() {
    if (++storages != refused_storage) return false;
    has_no_memory = was_refused = true;
    return true;
}

/// Objects that a function makes or deletes: by the number and the names at the end, or one.
template <class... Values>
int objects_in(bool deletes, Values... values) {
    constexpr std::size_t count = sizeof...(Values);
    const auto all = std::make_tuple(values...);
    if constexpr (count >= 2) {
        if constexpr (std::is_convertible_v<std::tuple_element_t<count - 1, std::tuple<Values...>>,
                                            const GLuint*>) {
            const auto number = std::get<count - 2>(all);
            const GLuint* names = std::get<count - 1>(all);
            return int(deletes ? number - std::count(names, names + number, 0u) : number);
        }
    }
    if constexpr (count >= 1)
        if (deletes && !std::get<0>(all)) return 0;
    return 1;
}

template <class... Values>
void note(std::string_view function, Values... values) {
    const bool makes = function.starts_with("glCreate"), deletes = function.starts_with("glDelete");
    if (!makes && !deletes) return;
    std::string kind(function.substr(8));
    if (kind == "ShaderProgramv") kind = "Program";
    if (kind.back() != 's') kind += 's';
    const std::lock_guard lock(mutex);
    living[kind] += (makes ? 1 : -1) * objects_in(deletes, values...);
}

template <class Result>
Result answer_of_lost([[maybe_unused]] std::string_view function) {
    if constexpr (std::is_same_v<Result, GLenum>) {
        if (function == "glGetGraphicsResetStatus") return GL_UNKNOWN_CONTEXT_RESET;
        if (function == "glGetError") return GL_CONTEXT_LOST;
    }
    return Result();
}

template <class Function, int id>
struct Watched;
template <class Result, class... Values, int id>
struct Watched<Result (*)(Values...), id> {
    static inline Result (*real)(Values...) = nullptr;
    static inline std::string_view name;
    static inline bool is_storage = false, is_error = false;
    static Result call(Values... values) {
        if (!reaches_driver()) return answer_of_lost<Result>(name);
        note(name, values...);
        if constexpr (std::is_void_v<Result>)
            if (is_storage && is_refused()) return;
        if constexpr (std::is_same_v<Result, GLenum>)
            if (is_error && has_no_memory.exchange(false)) return GL_OUT_OF_MEMORY;
        return real(values...);
    }
};

using Address = __eglMustCastToProperFunctionPointerType;

template <class Function, int id>
Address watched(const char* name, Address real) {
    using Of = Watched<Function, id>;
    static std::once_flag once;  // each context asks, in threads of their own
    std::call_once(once, [&] {
        Of::name = name;
        Of::is_storage = Of::name == "glNamedBufferStorage" || Of::name.starts_with("glTextureStorage");
        Of::is_error = Of::name == "glGetError";
        Of::real = reinterpret_cast<Function>(real);
    });
    return reinterpret_cast<Address>(&Of::call);
}

Address watched(std::string_view name, Address real) {
#define WATCH(function)         \
    if (name == "gl" #function) \
        return watched<decltype(GladGLContext::function), __COUNTER__>("gl" #function, real);
#include "tests/watched_functions.inc"
#undef WATCH
    return real;
}

}  // namespace

std::map<std::string, int> living_gl_objects() {
    const std::lock_guard lock(mutex);
    auto result = living;
    std::erase_if(result, [](const auto& kind) { return kind.second == 0; });
    return result;
}

long gl_calls() {
    return calls;
}

void lose_context_at(long call, long later) {
    of_later = later;
    last_call = call > 0 ? calls + call : 0;
    was_lost = false;
}

bool was_context_lost() {
    return was_lost;
}

long gl_storages() {
    return storages;
}

void refuse_storage_at(long storage) {
    refused_storage = storage > 0 ? storages + storage : 0;
    has_no_memory = was_refused = false;
}

bool was_storage_refused() {
    return was_refused;
}

}  // namespace ir::test

extern "C" {

ir::test::Address __real_eglGetProcAddress(const char* name);
EGLContext __real_eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext shared,
                                   const EGLint* attributes);

ir::test::Address __wrap_eglGetProcAddress(const char* name) {
    const auto real = __real_eglGetProcAddress(name);
    return real ? ir::test::watched(name, real) : nullptr;
}

EGLContext __wrap_eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext shared,
                                   const EGLint* attributes) {
    ir::test::is_lost = false;
    ir::test::calls = 0;
    ir::test::last_call = ir::test::of_later.load();
    return __real_eglCreateContext(display, config, shared, attributes);
}

}  // extern "C"
