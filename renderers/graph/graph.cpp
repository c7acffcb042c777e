#include "renderers/graph/graph.h"

#include <algorithm>
#include <chrono>

#include "renderers/core/error.h"
#include "renderers/graph/state.h"

namespace ir::graph {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

Graph::State::~State() {
    if (counter_buffer) device.destroy_buffer(counter_buffer);
    if (parameter_buffer) device.destroy_buffer(parameter_buffer);
    if (!context) return;
    const auto& api = context->api();
    for (const auto& [sampler, name] : samplers) api.DeleteSamplers(1, &name);
    if (empty_vertex_array) api.DeleteVertexArrays(1, &empty_vertex_array);
    delete_framebuffers();
}

Graph::Graph(gl::Device& device, gl::Context* context, gl::ProgramLibrary* programs)
    : state_(std::make_unique<State>(device, context, programs)) {}

Graph::~Graph() = default;

const BufferDesc* Graph::buffer_desc(const std::string& key) const {
    const auto found = state_->buffer_descs.find(key);
    return found == state_->buffer_descs.end() ? nullptr : &found->second;
}

void Graph::reset_history() {
    state_->committed.clear();
    state_->pool.forget_history();
    state_->restored.reset();
}

const FrameReport& Graph::last_report() const {
    return state_->report;
}

WorkKey work_of(const Method& method, const Settings& settings, const FrameInputs& inputs,
                const FrameOptions& options) {
    return {method.description.id, settings,           inputs.world_fingerprint,
            inputs.view.width,     inputs.view.height, options.memory_budget};
}

std::vector<std::string> wanted_of(const Method& method, const Settings& settings,
                                   const FrameOptions& options) {
    auto wanted = options.wanted;
    if (const auto* output = main_output(method.description, settings)) wanted.push_back(output->key);
    wanted.push_back("valid");
    return wanted;
}

void Graph::State::begin_frame(const Method& m, const Settings& s, const FrameInputs& i,
                               const FrameOptions& o) {
    method = &m;
    settings = &s;
    inputs = &i;
    options = &o;
    report = {};
    report.backend = device.backend();
    report.device = device.device();
    report.frame = i.frame;
    growths = 0;
    figures.clear();
    warnings.clear();
    auto key = work_of(m, s, i, o);
    if (work_key != key) {
        batches = 1;
        items_per_ms.clear();
    }
    work_key = std::move(key);
    committed.clear();
    pool.begin_frame();
}

bool Graph::State::divide_further() {
    if (batches >= builder->batch_limit()) return false;
    batches = std::min(2 * batches, builder->batch_limit());
    // Capacities learned for fewer batches would keep the frame too large.
    grown.clear();
    estimates.clear();
    return true;
}

void Graph::State::run_passes(Graph& graph) {
    images.clear();
    buffers.clear();
    ran.clear();
    allocate();
    put_restored();
    prepare_counters();
    prepare_parameters();
    find_cached_passes();
    report.passes.clear();
    views_ms.assign(builder->passes().size(), 0);
    for (std::size_t i = 0; i < builder->passes().size(); ++i) {
        const auto& pass = builder->passes()[i];
        PassReport row;
        row.name = pass.name;
        row.queue = pass.queue == Queue::gl ? "gl" : "cpu";
        row.slices = 0;
        row.culled = !plan.pass_live[i];
        report.passes.push_back(plan.pass_live[i] && !cached[i] ? run_pass(graph, pass, i) : row);
    }
    resolve_times();
}

void Graph::State::resolve_times() {
    for (std::size_t i = 0; i < report.passes.size(); ++i) {
        auto& ms = report.passes[i].gpu_ms;
        if (ms < 0) ms = device.pass_ms(static_cast<int>(-1 - ms));
        ms = std::max(0.0, ms - views_ms[i]);
    }
}

void Graph::State::run_attempts(Graph& graph, const std::vector<std::string>& wanted) {
    for (int attempt = 0;;) {
        GraphBuilder declared(*inputs, batches, device.max_buffer_bytes());
        builder = &declared;
        method->setup(declared, *settings);
        plan = make_plan(declared, wanted);
        if (!accept_restored()) continue;
        const auto memory = plan_memory();
        if (!fits(memory)) {
            if (!divide_further()) refuse(memory);
            continue;
        }
        try {
            run_passes(graph);
        } catch (...) {
            drop_unsure_fingerprints();
            throw;
        }
        const auto counts = read_counters();
        report.complete = !grow(counts);
        if (!report.complete) drop_unsure_fingerprints();
        fill_report(counts);
        if (report.complete) remember_committed(wanted);
        if (report.complete || options->growth == Growth::next_frame) return;
        if (++attempt > max_growths_per_frame)
            throw Error("method '" + method->description.id + "': buffers still overflow after " +
                        std::to_string(max_growths_per_frame) + " growths; please report this");
    }
}

void Graph::State::end_frame() {
    builder = nullptr;
    method = nullptr;
    settings = nullptr;
    inputs = nullptr;
    options = nullptr;
}

FrameReport Graph::run(const Method& method, const Settings& settings, const FrameInputs& inputs,
                       const FrameOptions& options) {
    auto& s = *state_;
    const auto complete = completed(method.description.parameters, settings);
    const auto start = Clock::now();
    const auto wanted = wanted_of(method, settings, options);
    s.begin_frame(method, complete, inputs, options);
    try {
        s.run_attempts(*this, wanted);
    } catch (...) {
        s.pool.abandon();
        s.end_frame();
        throw;
    }
    if (s.report.complete) s.pool.commit();
    s.report.wall_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    s.end_frame();
    return s.report;
}

}  // namespace ir::graph
