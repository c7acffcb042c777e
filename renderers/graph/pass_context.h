#pragma once

#include <any>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "renderers/core/progress.h"
#include "renderers/gl/device.h"
#include "renderers/gl/program.h"
#include "renderers/graph/builder.h"

namespace ir::graph {

struct Frame;
struct Physical;

/// What a pass says of the frame besides its resources. Of the graph's thread.
class PassNotes {
  public:
    explicit PassNotes(Frame& frame) : frame_(frame) {}
    /// A number for the report's counters that is no count: a speed, an estimated error. The last value of a
    /// frame counts.
    void set_figure(const std::string& key, double value) const;
    /// A figure that adds up over frames, such as a time.
    void set_sum(const std::string& key, double value) const;
    /// Adds a warning to the frame's messages, once where it is the same.
    void warn(std::string text) const;

  private:
    Frame& frame_;
};

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

    /// Makes a program current and binds to its names what the pass declares. Programs with a file in
    /// "methods/" see the method's `params`. Throws Error that names pass, program and resource for a name
    /// to which nothing is bound, and for a wrong kind, format or access.
    const gl::Program& use(const gl::ProgramSource& source) const;
    void use(const gl::Program& program) const;
    /// Puts something else behind a name, from now on and in the current program. An absent ref: nothing,
    /// for a texture that the program does not look at now.
    void bind(const std::string& name, ImageRef ref, int level = 0) const;
    void bind(const std::string& name, ImageRef ref, const scene::Sampler& sampler) const;
    void bind(const std::string& name, BufferRef ref) const;
    /// The program sees the image's texels as another format of as many bytes.
    void bind(const std::string& name, ImageRef ref, gl::Format format) const;

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
    std::span<T> elements(BufferRef ref) const {
        return cast<T>(host(ref, false));
    }
    /// Of history.
    template <class T>
    std::span<T> previous_contents(ImageRef ref, int layer = 0) const {
        return cast<T>(host(ref, layer, true));
    }
    template <class T>
    std::span<T> previous_contents(BufferRef ref) const {
        return cast<T>(host(ref, true));
    }
    void add(CounterRef ref, std::uint32_t amount) const;  ///< thread-safe
    PassNotes notes() const;

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
    std::uint64_t capacity(ObjectRef ref) const;  ///< bytes that a spare object may take
    /// Whether reads_previous finds a committed frame.
    bool has_previous() const;

  private:
    friend struct Frame;
    PassContext(Frame& frame, const Pass& pass);
    /// Throws Error for what a pass with programs declares for none of them: a name that no program has, or a
    /// resource with a name of its own that no program has and the pass does not touch by itself.
    void check_names() const;
    const gl::Program& program(const gl::ProgramSource& source) const;
    const gl::Program& method_program(const gl::ProgramSource& source) const;
    void offer(const std::string& name, const Pass::Binding& binding);
    bool writes(Pass::Access::Kind kind, int index) const;
    void bind_element(const gl::ProgramResource& resource, int element) const;
    void put(const std::string& name, const Pass::Binding& binding) const;
    [[noreturn]] void refuse(const gl::ProgramResource& resource, const std::string& problem) const;
    void bind_image(const gl::ProgramResource& resource, GLuint unit, const Pass::Binding& binding) const;
    void bind_block(const gl::ProgramResource& resource, const Pass::Binding& binding) const;
    /// Compares the program's records with the buffer's fields, once.
    void compare_records(const gl::ProgramResource& resource, BufferRef ref) const;
    GLuint sampler_of(const scene::Sampler& sampler) const;
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
    Frame& frame_;
    const Pass& pass_;
    mutable std::map<std::string, Pass::Binding> bindings_;
    mutable std::vector<const gl::Program*> programs_;  ///< that were used; the last is current
    mutable std::set<std::pair<Pass::Binding::Kind, int>> touched_;
};

}  // namespace ir::graph
