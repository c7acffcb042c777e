#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "renderers/core/progress.h"
#include "renderers/gl/device.h"
#include "renderers/gl/program.h"
#include "renderers/graph/builder.h"

namespace ir::graph {

class Graph;
struct Physical;

/// What a running pass may touch: only what it declared; anything else throws std::logic_error that names
/// pass and resource. Images and buffers are in device memory for passes of the gl queue, in host memory for
/// those of the cpu queue; the graph copies.
class PassContext {
  public:
    const FrameInputs& inputs() const;
    const CancelToken& cancel() const;

    // gl queue
    // ---------------------------------------------------------------------------------------------------
    const gl::Api& api() const;
    gl::Name image(ImageRef ref) const;
    gl::Name previous(ImageRef ref) const;
    gl::Name buffer(BufferRef ref) const;
    gl::Name previous(BufferRef ref) const;

    /// A program without, and one with the method's parameter block (which is then bound).
    const gl::Program& program(const gl::ProgramSource& source) const;
    const gl::Program& method_program(gl::ProgramSource source) const;

    void bind_buffer(int binding, BufferRef ref) const;
    void bind_previous_buffer(int binding, BufferRef ref) const;
    /// GLSL: layout(std430, binding = N) buffer … { uint name; };
    void bind_counter(int binding, CounterRef ref) const;
    void bind_texture(int unit, ImageRef ref) const;  ///< nearest, clamped
    void bind_texture(int unit, ImageRef ref, const scene::Sampler& sampler) const;
    void bind_previous_texture(int unit, ImageRef ref) const;
    void bind_storage_image(int unit, ImageRef ref, int level = 0) const;  ///< all layers, read and write

    /// A framebuffer with these attachments (layer -1: all layers, for layered rendering), bound with a
    /// fitting viewport.
    struct Attachment {
        ImageRef image;
        int layer = -1, level = 0;
    };
    void bind_framebuffer(const std::vector<Attachment>& colours, const Attachment* depth = nullptr) const;
    /// A framebuffer without attachments, for passes that only write buffers.
    void bind_empty_framebuffer(int width, int height, int layers = 0) const;
    /// A vertex array without attributes, for draws that fetch from buffers or need no vertices.
    void bind_empty_vertex_array() const;
    /// Three vertices that cover the viewport: draw after using a program whose vertex stage is
    /// "lib/full_screen.vert".
    void draw_full_screen() const;

    void upload(BufferRef ref, std::span<const std::byte> bytes, std::uint64_t offset = 0) const;
    void upload(ImageRef ref, std::span<const std::byte> texels, int level = 0, int layer = 0) const;
    void clear(ImageRef ref) const;
    void clear(BufferRef ref) const;
    void barrier() const;

    // cpu queue
    // --------------------------------------------------------------------------------------------------
    /// Level 0, row 0 first, in the format's own type. Read-only unless the pass writes it.
    template <class T>
    std::span<T> pixels(ImageRef ref, int layer = 0) const {
        return cast<T>(host(ref, layer, false));
    }
    template <class T>
    std::span<T> previous_pixels(ImageRef ref, int layer = 0) const {
        return cast<T>(host(ref, layer, true));
    }
    template <class T>
    std::span<T> elements(BufferRef ref) const {
        return cast<T>(host(ref, false));
    }
    template <class T>
    std::span<T> previous_elements(BufferRef ref) const {
        return cast<T>(host(ref, true));
    }
    void add(CounterRef ref, std::uint32_t amount) const;  ///< thread-safe
    /// A number for the report's counters that is no count: a speed, an estimated error. Of the graph's
    /// thread; the last value of a frame counts.
    void set_figure(const std::string& key, double value) const;
    /// A figure that adds up over frames, such as a time.
    void set_sum(const std::string& key, double value) const;
    /// Adds a warning to the frame's messages, once where it is the same. Of the graph's thread.
    void warn(std::string text) const;

    // objects
    // ----------------------------------------------------------------------------------------------------
    template <class T>
    std::shared_ptr<T> object(ObjectRef ref) const {
        return std::static_pointer_cast<T>(stored(ref));
    }
    void store(ObjectRef ref, std::shared_ptr<void> object, std::uint64_t bytes) const;

    // both
    // -------------------------------------------------------------------------------------------------------
    gl::ImageShape shape(ImageRef ref) const;
    std::uint64_t capacity(BufferRef ref) const;  ///< elements
    /// Whether reads_previous finds a committed frame.
    bool has_previous() const;

  private:
    friend class Graph;
    PassContext(Graph& graph, const Pass& pass) : graph_(graph), pass_(pass) {}
    Physical& physical(ImageRef ref, bool previous, bool write = false) const;
    Physical& physical(BufferRef ref, bool previous, bool write = false) const;
    void check_declared(CounterRef ref) const;
    std::span<std::byte> host(ImageRef ref, int layer, bool previous) const;
    std::span<std::byte> host(BufferRef ref, bool previous) const;
    std::shared_ptr<void> stored(ObjectRef ref) const;
    template <class T>
    static std::span<T> cast(std::span<std::byte> bytes) {
        return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
    Graph& graph_;
    const Pass& pass_;
};

}  // namespace ir::graph
