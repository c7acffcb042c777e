#include <algorithm>
#include <cmath>

#include "renderers/graph/frame.h"

namespace ir::graph {
MemoryPlan memory_of(const GraphBuilder& builder, const Plan& plan,
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
    return result;
}

std::uint64_t Frame::capacity_of(const BufferDesc& desc) const {
    if (!desc.growable) return desc.elements;
    const auto& key = desc.text.key;
    const auto estimate = cache.estimates.find(key);
    if (estimate != cache.estimates.end() && estimate->second == desc.elements) return cache.grown.at(key);
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(desc.elements * options->initial_capacity));
}

MemoryPlan Frame::plan_memory() const {
    return memory_of(*builder, plan, [&](const BufferDesc& desc) { return capacity_of(desc); });
}

bool Frame::fits(const MemoryPlan& memory) const {
    return memory.largest_buffer.bytes <= cache.device.max_buffer_bytes() &&
           (options->memory_budget == 0 || memory.bytes <= options->memory_budget);
}

void Frame::allocate() {
    std::vector<std::string> live;
    for (std::size_t i = 0; i < builder->images().size(); ++i)
        if (plan.image_live[i]) live.push_back(builder->images()[i].text.key);
    for (std::size_t i = 0; i < builder->buffers().size(); ++i)
        if (plan.buffer_live[i]) live.push_back(builder->buffers()[i].text.key);
    cache.pool.free_except(live);
    cache.pool.begin_attempt();
    cache.buffer_descs.clear();
    for (const auto& desc : builder->buffers()) cache.buffer_descs[desc.text.key] = desc;
    images.assign(builder->images().size(), nullptr);
    buffers.assign(builder->buffers().size(), nullptr);
    for (std::size_t i = 0; i < images.size(); ++i) {
        const auto& desc = builder->images()[i];
        if (plan.image_live[i])
            images[i] = &cache.pool.image(desc.text.key, desc.text.label, resolve(desc, inputs->view),
                                          plan.image_history[i]);
    }
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const auto& desc = builder->buffers()[i];
        if (plan.buffer_live[i])
            buffers[i] = &cache.pool.buffer(desc.text.key, desc.text.label, stride(desc), capacity_of(desc),
                                            desc.elements, plan.buffer_history[i]);
    }
    free_dead_objects();
}

void Frame::free_dead_objects() {
    std::erase_if(cache.objects, [&](const auto& entry) {
        for (std::size_t i = 0; i < builder->objects().size(); ++i)
            if (plan.object_live[i] && builder->objects()[i].text.key == entry.first) return false;
        return true;
    });
}

void Frame::prepare_counters() {
    const auto count = std::max<std::size_t>(1, builder->counters().size());
    const auto bytes = count * counter_stride;
    if (bytes > cache.counter_capacity) {
        if (cache.counter_buffer) cache.device.destroy_buffer(cache.counter_buffer);
        cache.counter_buffer = cache.device.create_buffer(bytes, "counters");
        cache.counter_capacity = bytes;
    }
    cache.device.clear_buffer(cache.counter_buffer, 0, cache.counter_capacity);
    host_counters = std::make_unique<std::atomic<std::uint32_t>[]>(count);
    for (std::size_t i = 0; i < count; ++i) host_counters[i] = 0;
}

void Frame::prepare_parameters() {
    if (auto glsl = gl::parameter_glsl(method->description.parameters, *settings);
        glsl != cache.parameter_glsl) {
        cache.parameter_glsl = std::move(glsl);
        cache.programs_with_parameters.clear();
    }
    auto block = gl::parameter_block(method->description.parameters, *settings);
    if (block.empty()) block.push_back(0);
    const auto bytes = std::max<std::uint64_t>(16, block.size() * 4);
    if (bytes > cache.parameter_bytes) {
        if (cache.parameter_buffer) cache.device.destroy_buffer(cache.parameter_buffer);
        cache.parameter_buffer = cache.device.create_buffer(bytes, "parameters");
        cache.parameter_bytes = bytes;
    }
    cache.device.write_buffer(cache.parameter_buffer, 0, std::as_bytes(std::span(block)));
}

bool Frame::grow(const std::vector<std::uint64_t>& counts) {
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
        cache.grown[desc.text.key] = static_cast<std::uint64_t>(std::ceil(1.25 * static_cast<double>(need)));
        cache.estimates[desc.text.key] = desc.elements;
        ++cache.growths;
        overflow = true;
        cache.report.messages.push_back({Severity::note, "graph",
                                         "buffer '" + desc.text.key + "' held " + std::to_string(capacity) +
                                             " of " + std::to_string(need) + " elements and grows to " +
                                             std::to_string(cache.grown[desc.text.key])});
    }
    return overflow;
}

}  // namespace ir::graph
