#include <algorithm>
#include <cmath>

#include "renderers/core/error.h"
#include "renderers/graph/state.h"

namespace ir::graph {
namespace {

std::string megabytes(std::uint64_t bytes) {
    return std::to_string((bytes + 999'999) / 1'000'000) + " MB";
}

/// Finds the largest of the resources that a frame plans.
class LargestResource {
  public:
    explicit LargestResource(MemoryPlan& plan) : plan_(plan) {}
    void add(const std::string& key, std::uint64_t bytes, const std::string& lower) {
        plan_.bytes += bytes;
        if (bytes > most_) {
            most_ = bytes;
            plan_.largest = "'" + key + "' (" + megabytes(bytes) + ")";
        }
        if (!lower.empty() && bytes >= most_with_parameter_) {
            most_with_parameter_ = bytes;
            plan_.lower = lower;
        }
    }

  private:
    MemoryPlan& plan_;
    std::uint64_t most_ = 0, most_with_parameter_ = 0;
};

}  // namespace

std::uint64_t Graph::State::capacity_of(const BufferDesc& desc) const {
    if (!desc.growable) return desc.elements;
    const auto& key = desc.text.key;
    const auto estimate = estimates.find(key);
    if (estimate != estimates.end() && estimate->second == desc.elements) return grown.at(key);
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(desc.elements * options->initial_capacity));
}

MemoryPlan Graph::State::plan_memory() const {
    MemoryPlan result;
    LargestResource largest(result);
    for (std::size_t i = 0; i < builder->images().size(); ++i) {
        if (!plan.image_live[i]) continue;
        const auto& desc = builder->images()[i];
        largest.add(desc.text.key, resolve(desc, inputs->view).bytes() * (plan.image_history[i] ? 2 : 1), {});
    }
    for (std::size_t i = 0; i < builder->buffers().size(); ++i) {
        if (!plan.buffer_live[i]) continue;
        const auto& desc = builder->buffers()[i];
        const auto bytes = capacity_of(desc) * stride(desc);
        largest.add(desc.text.key, bytes * (plan.buffer_history[i] ? 2 : 1), desc.lower);
        if (bytes <= device.max_buffer_bytes() || !result.too_large_for_device.empty()) continue;
        result.too_large_for_device = "'" + desc.text.key + "' (" + megabytes(bytes) + ")";
        result.lower_for_device = desc.lower;
    }
    return result;
}

bool Graph::State::fits(const MemoryPlan& memory) const {
    return memory.too_large_for_device.empty() &&
           (options->memory_budget == 0 || memory.bytes <= options->memory_budget);
}

void Graph::State::refuse(const MemoryPlan& memory) const {
    const auto start = "method '" + method->description.id + "' needs ";
    const auto parameter = [](const std::string& lower) { return lower.empty() ? "the image size" : lower; };
    if (!memory.too_large_for_device.empty())
        throw BudgetError(start + "a buffer, " + memory.too_large_for_device +
                          ", beyond the device's limit of " + megabytes(device.max_buffer_bytes()) +
                          "; lower " + parameter(memory.lower_for_device));
    throw BudgetError(start + megabytes(memory.bytes) + ", more than the memory budget of " +
                      megabytes(options->memory_budget) + "; its largest resource is " + memory.largest +
                      "; lower " + parameter(memory.lower) + " or raise --memory");
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
