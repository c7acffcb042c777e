#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderers/graph/graph.h"
#include "renderers/graph/plan.h"
#include "renderers/graph/pool.h"

namespace ir::graph {

/// A host object and the contents it stands for.
struct StoredObject {
    std::shared_ptr<void> object;
    std::uint64_t bytes = 0;
    std::string fingerprint;
};

/// What a Graph keeps, and what the frame in flight needs. PassContext works on it.
struct Graph::State {
    State(gl::Device& d, gl::Context* c, gl::ProgramLibrary* p)
        : device(d), context(c), programs(p), pool(d) {}

    gl::Device& device;
    gl::Context* context;
    gl::ProgramLibrary* programs;
    Pool pool;
    std::map<std::string, StoredObject> objects;
    std::map<std::string, BufferDesc> buffer_descs;  ///< of the last frame
    std::vector<std::pair<scene::Sampler, GLuint>> samplers;
    GLuint empty_vertex_array = 0;
    std::vector<GLuint> framebuffers;  ///< of the running pass

    // Learned from frame to frame.
    std::map<std::string, std::uint64_t> grown;      ///< capacity by buffer key
    std::map<std::string, std::uint64_t> estimates;  ///< for which the capacity was learned
    std::map<std::string, double> items_per_ms;      ///< by pass, for slices
    Settings settings_of_batches;
    int batches = 1;
    int growths = 0;

    // The frame in flight.
    const Method* method = nullptr;
    const Settings* settings = nullptr;
    const FrameInputs* inputs = nullptr;
    const FrameOptions* options = nullptr;
    GraphBuilder* builder = nullptr;
    Plan plan;
    std::vector<Physical*> images, buffers;  ///< by index of the builder; null where culled
    gl::Name counter_buffer = 0;
    std::uint64_t counter_capacity = 0;
    std::unique_ptr<std::atomic<std::uint32_t>[]> host_counters;
    gl::Name parameter_buffer = 0;
    std::uint64_t parameter_bytes = 0;
    CancelToken never_cancelled;

    FrameReport report;

    ~State();
    const CancelToken& cancel() const { return options->cancel ? *options->cancel : never_cancelled; }
    void allocate();
    void prepare_counters();
    void prepare_parameters();
    PassReport run_pass(Graph& graph, const Pass& pass, std::size_t index);
    bool is_cached(const Pass& pass) const;
    bool has_later_writer(std::size_t pass_index, Pass::Access::Kind kind, int index) const;
    std::uint64_t planned_bytes(std::string* largest, std::string* lower) const;
    std::uint64_t capacity_of(const BufferDesc& desc) const;
    std::vector<std::uint64_t> read_counters();
    bool grow(const std::vector<std::uint64_t>& counts);
    void fill_report(const std::vector<std::uint64_t>& counts);
    void reset_gl_state() const;
    void delete_framebuffers();
};

/// Distance in bytes between counters in their buffer: a multiple of every driver's binding alignment.
inline constexpr std::uint64_t counter_stride = 256;

}  // namespace ir::graph
