#pragma once

#include <concepts>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/method.h"
#include "renderers/core/parameter.h"
#include "renderers/gl/constants.h"
#include "renderers/gl/program_source.h"
#include "renderers/graph/frame_inputs.h"
#include "renderers/graph/resource.h"

namespace ir::gl {
class Program;
}  // namespace ir::gl

namespace ir::graph {

class PassContext;

enum class Queue { gl, cpu };

struct Slice {
    std::int64_t begin = 0, end = 0;
    bool first = true, last = true;
};

/// One step of a method, as declared. Passes run in the order of declaration.
struct Pass {
    std::string name;
    Queue queue = Queue::gl;
    struct Access {
        enum class Kind { image, buffer, object } kind;
        int index;
        bool write = false, previous = false;
        bool optional = false;  ///< no error where no program has it
    };
    std::vector<Access> accesses;
    std::vector<CounterRef> counters;
    /// What stands behind a name of the pass's programs; index -1: nothing.
    struct Binding {
        enum class Kind { image, buffer, counter } kind;
        int index;
        bool write = false, previous = false;
        int level = 0;                               ///< of images
        std::optional<scene::Sampler> sampler = {};  ///< of textures; else nearest, clamped
        std::optional<gl::Format> format = {};       ///< of images; else their own
        bool ambiguous = false;                      ///< several resources have this name
    };
    std::vector<std::pair<std::string, Binding>> bindings;
    std::int64_t items = 1, first_slice = 0;
    bool has_two_bodies = false;
    std::function<void(PassContext&, Slice)> execute;
};

/// The constants of a pass's program: a struct with IR_FIELDS, or a function of the running pass that returns
/// one.
class Constants {
  public:
    Constants() = default;
    template <HasFields T>
    Constants(const T& values)
        : give_(
              [values](const PassContext&, const Receiver& give) { give(gl::constants_of<T>(), &values); }) {}
    template <std::invocable<const PassContext&> F>
    requires HasFields<std::invoke_result_t<F, const PassContext&>> Constants(F values)
        : give_([values = std::move(values)](const PassContext& context, const Receiver& give) {
              const auto constants = values(context);
              give(gl::constants_of<std::remove_const_t<decltype(constants)>>(), &constants);
          }) {}
    void give(const PassContext& context, const gl::Program& program) const;

  private:
    using Receiver = std::function<void(const gl::ConstantLayout&, const void*)>;
    std::function<void(const PassContext&, const Receiver&)> give_;
};

template <class Ref>
concept ResourceRef =
    std::same_as<Ref, ImageRef> || std::same_as<Ref, BufferRef> || std::same_as<Ref, ObjectRef>;

/// Declares one pass: `builder.pass("trace").reads("Rays", rays).writes("Hits", hits).execute(…)`. A name is
/// that of a block, sampler or image in the pass's programs; at least one of them must declare it. An absent
/// ref stands for nothing, until PassContext::bind says otherwise. What no program names (attachments,
/// uploads, passes of the cpu queue) is declared without; so is what has a name of its own (ImageDesc::name).
class PassBuilder {
  public:
    explicit PassBuilder(Pass& pass) : pass_(&pass) {}
    template <ResourceRef... Refs>
    PassBuilder& reads(Refs... refs) {
        (access(refs, false, false), ...);
        return *this;
    }
    /// What not all programs have that share a declaration, or what not every frame looks at.
    template <ResourceRef... Refs>
    PassBuilder& may_read(Refs... refs) {
        ((access(refs, false, false), pass_->accesses.back().optional = true), ...);
        return *this;
    }
    /// Also for passes that modify what an earlier pass wrote.
    template <ResourceRef... Refs>
    PassBuilder& writes(Refs... refs) {
        (access(refs, true, false), ...);
        return *this;
    }
    /// The contents that the last committed frame left in the resource (zeros in the first frame).
    template <ResourceRef... Refs>
    PassBuilder& reads_previous(Refs... refs) {
        (access(refs, false, true), ...);
        return *this;
    }
    template <ResourceRef Ref>
    PassBuilder& reads(std::string name, Ref ref) {
        return bind(std::move(name), ref, false, false);
    }
    PassBuilder& reads(std::string name, ImageRef ref, const scene::Sampler& sampler);
    template <ResourceRef Ref>
    PassBuilder& writes(std::string name, Ref ref) {
        return bind(std::move(name), ref, true, false);
    }
    template <ResourceRef Ref>
    PassBuilder& reads_previous(std::string name, Ref ref) {
        return bind(std::move(name), ref, false, true);
    }
    PassBuilder& counts(CounterRef counter);
    /// GLSL: buffer NAME { uint … };
    PassBuilder& counts(std::string name, CounterRef counter);
    /// The method has another pass in its place for the other processor (FrameInputs::processor).
    PassBuilder& has_two_bodies();
    void execute(std::function<void(PassContext&)> run);
    /// Divisible work: `run` is called for consecutive ranges of [0, items), sized so that each takes about
    /// 30 ms; `first_slice` is the size of the first one (0: items / 1024).
    void execute_sliced(std::int64_t items, std::function<void(PassContext&, Slice)> run,
                        std::int64_t first_slice = 0);
    /// One dispatch, with an invocation for each texel of all layers of an image.
    void compute(const gl::ProgramSource& source, ImageRef over, Constants constants = {});
    void compute(const gl::ProgramSource& source, std::int64_t invocations, Constants constants = {});
    /// Sliced: an invocation for each item; the program sees the uniforms `first_item` and `end_item`.
    void compute_sliced(const gl::ProgramSource& source, std::int64_t items, Constants constants = {},
                        std::int64_t first_slice = 0);
    /// Writes all of an image by a fragment shader behind shaders/lib/full_screen.vert.
    void draw(const gl::ProgramSource& source, ImageRef target, Constants constants = {});

