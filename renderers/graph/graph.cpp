#include "renderers/graph/graph.h"

#include <algorithm>
#include <chrono>

#include "renderers/core/error.h"
#include "renderers/graph/frame.h"
#include "renderers/graph/shared_contents.h"

namespace ir::graph {
namespace {

using Clock = std::chrono::steady_clock;

bool makes_object(const Pass& pass) {
    return std::any_of(pass.accesses.begin(), pass.accesses.end(), [](const Pass::Access& access) {
        return access.write && access.kind == Pass::Access::Kind::object;
    });
}

}  // namespace

GraphCache::~GraphCache() {
    drop_versions([](const auto&) { return true; });
    if (counter_buffer) device.destroy_buffer(counter_buffer);
    if (parameter_buffer) device.destroy_buffer(parameter_buffer);
    if (!context) return;
    const auto& api = context->api();
    for (const auto& [sampler, name] : samplers) api.DeleteSamplers(1, &name);
    if (empty_vertex_array) api.DeleteVertexArrays(1, &empty_vertex_array);
    delete_framebuffers();
}

Graph::Graph(gl::Device& device, gl::Context* context, gl::ProgramLibrary* programs,
             std::shared_ptr<SharedContents> shared)
    : cache_(std::make_unique<GraphCache>(device, context, programs)) {
    cache_->shared = std::move(shared);
}

Graph::~Graph() = default;

const BufferDesc* Graph::buffer_desc(const std::string& key) const {
    const auto found = cache_->buffer_descs.find(key);
    return found == cache_->buffer_descs.end() ? nullptr : &found->second;
}

void Graph::reset_history() {
    cache_->committed.clear();
    cache_->pool.forget_history();
    cache_->restored.reset();
}

const FrameReport& Graph::last_report() const {
    return cache_->report;
}

bool Graph::is_running() const {
    return cache_->is_running;
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

void Frame::begin() {
    cache.report = {};
    cache.report.backend = cache.device.backend();
    cache.report.device = cache.device.device();
    cache.report.processor = to_string(inputs->processor);
    cache.report.frame = inputs->frame;
    cache.growths = 0;
    cache.figures.clear();
    cache.warnings.clear();
    auto key = work_of(*method, *settings, *inputs, *options);
    if (cache.work_key != key) {
        cache.batches = 1;
        cache.items_per_ms.clear();
    }
    if (cache.work_key.budget != key.budget)  // they may become larger
        std::erase_if(cache.objects, [](const auto& entry) { return entry.second.is_spare; });
    cache.work_key = std::move(key);
    cache.committed.clear();
    cache.pool.begin_frame();
}

bool Frame::divide_further() {
    if (cache.batches >= builder->batch_limit()) return false;
    cache.batches = std::min(2 * cache.batches, builder->batch_limit());
    // Capacities learned for fewer batches would keep the frame too large.
    cache.grown.clear();
    cache.estimates.clear();
    return true;
}

bool Frame::has_overflowed(std::size_t index) const {
    const auto& passes = builder->passes();
    if (passes[index].queue == Queue::gl || options->growth == Growth::next_frame) return false;
    const auto counts_later = [&](CounterRef counter) {
        for (auto i = index + 1; i < passes.size(); ++i)
            for (const auto other : passes[i].counters)
                if (other.index == counter.index && plan.pass_live[i] && !cached[i]) return true;
        return false;
    };
    return std::ranges::any_of(passes[index].counters, [&](CounterRef counter) {
        const int grown = builder->counters()[counter.index].growth_of.index;
        return grown >= 0 && buffers[grown] && host_counters[counter.index] > buffers[grown]->capacity &&
               !counts_later(counter);
    });
}

bool Frame::run_passes() {
    is_cut_short = false;
    images.clear();
    buffers.clear();
    ran.clear();
    FrameMemory memory(*this);
    memory.allocate();
    cache.debug.begin(inputs->picked_pixel(), {inputs->view.width, inputs->view.height});
    put_restored(*this);
    adopt_shared(*this);
    if (!memory.fits(memory.plan())) return false;
    memory.prepare_counters();
    memory.prepare_parameters();
    find_cached_passes();
    cache.report.passes.clear();
    cache.report.pixel_changes.clear();
    cache.drop_versions([](const auto&) { return true; });
    views_ms.assign(builder->passes().size(), 0);
    for (std::size_t i = 0; i < builder->passes().size(); ++i) {
        const auto& pass = builder->passes()[i];
        PassReport row;
        row.name = pass.name;
        row.queue = pass.queue == Queue::gl ? "gl" : "cpu";
        row.slices = 0;
        row.culled = !plan.pass_live[i];
        row.has_two_bodies = pass.has_two_bodies;
        cache.report.passes.push_back(plan.pass_live[i] && !cached[i] ? run_pass(pass, i) : row);
        cache.report.passes.back().is_kept = is_kept(pass);
        if (ran[i] && !options->versions.empty()) FrameSteps(*this).keep_versions(pass, i);
        if (plan.pass_live[i] && options->traced) FrameSteps(*this).trace_pixel(pass, i);
        if (ran[i] && makes_object(pass) && !memory.fits(memory.plan())) return false;
        is_cut_short = ran[i] && has_overflowed(i);
        if (is_cut_short) break;
    }
    resolve_times();
    return true;
}

bool Frame::run_fitting() {
    FrameMemory memory(*this);
    memory.free_objects();
    if (!memory.fits(memory.plan())) return false;
    bool is_done = false;
    try {
        is_done = run_passes();
    } catch (...) {
        drop_unsure_fingerprints();
        throw;
    }
    if (!is_done) drop_unsure_fingerprints();
    return is_done;
}

void Frame::resolve_times() {
    for (std::size_t i = 0; i < cache.report.passes.size(); ++i) {
        const auto& pass = builder->passes()[i];
        auto& ms = cache.report.passes[i].gpu_ms;
        const bool is_by_card = ms < 0;
        if (is_by_card) ms = cache.device.pass_ms(static_cast<int>(-1 - ms));
        ms = std::max(0.0, ms - views_ms[i]);
        if (is_by_card && pass.first_slice > 0 && pass.items > 0)
            cache.items_per_ms[pass.name] = static_cast<double>(pass.items) / std::max(ms, 1e-3);
    }
}

bool declare(Frame& frame, GraphBuilder& declared) {
    frame.builder = &declared;
    frame.method->setup(declared, *frame.settings);
    if (frame.inputs->picked_pixel().x < 0 || !frame.cache.debug.can_say()) return false;
    declare_debug(declared, frame.cache);
    return true;
}

void Frame::run_attempts(const std::vector<std::string>& requested) {
    for (int attempt = 0;;) {
        GraphBuilder declared(method->description, *inputs, cache.batches, cache.device.max_buffer_bytes());
        const bool says = declare(*this, declared);
        auto wanted = requested;
        if (says) wanted.push_back(debug_pattern);
        plan = make_plan(declared, wanted);
        if (!accept_restored(*this)) continue;
        learn_shared_capacities(*this);
        FrameMemory memory(*this);
        if (!run_fitting()) {
            if (!divide_further()) refuse(*this, memory.plan());
            continue;
        }
        const auto counts = read_counters();
        cache.report.complete = !memory.grow(counts);
        if (!cache.report.complete) drop_unsure_fingerprints();
        // A program that says something was met for the first time. What need not run again keeps its counts.
        if (!says && cache.debug.is_asked() && cache.debug.can_say()) continue;
        if (cache.report.complete && options->rebuild) cache.debug.forget_others();
        if (!is_cut_short) fill_report(*this, counts);
        if (cache.report.complete) {
            remember_committed(wanted);
            share_contents(*this);
        }
        if (cache.report.complete || options->growth == Growth::next_frame) return;
        if (++attempt > max_growths_per_frame)
            throw Error("method '" + method->description.id + "': buffers still overflow after " +
                        std::to_string(max_growths_per_frame) + " growths; please report this");
    }
}

FrameReport Graph::run(const Method& method, const Settings& settings, const FrameInputs& inputs,
                       const FrameOptions& options) {
    const auto complete = completed(method.description.parameters, settings);
    const auto start = Clock::now();
    Frame frame(*cache_, method, complete, inputs, options);
    frame.begin();
    try {
        frame.run_attempts(wanted_of(method, settings, options));
    } catch (...) {
        cache_->pool.abandon();
        throw;
    }
    auto& report = cache_->report;
    if (report.complete) cache_->pool.commit();
    report.wall_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return report;
}

}  // namespace ir::graph
