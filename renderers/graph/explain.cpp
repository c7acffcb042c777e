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

}  // namespace

/// Whether the resource is in the pool as the committed frame left it.
bool Frame::is_held(const Pass::Access& access, const Plan& before) const {
    if (access.kind == Kind::object)
        return cache.objects.count(builder->objects()[access.index].text.key) > 0;
    if (access.kind == Kind::image) {
        const auto& desc = builder->images()[access.index];
        const auto* physical = cache.pool.find(desc.text.key);
        return physical && physical->is_image && physical->shape == resolve(desc, inputs->view) &&
               physical->history == before.image_history[access.index] && physical->has_contents();
    }
    const auto& desc = builder->buffers()[access.index];
    const auto* physical = cache.pool.find(desc.text.key);
    return physical && !physical->is_image &&
           physical->element_bytes == static_cast<std::uint64_t>(stride(desc)) &&
           physical->capacity == capacity_of(desc) &&
           physical->history == before.buffer_history[access.index] && physical->has_contents();
}

bool Frame::may_run_again(const Pass& pass, std::size_t index, const Again& again) const {
    const auto& before = again.before;
    for (const auto& access : pass.accesses) {
        if (access.write) {
            // Running again must neither change what the frame computed nor what the next one builds on.
            if (is_live(before, access) || has_history(plan, access)) return false;
            continue;
        }
        if (!is_live(before, access)) continue;  // made by a pass that runs again, too
        if (!is_held(access, before)) return false;
        if (access.previous) {
            if (!has_history(before, access)) return false;
            continue;
        }
        for (std::size_t later = index + 1; later < builder->passes().size(); ++later)
            if (before.pass_live[later])
                for (const auto& other : builder->passes()[later].accesses)
                    if (other.write && other.kind == access.kind && other.index == access.index) return false;
    }
    return true;
}

bool Frame::has_known_counts(const Again& again) const {
    std::vector<bool> known(builder->counters().size());
    for (std::size_t i = 0; i < builder->passes().size(); ++i) {
        const auto& pass = builder->passes()[i];
        if (!again.before.pass_live[i] || pass.counters.empty()) continue;
        const auto counted = cache.counts_of_passes.find(pass.name);
        if (counted == cache.counts_of_passes.end() || counted->second.size() != pass.counters.size())
            return false;
        for (const auto counter : pass.counters) known[counter.index] = true;
    }
    // A counter starts at zero: what adds to one of the frame's own would count wrongly.
    for (std::size_t i = 0; i < builder->passes().size(); ++i)
        for (const auto counter : builder->passes()[i].counters)
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

std::optional<Frame::Again> Frame::plan_again(const std::vector<std::string>& wanted) {
    const auto explains = explanations(method->description);
    Again again;
    again.before = make_plan(*builder, cache.committed, explains);
    const auto all = joined(cache.committed, wanted);
    // Explanations that nobody asks for any more are left alone.
    std::vector<std::string> unwanted;
    for (const auto& key : explains)
        if (std::none_of(wanted.begin(), wanted.end(),
                         [&](const auto& pattern) { return matches(pattern, key); }))
            unwanted.push_back(key);
    plan = make_plan(*builder, all, unwanted);
    const auto& passes = builder->passes();
    for (std::size_t i = 0; i < passes.size(); ++i)
        again.passes.push_back(plan.pass_live[i] && !again.before.pass_live[i]);
    for (std::size_t i = 0; i < passes.size(); ++i)
        if (again.passes[i] && !may_run_again(passes[i], i, again)) return {};
    // What a pass of the frame itself writes cannot be had anew.
    const auto asked_of_frame = [&](const auto& descs, const std::vector<bool>& live) {
        for (std::size_t i = 0; i < descs.size(); ++i)
            if (live[i] && contains(explains, descs[i].text.key) && !contains(unwanted, descs[i].text.key))
                return true;
        return false;
    };
    if (asked_of_frame(builder->images(), again.before.image_live) ||
        asked_of_frame(builder->buffers(), again.before.buffer_live) || !has_known_counts(again) ||
        !fits(plan_memory()))
        return {};
    return again;
}

void Frame::allocate_again(const Again& again) {
    cache.pool.begin_attempt();
    cache.buffer_descs.clear();
    for (const auto& desc : builder->buffers()) cache.buffer_descs[desc.text.key] = desc;
    images.assign(builder->images().size(), nullptr);
    buffers.assign(builder->buffers().size(), nullptr);
    for (std::size_t i = 0; i < images.size(); ++i) {
        const auto& desc = builder->images()[i];
        if (again.before.image_live[i])
            images[i] = cache.pool.find(desc.text.key);
        else if (plan.image_live[i])
            images[i] = &cache.pool.image(desc.text.key, desc.text.label, resolve(desc, inputs->view), false);
    }
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const auto& desc = builder->buffers()[i];
        if (again.before.buffer_live[i])
            buffers[i] = cache.pool.find(desc.text.key);
        else if (plan.buffer_live[i])
            buffers[i] = &cache.pool.buffer(desc.text.key, desc.text.label, stride(desc), capacity_of(desc),
                                            desc.elements, false);
    }
}