  private:
    PassBuilder& bind(std::string name, ImageRef ref, bool write, bool previous);
    PassBuilder& bind(std::string name, BufferRef ref, bool write, bool previous);
    void access(ImageRef ref, bool write, bool previous);
    void access(BufferRef ref, bool write, bool previous);
    void access(ObjectRef ref, bool write, bool previous);
    Pass* pass_;
};

/// A growable buffer, and how many of its elements are in use.
struct CountedBuffer {
    BufferRef elements;
    CounterRef count;
};

/// Given to a method's setup, which declares resources and passes for one frame.
class GraphBuilder {
  public:
    GraphBuilder(const MethodDescription& method, const FrameInputs& inputs, int batches,
                 std::uint64_t max_buffer_bytes)
        : method_(method), inputs_(inputs), batches_(batches), max_buffer_bytes_(max_buffer_bytes) {}

    const FrameInputs& inputs() const { return inputs_; }

    /// The resource that holds an output of the method. Text, and the kind of a buffer, are those of the
    /// output's description. Throws std::logic_error, with method and key, where the method has no such
    /// output.
    ImageRef output(const std::string& key, ImageDesc desc);
    BufferRef output(const std::string& key, BufferDesc desc);
    /// An output that explains a picked pixel, with the counter of its elements. What `counter` does not say
    /// is made from the output: KEY_count, with the same label.
    CountedBuffer explanation(const std::string& key, BufferDesc desc, CounterDesc counter = {});
    /// What the description says of an output; throws as output() does.
    ResourceText text_of_output(const std::string& key) const;

    /// Throw std::logic_error for a key that is taken or malformed, and for an output with another text than
    /// its description's.
    ImageRef image(ImageDesc desc);
    BufferRef buffer(BufferDesc desc);
    ObjectRef object(ObjectDesc desc);
    CounterRef counter(CounterDesc desc);
    PassBuilder pass(std::string name, Queue queue = Queue::gl);

    /// Into how many parts a method should divide its work so that it fits the memory budget: 1, and twice as
    /// many each time that the graph found the frame too large, up to `limit`. A method that never asks is
    /// refused instead.
    int batches(int limit);
    std::uint64_t max_buffer_bytes() const { return max_buffer_bytes_; }

    /// Adds a note to the frame's messages.
    void note(std::string text) { notes_.push_back(std::move(text)); }

    const std::vector<ImageDesc>& images() const { return images_; }
    const std::vector<BufferDesc>& buffers() const { return buffers_; }
    const std::vector<ObjectDesc>& objects() const { return objects_; }
    const std::vector<CounterDesc>& counters() const { return counters_; }
    const std::deque<Pass>& passes() const { return passes_; }
    const std::vector<std::string>& notes() const { return notes_; }
    int batch_limit() const { return batch_limit_; }

  private:
    void claim(const ResourceText& text);
    const OutputDescription* find_output(const std::string& key) const;
    const OutputDescription& output_of(const std::string& key) const;
    [[noreturn]] void refuse_kind(const OutputDescription& output, const std::string& held_by) const;
    const MethodDescription& method_;
    /// What changed shaders make is of them alone.
    void tell_apart(std::string& fingerprint) const;
    const FrameInputs& inputs_;
    int batches_;
    int batch_limit_ = 1;
    std::uint64_t max_buffer_bytes_;
    std::vector<std::string> keys_;
    std::vector<ImageDesc> images_;
    std::vector<BufferDesc> buffers_;
    std::vector<ObjectDesc> objects_;
    std::vector<CounterDesc> counters_;
    std::deque<Pass> passes_;
    std::vector<std::string> notes_;
};

}  // namespace ir::graph
