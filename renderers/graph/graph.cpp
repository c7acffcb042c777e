#include "renderers/graph/graph.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "renderers/core/error.h"
#include "renderers/graph/pass_context.h"
#include "renderers/graph/state.h"

namespace ir::graph {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::string megabytes(std::uint64_t bytes) {
    return std::to_string((bytes + 999'999) / 1'000'000) + " MB";
}

/// Work between two looks at cancellation and at views that wait.
constexpr double slice_ms = 30;
constexpr int max_growths_per_frame = 16;

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

void Graph::State::delete_framebuffers() {
    if (!context || framebuffers.empty()) return;
    context->api().BindFramebuffer(GL_FRAMEBUFFER, 0);
    context->api().DeleteFramebuffers(static_cast<GLsizei>(framebuffers.size()), framebuffers.data());
    framebuffers.clear();
}

std::uint64_t Graph::State::capacity_of(const BufferDesc& desc) const {
    if (!desc.growable) return desc.elements;
    const auto& key = desc.text.key;
    const auto estimate = estimates.find(key);
    if (estimate != estimates.end() && estimate->second == desc.elements) return grown.at(key);
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(desc.elements * options->initial_capacity));
}

std::uint64_t Graph::State::planned_bytes(std::string* largest, std::string* lower) const {
    std::uint64_t sum = 0, most = 0;
    for (std::size_t i = 0; i < builder->images().size(); ++i)
        if (plan.image_live[i])
            sum += resolve(builder->images()[i], inputs->view).bytes() * (plan.image_history[i] ? 2 : 1);
    for (std::size_t i = 0; i < builder->buffers().size(); ++i) {
        if (!plan.buffer_live[i]) continue;
        const auto& desc = builder->buffers()[i];
        const auto bytes = capacity_of(desc) * stride(desc) * (plan.buffer_history[i] ? 2 : 1);
        sum += bytes;
        if (bytes > most || (largest->empty() && !desc.lower.empty())) {
            most = bytes;
            *largest = desc.text.key + " (" + megabytes(bytes) + ")";
            if (!desc.lower.empty()) *lower = desc.lower;
        }
        if (bytes > device.max_buffer_bytes()) sum += device.max_buffer_bytes() * 1024;  // never fits
    }
    return sum;
}

void Graph::State::allocate() {
    std::vector<std::string> live;
    for (std::size_t i = 0; i < builder->images().size(); ++i)
        if (plan.image_live[i]) live.push_back(builder->images()[i].text.key);
    for (std::size_t i = 0; i < builder->buffers().size(); ++i)
        if (plan.buffer_live[i]) live.push_back(builder->buffers()[i].text.key);
    pool.free_except(live);
    pool.begin_attempt();
    buffer_descs.clear();
    for (const auto& desc : builder->buffers()) buffer_descs[desc.text.key] = desc;
    images.assign(builder->images().size(), nullptr);
    buffers.assign(builder->buffers().size(), nullptr);
    for (std::size_t i = 0; i < images.size(); ++i) {
        const auto& desc = builder->images()[i];
        if (plan.image_live[i])
            images[i] = &pool.image(desc.text.key, desc.text.label, resolve(desc, inputs->view),
                                    plan.image_history[i]);
    }
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const auto& desc = builder->buffers()[i];
        if (plan.buffer_live[i])
            buffers[i] = &pool.buffer(desc.text.key, desc.text.label, stride(desc), capacity_of(desc),
                                      desc.elements, plan.buffer_history[i]);
    }
}

void Graph::State::prepare_counters() {
    const auto count = std::max<std::size_t>(1, builder->counters().size());
    const auto bytes = count * counter_stride;
    if (bytes > counter_capacity) {
        if (counter_buffer) device.destroy_buffer(counter_buffer);
        counter_buffer = device.create_buffer(bytes, "counters");
        counter_capacity = bytes;
    }
    device.clear_buffer(counter_buffer, 0, counter_capacity);
    host_counters = std::make_unique<std::atomic<std::uint32_t>[]>(count);
    for (std::size_t i = 0; i < count; ++i) host_counters[i] = 0;
}

void Graph::State::prepare_parameters() {
    auto block = gl::parameter_block(method->description.parameters, *settings);
    if (block.empty()) block.push_back(0);
    const auto bytes = std::max<std::uint64_t>(16, block.size() * 4);
    if (bytes > parameter_bytes) {
        if (parameter_buffer) device.destroy_buffer(parameter_buffer);
        parameter_buffer = device.create_buffer(bytes, "parameters");
        parameter_bytes = bytes;
    }
    device.write_buffer(parameter_buffer, 0, std::as_bytes(std::span(block)));
}

void Graph::State::reset_gl_state() const {
    if (!context) return;
    const auto& gl = context->api();
    for (const GLenum capability :
         {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_RASTERIZER_DISCARD,
          GL_POLYGON_OFFSET_FILL, GL_MULTISAMPLE, GL_DEPTH_CLAMP})
        gl.Disable(capability);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.DepthFunc(GL_LESS);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

bool Graph::State::is_cached(const Pass& pass) const {
    using Kind = Pass::Access::Kind;
    bool writes = false;
    for (const auto& access : pass.accesses) {
        if (!access.write) continue;
        writes = true;
        if (access.kind == Kind::image) {
            const auto& wanted = builder->images()[access.index].fingerprint;
            if (!images[access.index]) continue;
            if (wanted.empty() || images[access.index]->fingerprint != wanted) return false;
        } else if (access.kind == Kind::buffer) {
            const auto& wanted = builder->buffers()[access.index].fingerprint;
            if (!buffers[access.index]) continue;
            if (wanted.empty() || buffers[access.index]->fingerprint != wanted) return false;
        } else {
            const auto& desc = builder->objects()[access.index];
            const auto found = objects.find(desc.text.key);
            if (desc.fingerprint.empty() || found == objects.end() ||
                found->second.fingerprint != desc.fingerprint)
                return false;
        }
    }
    return writes;
}

bool Graph::State::has_later_writer(std::size_t pass_index, Pass::Access::Kind kind, int index) const {
    for (std::size_t i = pass_index + 1; i < builder->passes().size(); ++i)
        for (const auto& access : builder->passes()[i].accesses)
            if (access.write && access.kind == kind && access.index == index) return true;
    return false;
}

PassReport Graph::State::run_pass(Graph& graph, const Pass& pass, std::size_t index) {
    using Kind = Pass::Access::Kind;
    const bool on_gl = pass.queue == Queue::gl;
    // Contents go to where the pass works.
    for (const auto& access : pass.accesses) {
        if (access.kind == Kind::object) continue;
        auto* physical = access.kind == Kind::image ? images[access.index] : buffers[access.index];
        if (!physical) continue;
        auto& copy = access.previous ? physical->before() : physical->now();
        if (on_gl)
            pool.on_device(*physical, copy);
        else if (!access.write || physical->produced)
            pool.on_host(*physical, copy);
        else
            copy.host.assign(physical->host_bytes(), std::byte{0});
        if (access.previous && !copy.committed) {  // no history: zeros
            if (!on_gl)
                std::fill(copy.host.begin(), copy.host.end(), std::byte{0});
            else if (physical->is_image)
                device.clear_image(copy.name, physical->shape);
            else
                device.clear_buffer(copy.name, 0, physical->copy_bytes());
            copy.on_device = on_gl;
            copy.on_host = !on_gl;
        }
        if (access.kind == Kind::buffer && access.write && !physical->produced &&
            builder->buffers()[access.index].cleared) {
            if (on_gl) device.clear_buffer(copy.name, 0, physical->copy_bytes());
        }
        if (access.write) {
            physical->fingerprint.clear();
            if (on_gl) {
                copy.on_host = false;
                copy.on_device = true;
                copy.host = {};
            } else {
                copy.on_host = true;
                copy.on_device = false;
            }
            physical->produced = true;
        }
    }
    PassReport result;
    result.name = pass.name;
    result.queue = on_gl ? "gl" : "cpu";
    result.slices = 0;
    PassContext context(graph, pass);
    auto* const context_of_pass = this->context;
    if (on_gl) {
        reset_gl_state();
        device.begin_pass(pass.name);
    }
    const auto start = Clock::now();
    std::int64_t begin = 0;
    const auto known_rate = items_per_ms.find(pass.name);
    double rate = known_rate == items_per_ms.end() ? 0 : known_rate->second;
    while (begin < pass.items || (pass.items == 0 && result.slices == 0)) {
        cancel().check();
        std::int64_t size = pass.items;
        if (pass.first_slice > 0)
            size = rate > 0 ? std::max<std::int64_t>(1, static_cast<std::int64_t>(rate * slice_ms))
                            : pass.first_slice;
        const auto end = std::min(pass.items, begin + size);
        const auto slice_start = Clock::now();
        pass.execute(context, {begin, end, begin == 0, end == pass.items});
        ++result.slices;
        if (pass.first_slice > 0) {
            if (on_gl) device.finish();
            const double ms = std::max(ms_since(slice_start), 1e-3);
            if (end > begin) rate = (end - begin) / ms;
        }
        begin = end;
        if (options->progress) {
            const double within = pass.items > 0 ? static_cast<double>(begin) / pass.items : 1;
            options->progress(pass.name, (index + within) / builder->passes().size());
        }
        if (pass.items == 0) break;
        if (begin < pass.items && options->between_slices) {
            options->between_slices();
            if (context_of_pass && !context_of_pass->is_current()) context_of_pass->make_current();
        }
    }
    if (pass.first_slice > 0 && rate > 0) items_per_ms[pass.name] = rate;
    result.cpu_ms = ms_since(start);
    if (on_gl) {
        device.barrier();
        const int ticket = device.end_pass();
        result.gpu_ms = device.software() ? device.pass_ms(ticket) : -1 - ticket;  // resolved after the frame
        if (device.software()) result.cpu_ms = ms_since(start);
        delete_framebuffers();
    }
    for (const auto& access : pass.accesses) {  // contents that outlive the frame
        if (!access.write || has_later_writer(index, access.kind, access.index)) continue;
        if (access.kind == Kind::image && images[access.index])
            images[access.index]->fingerprint = builder->images()[access.index].fingerprint;
        if (access.kind == Kind::buffer && buffers[access.index])
            buffers[access.index]->fingerprint = builder->buffers()[access.index].fingerprint;
        if (access.kind == Kind::object) {
            const auto& desc = builder->objects()[access.index];
            objects[desc.text.key].fingerprint = desc.fingerprint;
        }
    }
    return result;
}

std::vector<std::uint64_t> Graph::State::read_counters() {
    const auto count = builder->counters().size();
    std::vector<std::uint64_t> counts(count);
    if (count == 0) return counts;
    std::vector<std::uint32_t> raw(count * counter_stride / 4);
    device.read_buffer(counter_buffer, 0, std::as_writable_bytes(std::span(raw)));
    for (std::size_t i = 0; i < count; ++i)
        counts[i] = static_cast<std::uint64_t>(raw[i * counter_stride / 4]) + host_counters[i];
    return counts;
}

bool Graph::State::grow(const std::vector<std::uint64_t>& counts) {
    bool overflow = false;
    for (std::size_t i = 0; i < builder->buffers().size(); ++i) {
        const auto& desc = builder->buffers()[i];
        if (!desc.growable || !plan.buffer_live[i]) continue;
        std::uint64_t need = 0;
        for (std::size_t c = 0; c < counts.size(); ++c)
            if (builder->counters()[c].growth_of.index == static_cast<int>(i))
                need = std::max(need, counts[c]);
        const auto capacity = capacity_of(desc);
        if (need <= capacity) continue;
        grown[desc.text.key] = static_cast<std::uint64_t>(std::ceil(1.25 * static_cast<double>(need)));
        estimates[desc.text.key] = desc.elements;
        ++growths;
        overflow = true;
        report.messages.push_back({Severity::note, "graph",
                                   "buffer '" + desc.text.key + "' held " + std::to_string(capacity) +
                                       " of " + std::to_string(need) + " elements and grows to " +
                                       std::to_string(grown[desc.text.key])});
    }
    return overflow;
}

Graph::Graph(gl::Device& device, gl::Context* context, gl::ProgramLibrary* programs)
    : state_(std::make_unique<State>(device, context, programs)) {}

Graph::~Graph() = default;

const BufferDesc* Graph::buffer_desc(const std::string& key) const {
    const auto found = state_->buffer_descs.find(key);
    return found == state_->buffer_descs.end() ? nullptr : &found->second;
}

void Graph::reset_history() {
    state_->pool.forget_history();
}

const FrameReport& Graph::last_report() const {
    return state_->report;
}

FrameReport Graph::run(const Method& method, const Settings& settings, const FrameInputs& inputs,
                       const FrameOptions& options) {
    auto& s = *state_;
    const auto complete = completed(method.description.parameters, settings);
    const auto start = Clock::now();
    s.method = &method;
    s.settings = &complete;
    s.inputs = &inputs;
    s.options = &options;
    s.report = {};
    s.report.backend = s.device.backend();
    s.report.device = s.device.device();
    s.report.frame = inputs.frame;
    s.growths = 0;
    if (s.settings_of_batches != complete) s.batches = 1;
    s.settings_of_batches = complete;
    auto wanted = options.wanted;
    if (!method.description.outputs.empty()) wanted.push_back(method.description.outputs.front().key);
    wanted.push_back("valid");
    s.pool.begin_frame();

    std::vector<std::uint64_t> counts;
    for (int attempt = 0;; ++attempt) {
        GraphBuilder builder(inputs, s.batches, s.device.max_buffer_bytes());
        s.builder = &builder;
        method.setup(builder, complete);
        s.plan = make_plan(builder, wanted);
        std::string largest, lower;
        const auto planned = s.planned_bytes(&largest, &lower);
        const auto limit = options.memory_budget ? options.memory_budget : ~std::uint64_t{0} >> 1;
        const bool too_large = planned > std::min<std::uint64_t>(limit, s.device.max_buffer_bytes() * 1024);
        if (too_large) {
            if (s.batches < builder.batch_limit()) {
                s.batches = std::min(2 * s.batches, builder.batch_limit());
                // Capacities learned for fewer batches would keep the frame too large.
                s.grown.clear();
                s.estimates.clear();
                --attempt;
                continue;
            }
            throw BudgetError("method '" + method.description.id + "' needs more than the memory budget of " +
                              megabytes(limit) + "; its largest buffer is " + largest + "; lower " +
                              (lower.empty() ? "the image size" : lower) + " or raise --memory");
        }
        s.allocate();
        s.prepare_counters();
        s.prepare_parameters();
        s.report.passes.clear();
        for (std::size_t i = 0; i < builder.passes().size(); ++i) {
            const auto& pass = builder.passes()[i];
            PassReport pass_report;
            pass_report.name = pass.name;
            pass_report.queue = pass.queue == Queue::gl ? "gl" : "cpu";
            if (!s.plan.pass_live[i]) {
                pass_report.culled = true;
                pass_report.slices = 0;
            } else if (!options.rebuild && s.is_cached(pass)) {
                pass_report.slices = 0;
            } else {
                try {
                    pass_report = s.run_pass(*this, pass, i);
                } catch (...) {
                    s.delete_framebuffers();
                    s.builder = nullptr;
                    throw;
                }
            }
            s.report.passes.push_back(std::move(pass_report));
        }
        for (auto& pass : s.report.passes)
            if (pass.gpu_ms < 0) pass.gpu_ms = s.device.pass_ms(static_cast<int>(-1 - pass.gpu_ms));
        counts = s.read_counters();
        const bool overflow = s.grow(counts);
        s.report.complete = !overflow;
        s.fill_report(counts);
        if (!overflow || options.growth == Growth::next_frame) break;
        if (attempt >= max_growths_per_frame)
            throw Error("method '" + method.description.id + "': buffers still overflow after " +
                        std::to_string(attempt) + " growths; please report this");
    }
    if (s.report.complete) s.pool.commit();
    s.report.wall_ms = ms_since(start);
    s.builder = nullptr;
    s.inputs = nullptr;
    return s.report;
}

}  // namespace ir::graph