void Frame::run_passes_again(const Again& again) {
    const auto& passes = builder->passes();
    allocate_again(again);
    prepare_counters();
    prepare_parameters();
    find_cached_passes();
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (again.before.pass_live[i]) cached[i] = true;  // for its counters
        if (again.passes[i] && !cached[i]) drop_contents(passes[i]);
    }
    const auto rows_before = std::move(cache.report.passes);
    cache.report.passes.clear();
    views_ms.assign(passes.size(), 0);
    for (std::size_t i = 0; i < passes.size(); ++i) {
        PassReport row;
        const auto old = std::find_if(rows_before.begin(), rows_before.end(),
                                      [&](const auto& known) { return known.name == passes[i].name; });
        if (old != rows_before.end()) row = *old;
        row.name = passes[i].name;
        row.queue = passes[i].queue == Queue::gl ? "gl" : "cpu";
        row.culled = !plan.pass_live[i];
        row.reads.clear();
        row.writes.clear();
        cache.report.passes.push_back(std::move(row));
    }
    for (std::size_t i = 0; i < passes.size(); ++i)
        if (again.passes[i] && !cached[i]) cache.report.passes[i] = run_pass(passes[i], i);
    resolve_times();
}

bool Frame::run_again(const std::vector<std::string>& wanted) {
    for (int attempt = 0; attempt <= max_growths_per_frame; ++attempt) {
        GraphBuilder declared(method->description, *inputs, cache.batches, cache.device.max_buffer_bytes());
        builder = &declared;
        method->setup(declared, *settings);
        const auto again = plan_again(wanted);
        if (!again) return false;
        const auto rows_before = cache.report.passes;
        try {
            run_passes_again(*again);
        } catch (...) {
            drop_unsure_fingerprints();
            cache.report.passes = rows_before;
            report_what_is_left();
            throw;
        }
        const auto counts = read_counters();
        const bool overflow = grow(counts);
        if (overflow) drop_unsure_fingerprints();
        fill_report(counts);
        if (!overflow) return remember_committed(joined(cache.committed, wanted)), true;
    }
    throw Error("method '" + method->description.id + "': buffers still overflow after " +
                std::to_string(max_growths_per_frame) + " growths; please report this");
}

void Frame::report_what_is_left() {
    for (auto& resource : cache.report.resources) {
        if (resource.format == "object") continue;
        const auto* physical = cache.pool.find(resource.key);
        resource.available = resource.available && physical && physical->has_contents();
    }
}

bool Graph::explain(const Method& method, const Settings& settings, const FrameInputs& inputs,
                    const FrameOptions& options) {
    const auto complete = completed(method.description.parameters, settings);
    if (cache_->committed.empty() || cache_->work_key != work_of(method, complete, inputs, options))
        return false;
    Frame frame(*cache_, method, complete, inputs, options);
    struct Previous {
        Pool& pool;
        explicit Previous(Pool& p) : pool(p) { pool.show_previous(); }
        ~Previous() { pool.hide_previous(); }
    } previous(cache_->pool);
    return frame.run_again(wanted_of(method, settings, options));
}

}  // namespace ir::graph
