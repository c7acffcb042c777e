#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/graph/frame.h"

namespace ir::graph {

MemoryPlan memory_of(const GraphBuilder& builder, const Plan& plan,
                     const std::map<std::string, StoredObject>& objects,
                     const std::function<std::uint64_t(const BufferDesc&)>& elements) {
    MemoryPlan result;
    const auto add = [&](const MemoryPlan::Resource& resource) {
        result.bytes += resource.bytes;
        if (resource.bytes > result.largest.bytes) result.largest = resource;
    };
    for (std::size_t i = 0; i < builder.images().size(); ++i) {
        if (!plan.image_live[i]) continue;
        const auto& desc = builder.images()[i];
        const auto bytes = resolve(desc, builder.inputs().view).bytes();
        add({desc.text.key, {}, bytes * (plan.image_history[i] ? 2 : 1)});
    }
    for (std::size_t i = 0; i < builder.buffers().size(); ++i) {
        if (!plan.buffer_live[i]) continue;
        const auto& desc = builder.buffers()[i];
        const auto count = elements(desc);
        const MemoryPlan::Resource one{desc.text.key, count > desc.elements ? desc.lower : std::string(),
                                       count * stride(desc)};
        add({one.key, one.lower, one.bytes * (plan.buffer_history[i] ? 2 : 1)});
        if (one.bytes > result.largest_buffer.bytes) result.largest_buffer = one;
    }
    for (std::size_t i = 0; i < builder.objects().size(); ++i) {
        const auto& desc = builder.objects()[i];
        const auto found = objects.find(desc.text.key);
        if (plan.object_live[i] && !desc.is_spare && found != objects.end())
            add({desc.text.key, {}, found->second.bytes});
    }
    return result;
}

std::uint64_t FrameMemory::capacity_of(const BufferDesc& desc) const {
    if (!desc.growable) return desc.elements;
    const auto& key = desc.text.key;
    const auto estimate = frame_.cache.estimates.find(key);
    if (estimate != frame_.cache.estimates.end() && estimate->second == desc.elements)
        return frame_.cache.grown.at(key);
    return std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(desc.elements * frame_.options->initial_capacity));
}

MemoryPlan FrameMemory::plan() const {
    return memory_of(*frame_.builder, frame_.plan, frame_.cache.objects,
                     [&](const BufferDesc& desc) { return capacity_of(desc); });
}

bool FrameMemory::fits(const MemoryPlan& memory) const {
    return memory.largest_buffer.bytes <= frame_.cache.device.max_buffer_bytes() &&
           (frame_.options->memory_budget == 0 || memory.bytes <= frame_.options->memory_budget);
}

std::uint64_t FrameMemory::left_over() const {
    const auto budget = frame_.options->memory_budget;
    if (budget == 0) return std::numeric_limits<std::uint64_t>::max();
    return budget - std::min(budget, plan().bytes);
}

std::uint64_t FrameMemory::spare_bytes(const std::string& key) const {
    auto left = left_over();
    for (const auto& [other, stored] : frame_.cache.objects)
        if (stored.is_spare && other != key) left -= std::min(left, stored.bytes);
    return left;
}

void FrameMemory::free_objects() {
    auto& objects = frame_.cache.objects;
    const auto is_for_this_frame = [&](const auto& entry) {
        for (std::size_t i = 0; i < frame_.builder->objects().size(); ++i)
            if (const auto& desc = frame_.builder->objects()[i]; desc.text.key == entry.first)
                return frame_.plan.object_live[i] && !desc.fingerprint.empty() &&
                       entry.second.fingerprint == desc.fingerprint;
        return false;
    };
    std::erase_if(objects, [&](const auto& entry) { return !is_for_this_frame(entry); });
    auto left = left_over();
    std::erase_if(objects, [&](const auto& entry) {
        if (!entry.second.is_spare) return false;
        if (entry.second.bytes > left) return true;
        left -= entry.second.bytes;
        return false;
    });
}

