#include <algorithm>
#include <cmath>

#include "renderers/core/error.h"
#include "renderers/graph/frame.h"

namespace ir::graph {
namespace {

/// "1.05 MB": rounded up, so that what is more than an exact amount reads as more.
std::string rounded_up(std::uint64_t bytes) {
    const char* const units[] = {" B", " kB", " MB", " GB"};
    double value = static_cast<double>(bytes);
    int unit = 0;
    for (; value >= 1000 && unit < 3; ++unit) value /= 1000;
    const int decimals = unit == 0 || value >= 100 ? 0 : value >= 10 ? 1 : 2;
    const double scale = std::pow(10, decimals);
    return to_string(std::ceil(value * scale) / scale) + units[unit];
}

/// In the largest unit of which it is a whole number of hundredths: as somebody gives it.
std::string as_given(std::uint64_t bytes) {
    const std::pair<std::uint64_t, const char*> units[] = {{1'000'000'000, " GB"},
                                                           {1ull << 30, " GiB"},
                                                           {1'000'000, " MB"},
                                                           {1ull << 20, " MiB"},
                                                           {1'000, " kB"}};
    for (const auto& [size, name] : units) {
        if (bytes < size || 100 * bytes % size != 0) continue;
        return to_string(static_cast<double>(bytes) / static_cast<double>(size)) + name;
    }
    return std::to_string(bytes) + " B";
}

/// A change that somebody may make, and what the frame would take then.
struct Advice {
    std::string text;
    std::uint64_t bytes = 0;
};

/// Half of a number, and twice as much, as far as its range allows; 0 stays.
std::vector<Value> other_values(const ParameterDescription& parameter, const Value& value) {
    std::vector<Value> result;
    const auto is_allowed = [&](double x) { return x >= parameter.hard.min && x <= parameter.hard.max; };
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        for (const auto other : {*whole / 2, *whole * 2})
            if (other != *whole && is_allowed(static_cast<double>(other))) result.push_back(other);
    } else if (const auto* number = std::get_if<double>(&value)) {
        for (const auto other : {*number / 2, *number * 2})
            if (other != *number && is_allowed(other))
                result.push_back(as_written(static_cast<float>(other)));
    }
    return result;
}

double number_of(const Value& value) {
    const auto* whole = std::get_if<std::int64_t>(&value);
    return whole ? static_cast<double>(*whole) : std::get<double>(value);
}

/// Declares frames other than the one in flight, without running them.
class Adviser {
  public:
    using Measure = std::uint64_t (*)(const MemoryPlan&);
    Adviser(Frame& frame, Measure measure) : frame_(frame), measure_(measure) {}

    /// What saves the most first.
    std::vector<Advice> advice(std::uint64_t needed) {
        for (const auto& parameter : frame_.method->description.parameters) try_parameter(parameter);
        try_image_size();
        std::erase_if(all_, [&](const Advice& advice) { return advice.bytes >= needed; });
        std::stable_sort(all_.begin(), all_.end(),
                         [](const Advice& a, const Advice& b) { return a.bytes < b.bytes; });
        return all_;
    }

  private:
    void try_parameter(const ParameterDescription& parameter) {
        const auto& value = frame_.settings->at(parameter.key);
        if (!is_active(parameter, *frame_.settings)) return;
        for (const auto& other : other_values(parameter, value)) {
            auto settings = *frame_.settings;
            settings[parameter.key] = other;
            const bool is_less = number_of(other) < number_of(value);
            add((is_less ? "lower '" : "raise '") + parameter.key + "' to " + to_string(other), settings,
                *frame_.inputs, parameter.effect);
        }
    }

    void try_image_size() {
        auto inputs = *frame_.inputs;
        for (auto* view : {&inputs.view, &inputs.previous_view}) {
            view->width = std::max(1, view->width / 2);
            view->height = std::max(1, view->height / 2);
        }
        add("lower the image size to " + std::to_string(inputs.view.width) + "x" +
                std::to_string(inputs.view.height),
            *frame_.settings, inputs, Effect::image);
    }

    void add(const std::string& change, const Settings& settings, const FrameInputs& inputs, Effect effect) {
        GraphBuilder declared(frame_.method->description, inputs, frame_.cache.batches,
                              frame_.cache.device.max_buffer_bytes());
        try {
            frame_.method->setup(declared, settings);
            const auto plan = make_plan(declared, wanted_of(*frame_.method, settings, *frame_.options));
            const auto memory = memory_of(declared, plan, frame_.cache.objects, [&](const BufferDesc& desc) {
                return expected_elements(desc, effect);
            });
            const auto bytes = measure_(memory);
            all_.push_back({change + " (then " + rounded_up(bytes) + ")", bytes});
        } catch (const Error&) {
            // The method refuses these settings: no advice.
        }
    }

    /// Where a capacity was learned it changes with the estimate, except by what does not change the picture.
    std::uint64_t expected_elements(const BufferDesc& desc, Effect effect) const {
        const auto estimate = frame_.cache.estimates.find(desc.text.key);
        if (!desc.growable || estimate == frame_.cache.estimates.end())
            return FrameMemory(frame_).capacity_of(desc);
        const auto learned = frame_.cache.grown.at(desc.text.key);
        if (effect == Effect::cost || estimate->second == 0) return learned;
        return static_cast<std::uint64_t>(static_cast<double>(learned) * static_cast<double>(desc.elements) /
                                          static_cast<double>(estimate->second));
    }

    Frame& frame_;
    Measure measure_;
    std::vector<Advice> all_;
};

/// What to do, in the order of what it saves: at most two changes, the second only where it is enough or
/// saves at least half as much. Says where none is enough.
std::string mend(const MemoryPlan::Resource& largest, std::uint64_t needed, std::uint64_t limit,
                 std::vector<Advice> advice) {
    std::string result;
    const auto append = [&](const std::string& change) { result += (result.empty() ? "" : " or ") + change; };
    if (!largest.lower.empty()) append("lower " + largest.lower);
    if (advice.size() > 2) advice.resize(2);
    for (const auto& change : advice)
        if (change.bytes <= limit || 2 * (needed - change.bytes) >= needed - advice.front().bytes)
            append(change.text);
    if (result.empty()) return "use a smaller scene";
    const bool is_enough = !largest.lower.empty() || advice.empty() || advice.front().bytes <= limit;
    return result + (is_enough ? "" : ", which is not enough alone");
}

}  // namespace

void refuse(Frame& frame, const MemoryPlan& memory) {
    const auto start = "method '" + frame.method->description.id + "' needs ";
    if (const auto& buffer = memory.largest_buffer; buffer.bytes > frame.cache.device.max_buffer_bytes()) {
        const auto advice = Adviser(frame, [](const MemoryPlan& plan) {
                                return plan.largest_buffer.bytes;
                            }).advice(buffer.bytes);
        throw BudgetError(start + "a buffer, '" + buffer.key + "' (" + rounded_up(buffer.bytes) +
                          "), beyond the device's limit of " +
                          as_given(frame.cache.device.max_buffer_bytes()) + "; " +
                          mend(buffer, buffer.bytes, frame.cache.device.max_buffer_bytes(), advice));
    }
    const auto advice =
        Adviser(frame, [](const MemoryPlan& plan) { return plan.bytes; }).advice(memory.bytes);
    throw BudgetError(start + rounded_up(memory.bytes) + ", more than the memory budget of " +
                      as_given(frame.options->memory_budget) + "; its largest resource is '" +
                      memory.largest.key + "' (" + rounded_up(memory.largest.bytes) + "); " +
                      mend(memory.largest, memory.bytes, frame.options->memory_budget, advice) +
                      ", or raise --memory");
}

}  // namespace ir::graph
