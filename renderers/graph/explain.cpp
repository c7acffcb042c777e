#include <algorithm>

#include "renderers/core/error.h"
#include "renderers/graph/frame.h"

namespace ir::graph {
namespace {

using Kind = Pass::Access::Kind;

bool is_live(const Plan& plan, const Pass::Access& access) {
    return access.kind == Kind::image    ? plan.image_live[access.index]
           : access.kind == Kind::buffer ? plan.buffer_live[access.index]
                                         : plan.object_live[access.index];
}

bool has_history(const Plan& plan, const Pass::Access& access) {
    return access.kind == Kind::image    ? plan.image_history[access.index]
           : access.kind == Kind::buffer ? plan.buffer_history[access.index]
                                         : false;
}

/// Outputs that depend on what a person points at.
std::vector<std::string> explanations(const MethodDescription& method) {
    std::vector<std::string> keys;
    for (const auto& output : method.outputs)
        if (output.explains) keys.push_back(output.key);
    return keys;
}

bool contains(const std::vector<std::string>& keys, const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::vector<std::string> joined(std::vector<std::string> patterns, const std::vector<std::string>& more) {
    for (const auto& pattern : more)
        if (!contains(patterns, pattern)) patterns.push_back(pattern);
    return patterns;
}

/// Some passes of the committed frame again, on its contents.
class Explanation {
  public:
    explicit Explanation(Frame& frame) : frame_(frame) {}
    /// Graph::explain().
    bool run_again(const std::vector<std::string>& wanted);

  private:
    struct Again {
        Plan before;               ///< what the committed frame holds
        std::vector<bool> passes;  ///< that run, of the frame's plan
    };
    std::optional<Again> plan_again(const std::vector<std::string>& wanted);
    bool may_run_again(const Pass& pass, std::size_t index, const Again& again) const;
    bool is_held(const Pass::Access& access, const Plan& before) const;
    bool has_known_counts(const Again& again) const;
    void run_passes_again(const Again& again);
    bool is_written_again(const std::string& key, const Again& again) const;
    void allocate_again(const Again& again);
    void report_what_is_left();
    Frame& frame_;
};

}  // namespace

/// Whether the resource is in the pool as the committed frame left it.
bool Explanation::is_held(const Pass::Access& access, const Plan& before) const {
    if (access.kind == Kind::object)
        return frame_.cache.objects.count(frame_.builder->objects()[access.index].text.key) > 0;
    if (access.kind == Kind::image) {
        const auto& desc = frame_.builder->images()[access.index];
        const auto* physical = frame_.cache.pool.find(desc.text.key);
        return physical && physical->is_image && physical->shape == resolve(desc, frame_.inputs->view) &&
               physical->history == before.image_history[access.index] && physical->has_contents();
    }
    const auto& desc = frame_.builder->buffers()[access.index];
    const auto* physical = frame_.cache.pool.find(desc.text.key);
    return physical && !physical->is_image &&
           physical->element_bytes == static_cast<std::uint64_t>(stride(desc)) &&
           physical->capacity == FrameMemory(frame_).capacity_of(desc) &&
           physical->history == before.buffer_history[access.index] && physical->has_contents();
}

bool Explanation::may_run_again(const Pass& pass, std::size_t index, const Again& again) const {
    const auto& before = again.before;
    for (const auto& access : pass.accesses) {
        if (access.write) {
            // Running again must neither change what the frame computed nor what the next one builds on.
            if (is_live(before, access) || has_history(frame_.plan, access)) return false;
            continue;
        }
        if (!is_live(before, access)) continue;  // made by a pass that runs again, too
        if (!is_held(access, before)) return false;
        if (access.previous) {
            if (!has_history(before, access)) return false;
            continue;
        }
        for (std::size_t later = index + 1; later < frame_.builder->passes().size(); ++later)
            if (before.pass_live[later])
                for (const auto& other : frame_.builder->passes()[later].accesses)
                    if (other.write && other.kind == access.kind && other.index == access.index) return false;
    }
    return true;
}

bool Explanation::has_known_counts(const Again& again) const {
    std::vector<bool> known(frame_.builder->counters().size());
    for (std::size_t i = 0; i < frame_.builder->passes().size(); ++i) {
        const auto& pass = frame_.builder->passes()[i];
        if (!again.before.pass_live[i] || pass.counters.empty()) continue;
        const auto counted = frame_.cache.counts_of_passes.find(pass.name);
        if (counted == frame_.cache.counts_of_passes.end() || counted->second.size() != pass.counters.size())
            return false;
        for (const auto counter : pass.counters) known[counter.index] = true;
    }
    // A counter starts at zero: what adds to one of the frame's own would count wrongly.
    for (std::size_t i = 0; i < frame_.builder->passes().size(); ++i)
        for (const auto counter : frame_.builder->passes()[i].counters)
            if (again.passes[i] && known[counter.index]) return false;
    return true;
}

void Frame::remember_committed(std::vector<std::string> wanted) {
    cache.committed = std::move(wanted);
    // Outputs that do not explain are those of the frame, whatever they were computed for.
    for (const auto& output : method->description.outputs) {
        const auto is_there = [&](const auto& descs, const std::vector<bool>& live) {
            for (std::size_t i = 0; i < descs.size(); ++i)
                if (live[i] && descs[i].text.key == output.key) return true;
            return false;
        };
        const bool computed =
            is_there(builder->images(), plan.image_live) || is_there(builder->buffers(), plan.buffer_live);
        if (computed && !output.explains) cache.committed = joined(std::move(cache.committed), {output.key});
    }
}

std::optional<Explanation::Again> Explanation::plan_again(const std::vector<std::string>& wanted) {
    const auto explains = explanations(frame_.method->description);
    Again again;
    again.before = make_plan(*frame_.builder, frame_.cache.committed, explains);
    const auto all = joined(frame_.cache.committed, wanted);
    // Explanations that nobody asks for any more are left alone.
    std::vector<std::string> unwanted;
    for (const auto& key : explains)
        if (std::none_of(wanted.begin(), wanted.end(),
                         [&](const auto& pattern) { return matches(pattern, key); }))
            unwanted.push_back(key);
    frame_.plan = make_plan(*frame_.builder, all, unwanted);
    const auto& passes = frame_.builder->passes();
    for (std::size_t i = 0; i < passes.size(); ++i)
        again.passes.push_back(frame_.plan.pass_live[i] && !again.before.pass_live[i]);
    for (std::size_t i = 0; i < passes.size(); ++i)
        if (again.passes[i] && !may_run_again(passes[i], i, again)) return {};
    // What a pass of the frame itself writes cannot be had anew.
    const auto requested_of_frame = [&](const auto& descs, const std::vector<bool>& live) {
        for (std::size_t i = 0; i < descs.size(); ++i)
            if (live[i] && contains(explains, descs[i].text.key) && !contains(unwanted, descs[i].text.key))
                return true;
        return false;
    };
    if (requested_of_frame(frame_.builder->images(), again.before.image_live) ||
        requested_of_frame(frame_.builder->buffers(), again.before.buffer_live) || !has_known_counts(again) ||
        !FrameMemory(frame_).fits(FrameMemory(frame_).plan()))
        return {};
    return again;
}

void Explanation::allocate_again(const Again& again) {
    frame_.cache.pool.begin_attempt();
    frame_.cache.buffer_descs.clear();
    for (const auto& desc : frame_.builder->buffers()) frame_.cache.buffer_descs[desc.text.key] = desc;
    frame_.images.assign(frame_.builder->images().size(), nullptr);
    frame_.buffers.assign(frame_.builder->buffers().size(), nullptr);
    for (std::size_t i = 0; i < frame_.images.size(); ++i) {
        const auto& desc = frame_.builder->images()[i];
        if (again.before.image_live[i])
            frame_.images[i] = frame_.cache.pool.find(desc.text.key);
        else if (frame_.plan.image_live[i])
            frame_.images[i] = &frame_.cache.pool.image(desc.text.key, desc.text.label,
                                                        resolve(desc, frame_.inputs->view), false);
    }
    for (std::size_t i = 0; i < frame_.buffers.size(); ++i) {
        const auto& desc = frame_.builder->buffers()[i];
        if (again.before.buffer_live[i])
            frame_.buffers[i] = frame_.cache.pool.find(desc.text.key);
        else if (frame_.plan.buffer_live[i])
            frame_.buffers[i] =
                &frame_.cache.pool.buffer(desc.text.key, desc.text.label, stride(desc),
                                          FrameMemory(frame_).capacity_of(desc), desc.elements, false);
    }
}

bool Explanation::is_written_again(const std::string& key, const Again& again) const {
    const auto& passes = frame_.builder->passes();
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!again.passes[i] || frame_.cached[i]) continue;
        for (const auto& access : passes[i].accesses)
            if (access.write && frame_.key_of(access) == key) return true;
    }
    return false;
}