void FrameMemory::allocate() {
    std::vector<std::string> live;
    for (std::size_t i = 0; i < frame_.builder->images().size(); ++i)
        if (frame_.plan.image_live[i]) live.push_back(frame_.builder->images()[i].text.key);
    for (std::size_t i = 0; i < frame_.builder->buffers().size(); ++i)
        if (frame_.plan.buffer_live[i]) live.push_back(frame_.builder->buffers()[i].text.key);
    frame_.cache.pool.free_except(live);
    frame_.cache.pool.begin_attempt();
    frame_.cache.buffer_descs.clear();
    for (const auto& desc : frame_.builder->buffers()) frame_.cache.buffer_descs[desc.text.key] = desc;
    frame_.images.assign(frame_.builder->images().size(), nullptr);
    frame_.buffers.assign(frame_.builder->buffers().size(), nullptr);
    for (std::size_t i = 0; i < frame_.images.size(); ++i) {
        const auto& desc = frame_.builder->images()[i];
        if (frame_.plan.image_live[i])
            frame_.images[i] =
                &frame_.cache.pool.image(desc.text.key, desc.text.label, resolve(desc, frame_.inputs->view),
                                         frame_.plan.image_history[i]);
    }
    for (std::size_t i = 0; i < frame_.buffers.size(); ++i) {
        const auto& desc = frame_.builder->buffers()[i];
        if (frame_.plan.buffer_live[i])
            frame_.buffers[i] =
                &frame_.cache.pool.buffer(desc.text.key, desc.text.label, stride(desc), capacity_of(desc),
                                          desc.elements, frame_.plan.buffer_history[i]);
    }
}

void FrameMemory::prepare_counters() {
    const auto count = std::max<std::size_t>(1, frame_.builder->counters().size());
    const auto bytes = count * counter_stride;
    if (bytes > frame_.cache.counter_capacity) {
        if (frame_.cache.counter_buffer) frame_.cache.device.destroy_buffer(frame_.cache.counter_buffer);
        frame_.cache.counter_buffer = frame_.cache.device.create_buffer(bytes, "counters");
        frame_.cache.counter_capacity = bytes;
    }
    frame_.cache.device.clear_buffer(frame_.cache.counter_buffer, 0, frame_.cache.counter_capacity);
    frame_.host_counters = std::make_unique<std::atomic<std::uint32_t>[]>(count);
    for (std::size_t i = 0; i < count; ++i) frame_.host_counters[i] = 0;
}

void FrameMemory::prepare_parameters() {
    if (frame_.cache.programs) frame_.cache.programs->begin_frame();
    if (auto glsl = gl::parameter_glsl(frame_.method->description.parameters, *frame_.settings);
        glsl != frame_.cache.parameter_glsl) {
        frame_.cache.parameter_glsl = std::move(glsl);
        frame_.cache.programs_with_parameters.clear();
    }
    if (frame_.cache.shader_changes != frame_.inputs->shader_changes) {
        frame_.cache.shader_changes = frame_.inputs->shader_changes;
        frame_.cache.programs_with_parameters.clear();
    }
    auto block = gl::parameter_block(frame_.method->description.parameters, *frame_.settings);
    if (block.empty()) block.push_back(0);
    const auto bytes = std::max<std::uint64_t>(16, block.size() * 4);
    if (bytes > frame_.cache.parameter_bytes) {
        if (frame_.cache.parameter_buffer) frame_.cache.device.destroy_buffer(frame_.cache.parameter_buffer);
        frame_.cache.parameter_buffer = frame_.cache.device.create_buffer(bytes, "parameters");
        frame_.cache.parameter_bytes = bytes;
    }
    frame_.cache.device.write_buffer(frame_.cache.parameter_buffer, 0, std::as_bytes(std::span(block)));
}

bool FrameMemory::grow(const std::vector<std::uint64_t>& counts) {
    bool overflow = false;
    for (std::size_t i = 0; i < frame_.builder->buffers().size(); ++i) {
        const auto& desc = frame_.builder->buffers()[i];
        if (!desc.growable || !frame_.plan.buffer_live[i]) continue;
        std::uint64_t need = 0;
        for (std::size_t c = 0; c < counts.size(); ++c)
            if (frame_.builder->counters()[c].growth_of.index == static_cast<int>(i))
                need = std::max(need, counts[c]);
        const auto capacity = capacity_of(desc);
        if (need <= capacity) continue;
        frame_.cache.grown[desc.text.key] =
            static_cast<std::uint64_t>(std::ceil(1.25 * static_cast<double>(need)));
        frame_.cache.estimates[desc.text.key] = desc.elements;
        ++frame_.cache.growths;
        overflow = true;
        frame_.cache.report.messages.push_back({Severity::note, "graph",
                                                "buffer '" + desc.text.key + "' held " +
                                                    std::to_string(capacity) + " of " + std::to_string(need) +
                                                    " elements and grows to " +
                                                    std::to_string(frame_.cache.grown[desc.text.key])});
    }
    return overflow;
}

}  // namespace ir::graph
