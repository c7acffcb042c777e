#include "renderers/graph/plan.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "renderers/graph/graph.h"

namespace ir::graph {
namespace {

using Kind = Pass::Access::Kind;

const std::string& key_of(const GraphBuilder& builder, const Pass::Access& access) {
    switch (access.kind) {
        case Kind::image:
            return builder.images().at(access.index).text.key;
        case Kind::buffer:
            return builder.buffers().at(access.index).text.key;
        default:
            return builder.objects().at(access.index).text.key;
    }
}

/// A handle that was never assigned, or one of another frame.
void check_handles(const GraphBuilder& builder, const Pass& pass) {
    for (const auto& access : pass.accesses) {
        const auto count = access.kind == Kind::image    ? builder.images().size()
                           : access.kind == Kind::buffer ? builder.buffers().size()
                                                         : builder.objects().size();
        if (access.index < 0 || access.index >= static_cast<int>(count))
            throw std::logic_error("pass '" + pass.name + "' uses a resource that is not declared");
    }
    for (const auto& counter : pass.counters)
        if (counter.index < 0 || counter.index >= static_cast<int>(builder.counters().size()))
            throw std::logic_error("pass '" + pass.name + "' uses a counter that is not declared");
}

void check_order(const GraphBuilder& builder) {
    for (const auto& pass : builder.passes()) check_handles(builder, pass);
    std::vector<std::string> written, ever_written;
    for (const auto& pass : builder.passes())
        for (const auto& access : pass.accesses)
            if (access.write) ever_written.push_back(key_of(builder, access));
    const auto contains = [](const std::vector<std::string>& keys, const std::string& key) {
        return std::find(keys.begin(), keys.end(), key) != keys.end();
    };
    for (const auto& pass : builder.passes()) {
        if (!pass.execute) throw std::logic_error("pass '" + pass.name + "' has nothing to execute");
        for (const auto& access : pass.accesses) {
            const auto& key = key_of(builder, access);
            if (access.previous && !contains(ever_written, key))
                throw std::logic_error("pass '" + pass.name + "' reads the history of '" + key +
                                       "', which no pass writes");
            if (!access.write && !access.previous && !contains(written, key))
                throw std::logic_error("pass '" + pass.name + "' reads '" + key +
                                       "', which no earlier pass writes");
        }
        for (const auto& access : pass.accesses)
            if (access.write) written.push_back(key_of(builder, access));
    }
}

std::vector<bool>& live_of(Plan& plan, Kind kind) {
    return kind == Kind::image ? plan.image_live : kind == Kind::buffer ? plan.buffer_live : plan.object_live;
}

/// Marks passes backwards from what is wanted; true when anything was added.
bool mark(const GraphBuilder& builder, Plan& plan) {
    bool changed = false;
    for (std::size_t i = builder.passes().size(); i-- > 0;) {
        const auto& pass = builder.passes()[i];
        if (!plan.pass_live[i])
            for (const auto& access : pass.accesses)
                if (access.write && live_of(plan, access.kind)[access.index])
                    plan.pass_live[i] = changed = true;
        if (!plan.pass_live[i]) continue;
        for (const auto& access : pass.accesses) {
            auto&& live = live_of(plan, access.kind)[access.index];
            if (!live) live = changed = true;
            if (access.previous && access.kind == Kind::image) plan.image_history[access.index] = true;
            if (access.previous && access.kind == Kind::buffer) plan.buffer_history[access.index] = true;
        }
    }
    return changed;
}

}  // namespace

Plan make_plan(const GraphBuilder& builder, const std::vector<std::string>& wanted,
               const std::vector<std::string>& unwanted) {
    check_order(builder);
    Plan plan;
    plan.pass_live.resize(builder.passes().size());
    plan.image_live.resize(builder.images().size());
    plan.buffer_live.resize(builder.buffers().size());
    plan.object_live.resize(builder.objects().size());
    plan.image_history.resize(builder.images().size());
    plan.buffer_history.resize(builder.buffers().size());
    const auto is_wanted = [&](const std::string& key) {
        if (std::find(unwanted.begin(), unwanted.end(), key) != unwanted.end()) return false;
        return std::any_of(wanted.begin(), wanted.end(),
                           [&](const auto& pattern) { return matches(pattern, key); });
    };
    for (std::size_t i = 0; i < builder.images().size(); ++i)
        plan.image_live[i] = is_wanted(builder.images()[i].text.key);
    for (std::size_t i = 0; i < builder.buffers().size(); ++i)
        plan.buffer_live[i] = is_wanted(builder.buffers()[i].text.key);
    while (mark(builder, plan)) {
    }
    return plan;
}

gl::ImageShape resolve(const ImageDesc& desc, const scene::View& view) {
    gl::ImageShape shape;
    const auto& extent = desc.extent;
    shape.width =
        extent.width > 0 ? extent.width : std::max(1, static_cast<int>(std::ceil(view.width * extent.scale)));
    shape.height = extent.height > 0 ? extent.height
                                     : std::max(1, static_cast<int>(std::ceil(view.height * extent.scale)));
    shape.levels = desc.levels;
    shape.layers = desc.layers;
    shape.format = desc.format;
    return shape;
}

bool matches(const std::string& pattern, const std::string& text) {
    std::size_t p = 0, t = 0, star = std::string::npos, resume = 0;
    while (t < text.size()) {
        if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p, ++t;
        } else if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resume = t;
        } else if (star != std::string::npos) {
            p = star + 1;
            t = ++resume;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

}  // namespace ir::graph