void Explanation::run_passes_again(const Again& again) {
    const auto& passes = frame_.builder->passes();
    allocate_again(again);
    FrameMemory(frame_).prepare_counters();
    FrameMemory(frame_).prepare_parameters();
    frame_.find_cached_passes();
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (again.before.pass_live[i]) frame_.cached[i] = true;  // for its counters
        if (again.passes[i] && !frame_.cached[i]) frame_.drop_contents(passes[i]);
    }
    const auto rows_before = std::move(frame_.cache.report.passes);
    frame_.cache.report.passes.clear();
    frame_.views_ms.assign(passes.size(), 0);
    for (std::size_t i = 0; i < passes.size(); ++i) {
        PassReport row;
        const auto old = std::find_if(rows_before.begin(), rows_before.end(),
                                      [&](const auto& known) { return known.name == passes[i].name; });
        if (old != rows_before.end()) row = *old;
        row.name = passes[i].name;
        row.queue = passes[i].queue == Queue::gl ? "gl" : "cpu";
        row.has_two_bodies = passes[i].has_two_bodies;
        row.culled = !frame_.plan.pass_live[i];
        row.reads.clear();
        row.reads_previous.clear();
        row.writes.clear();
        frame_.cache.report.passes.push_back(std::move(row));
    }
    frame_.cache.drop_versions([&](const std::string& key) { return is_written_again(key, again); });
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!again.passes[i] || frame_.cached[i]) continue;
        frame_.cache.report.passes[i] = frame_.run_pass(passes[i], i);
        FrameSteps(frame_).keep_versions(passes[i], i);
    }
    frame_.resolve_times();
}

