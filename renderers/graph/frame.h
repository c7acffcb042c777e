#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderers/graph/cache.h"
#include "renderers/graph/plan.h"

namespace ir::graph {

/// What a frame would take.
struct MemoryPlan {
    std::uint64_t bytes = 0;
    struct Resource {
        std::string key, lower;  ///< the latter as BufferDesc has it, where the buffer has grown
        std::uint64_t bytes = 0;
    };
    Resource largest;         ///< with its history
    Resource largest_buffer;  ///< without
};

/// What the planned resources take; `elements` says how many of a buffer there are. Of objects those count
/// that are in `objects`: what the others will take is not known before they are made.
MemoryPlan memory_of(const GraphBuilder& builder, const Plan& plan,
                     const std::map<std::string, StoredObject>& objects,
                     const std::function<std::uint64_t(const BufferDesc&)>& elements);

WorkKey work_of(const Method& method, const Settings& settings, const FrameInputs& inputs,
                const FrameOptions& options);
/// Patterns of what a frame keeps: what is asked for, the main result and its mask.
std::vector<std::string> wanted_of(const Method& method, const Settings& settings,
                                   const FrameOptions& options);

/// A frame in flight, or an explanation of the one before, and what is its own. PassContext works on it.
struct Frame {
    Frame(GraphCache& c, const Method& m, const Settings& s, const FrameInputs& i, const FrameOptions& o)
        : cache(c), method(&m), settings(&s), inputs(&i), options(&o) {
        cache.is_running = true;
    }
    ~Frame() { cache.is_running = false; }
    Frame(const Frame&) = delete;

    GraphCache& cache;
    const Method* method;
    const Settings* settings;
    const FrameInputs* inputs;
    const FrameOptions* options;
    GraphBuilder* builder = nullptr;
    Plan plan;
    std::vector<bool> cached, ran;           ///< passes that need not run; that ran in this attempt
    bool is_cut_short = false;               ///< a buffer overflowed, so passes after it did not run
    std::vector<Physical*> images, buffers;  ///< by index of the builder; null where culled
    std::unique_ptr<std::atomic<std::uint32_t>[]> host_counters;
    CancelToken never_cancelled;
    std::vector<double> views_ms;  ///< by pass: spent on views between its slices
    FrameInputs anew;              ///< of a frame whose restored history does not fit

    const CancelToken& cancel() const { return options->cancel ? *options->cancel : never_cancelled; }
    const std::string& key_of(const Pass::Access& access) const;

    // graph.cpp: a frame
    void begin();
    void run_attempts(const std::vector<std::string>& requested);
    bool divide_further();
    /// False where the budget does not allow the frame, or an object that a pass made.
    bool run_fitting();
    bool run_passes();
    /// Whether the pass counted, on the host, more elements than a buffer has room for, in a frame that runs
    /// again then.
    bool has_overflowed(std::size_t pass) const;
    void resolve_times();

    /// For explanations, which run on what is there then.
    void remember_committed(std::vector<std::string> wanted);

    // frame_cache.cpp: contents that outlive a frame
    bool has_contents(const Pass::Access& access) const;
    bool is_cached(const Pass& pass);
    /// Whether later frames may find all that it writes.
    bool is_kept(const Pass& pass) const;
    void find_cached_passes();
    void keep_fingerprints(const Pass& pass, std::size_t index);
    /// Of what was made from growable buffers in this attempt: elements may be missing.
    void drop_unsure_fingerprints();
    bool has_later_writer(std::size_t pass_index, Pass::Access::Kind kind, int index) const;
    /// By counter, what the passes up to this one counted.
    std::vector<std::uint64_t> counts_by(std::size_t pass) const;
    std::vector<std::uint64_t> read_counters();

    // run_pass.cpp
    PassReport run_pass(const Pass& pass, std::size_t index);
    void prepare_access(const Pass& pass, const Pass::Access& access);
    int run_slices(const Pass& pass, std::size_t index, PassContext& pass_context);
    void serve_views(bool on_gl, std::size_t index);
    void drop_contents(const Pass& pass);
};

/// What passes leave that later ones overwrite: steps.cpp.
class FrameSteps {
  public:
    explicit FrameSteps(Frame& frame) : frame_(frame) {}
    void keep_versions(const Pass& pass, std::size_t index);
    void trace_pixel(const Pass& pass, std::size_t index);
    /// Of FrameOptions::versions, and written by several passes: these run, whatever was there already.
    bool writes_version(const Pass::Access& access) const;

  private:
    void keep_image(std::size_t pass, const ImageDesc& desc);
    void keep_buffer(std::size_t pass, int buffer);
    void keep(GraphCache::Version version);
    bool has_room(std::size_t pass, const std::string& label, std::uint64_t bytes);
    std::uint64_t elements_by(std::size_t pass, int buffer) const;

    Frame& frame_;
};

/// What a frame takes, by the budget: frame_memory.cpp.
class FrameMemory {
  public:
    explicit FrameMemory(Frame& frame) : frame_(frame) {}
    std::uint64_t capacity_of(const BufferDesc& desc) const;
    MemoryPlan plan() const;
    bool fits(const MemoryPlan& memory) const;
    /// What the budget leaves over for a spare object beside the others that are there; the largest number
    /// without a budget.
    std::uint64_t spare_bytes(const std::string& key) const;
    /// Frees objects that this frame makes anew, and spare ones that take more than is left over.
    void free_objects();
    void allocate();
    void prepare_counters();
    void prepare_parameters();
    /// Enlarges buffers that were too small for what was counted; whether there were any.
    bool grow(const std::vector<std::uint64_t>& counts);

  private:
    /// For all spare objects together.
    std::uint64_t left_over() const;

    Frame& frame_;
};

// read_back.cpp: Graph::read_image(), read_buffer() and read_texel(), also in the middle of a frame
std::optional<Image> read_image(GraphCache& cache, const std::string& key, int level, int layer);
std::optional<std::vector<std::byte>> read_buffer(GraphCache& cache, const std::string& key,
                                                  std::uint64_t max_bytes);
std::optional<std::vector<float>> read_texel(GraphCache& cache, const std::string& key, int x, int y,
                                             int layer);

/// graph.cpp: the method's passes; whether there is one more, for what shaders say of the picked pixel.
bool declare(Frame& frame, GraphBuilder& declared);

/// memory_advice.cpp: throws BudgetError that says what would make the frame fit.
[[noreturn]] void refuse(Frame& frame, const MemoryPlan& memory);

// history.cpp: contents from elsewhere as those of the previous frame

/// False where the restored history does not fit what is declared: it was dropped, and the frame has to be
/// declared again as one that begins anew.
bool accept_restored(Frame& frame);
void put_restored(Frame& frame);

// frame_sharing.cpp: contents with a fingerprint that other graphs have, too; nothing without shared contents

/// Before memory is planned: buffers that have grown elsewhere are as large here.
void learn_shared_capacities(Frame& frame);
/// Takes what others have made; passes that would make it are cached then.
void adopt_shared(Frame& frame);
/// Offers what a complete frame has.
void share_contents(Frame& frame);

/// frame_report.cpp: what the passes left, with the frame's counts.
void fill_report(Frame& frame, const std::vector<std::uint64_t>& counts);

/// A frame that still overflows then never ends.
inline constexpr int max_growths_per_frame = 16;

/// Distance in bytes between counters in their buffer: a multiple of every driver's binding alignment.
inline constexpr std::uint64_t counter_stride = 256;

}  // namespace ir::graph
