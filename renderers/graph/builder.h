#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "renderers/core/parameter.h"
#include "renderers/graph/frame_inputs.h"
#include "renderers/graph/resource.h"

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
    };
    std::vector<Access> accesses;
    std::vector<CounterRef> counters;
    std::int64_t items = 1, first_slice = 0;
    std::function<void(PassContext&, Slice)> execute;
};

/// Declares one pass: `builder.pass("trace").reads(a, b).writes(c).execute([=](PassContext& p) { … });`
class PassBuilder {
  public:
    explicit PassBuilder(Pass& pass) : pass_(&pass) {}
    template <class... Refs>
    PassBuilder& reads(Refs... refs) {
        (access(refs, false, false), ...);
        return *this;
    }
    /// Also for passes that modify what an earlier pass wrote.
    template <class... Refs>
    PassBuilder& writes(Refs... refs) {
        (access(refs, true, false), ...);
        return *this;
    }
    /// The contents that the last committed frame left in the resource (zeros in the first frame).
    template <class... Refs>
    PassBuilder& reads_previous(Refs... refs) {
        (access(refs, false, true), ...);
        return *this;
    }
    PassBuilder& counts(CounterRef counter);
    void execute(std::function<void(PassContext&)> run);
    /// Divisible work: `run` is called for consecutive ranges of [0, items), sized so that each takes about
    /// 30 ms; `first_slice` is the size of the first one (0: items / 1024).
    void execute_sliced(std::int64_t items, std::function<void(PassContext&, Slice)> run,
                        std::int64_t first_slice = 0);

  private:
    void access(ImageRef ref, bool write, bool previous);
    void access(BufferRef ref, bool write, bool previous);
    void access(ObjectRef ref, bool write, bool previous);
    Pass* pass_;
};

/// Given to a method's setup, which declares resources and passes for one frame.
class GraphBuilder {
  public:
    GraphBuilder(const FrameInputs& inputs, int batches, std::uint64_t max_buffer_bytes)
        : inputs_(inputs), batches_(batches), max_buffer_bytes_(max_buffer_bytes) {}

    const FrameInputs& inputs() const { return inputs_; }

    /// Throw std::logic_error for a key that is taken or malformed.
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
    void claim(const std::string& key);
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