bool Explanation::run_again(const std::vector<std::string>& wanted) {
    for (int attempt = 0; attempt <= max_growths_per_frame; ++attempt) {
        GraphBuilder declared(frame_.method->description, *frame_.inputs, frame_.cache.batches,
                              frame_.cache.device.max_buffer_bytes());
        declare(frame_, declared);
        const auto again = plan_again(wanted);
        if (!again) return false;
        const auto rows_before = frame_.cache.report.passes;
        try {
            run_passes_again(*again);
        } catch (...) {
            frame_.drop_unsure_fingerprints();
            frame_.cache.report.passes = rows_before;
            report_what_is_left();
            throw;
        }
        const auto counts = frame_.read_counters();
        const bool overflow = FrameMemory(frame_).grow(counts);
        if (overflow) frame_.drop_unsure_fingerprints();
        fill_report(frame_, counts);
        if (!overflow) return frame_.remember_committed(joined(frame_.cache.committed, wanted)), true;
    }
    throw Error("method '" + frame_.method->description.id + "': buffers still overflow after " +
                std::to_string(max_growths_per_frame) + " growths; please report this");
}

void Explanation::report_what_is_left() {
    for (auto& resource : frame_.cache.report.resources) {
        if (resource.format == "object") continue;
        const auto* physical = frame_.cache.pool.find(resource.key);
        resource.available = resource.available && physical && physical->has_contents();
    }
}

bool Graph::explain(const Method& method, const Settings& settings, const FrameInputs& inputs,
                    const FrameOptions& options) {
    const auto complete = completed(method.description.parameters, settings);
    if (cache_->committed.empty() || cache_->work_key != work_of(method, complete, inputs, options))
        return false;
    // Shaders say something in frames alone.
    if (cache_->debug.can_say() && cache_->debug.pixel() != inputs.picked_pixel()) return false;
    Frame frame(*cache_, method, complete, inputs, options);
    struct Previous {
        Pool& pool;
        explicit Previous(Pool& p) : pool(p) { pool.show_previous(); }
        ~Previous() { pool.hide_previous(); }
    } previous(cache_->pool);
    return Explanation(frame).run_again(wanted_of(method, settings, options));
}

}  // namespace ir::graph
