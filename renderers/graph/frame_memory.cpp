#include <algorithm>
#include <cmath>

#include "renderers/graph/state.h"

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

std::uint64_t Graph::State::capacity_of(const BufferDesc& desc) const {
    if (!desc.growable) return desc.elements;
    const auto& key = desc.text.key;
    const auto estimate = estimates.find(key);
    if (estimate != estimates.end() && estimate->second == desc.elements) return grown.at(key);
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(desc.elements * options->initial_capacity));
}

MemoryPlan Graph::State::plan_memory() const {
    return memory_of(*builder, plan, [&](const BufferDesc& desc) { return capacity_of(desc); });
}

bool Graph::State::fits(const MemoryPlan& memory) const {
    return memory.largest_buffer.bytes <= device.max_buffer_bytes() &&
           (options->memory_budget == 0 || memory.bytes <= options->memory_budget);
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
    free_dead_objects();
}

void Graph::State::free_dead_objects() {
    std::erase_if(objects, [&](const auto& entry) {
        for (std::size_t i = 0; i < builder->objects().size(); ++i)
            if (plan.object_live[i] && builder->objects()[i].text.key == entry.first) return false;
        return true;
    });
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
    programs_with_parameters.clear();
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

}  // namespace ir::graph
