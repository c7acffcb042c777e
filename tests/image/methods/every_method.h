#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <ranges>
#include <string>
#include <vector>

#include "app/engine/execution.h"
#include "renderers/methods/all_methods.h"

namespace ir::test {

/// Scenes that are small and differ: one closed and coloured, one open with maps, masks and an environment.
inline const std::vector<std::string> scenes{"builtin:cornell", "builtin:atrium?detail=0.05"};

/// One machine per backend, kept between tests so that programs and scenes are loaded once.
inline std::map<std::string, std::unique_ptr<engine::Machine>>& machines() {
    static std::map<std::string, std::unique_ptr<engine::Machine>> all;
    return all;
}

inline engine::Machine& machine(const std::string& backend = "") {
    auto& result = machines()[backend];
    if (!result) {
        engine::MachineOptions options;
        options.backend = backend;
        result = std::make_unique<engine::Machine>(options);
    }
    result->context().make_current();
    return *result;
}

/// Integers are what work is multiplied by: more than this of anything takes too long here.
inline constexpr std::int64_t quick_limit = 16;

/// Defaults, with every large integer lowered as far as its slider goes.
inline Settings quick_settings(const MethodDescription& method) {
    auto settings = defaults(method.parameters);
    for (const auto& p : method.parameters) {
        if (p.type != ParameterType::integer) continue;
        auto& value = std::get<std::int64_t>(settings.at(p.key));
        const auto least = static_cast<std::int64_t>(std::max(p.soft.min, -1e15));
        value = std::min(value, std::max(least, quick_limit));
    }
    return settings;
}

/// The values between which a parameter is tried: both ends of its slider, or all choices.
inline std::vector<Value> tried_values(const ParameterDescription& p) {
    if (p.type == ParameterType::toggle) return {false, true};
    if (p.type == ParameterType::choice) {
        std::vector<Value> values;
        for (const auto& choice : p.choices)
            if (p.supported.empty() ||
                std::find(p.supported.begin(), p.supported.end(), choice.key) != p.supported.end())
                values.push_back(choice.key);
        return values;
    }
    const double low = std::max({p.soft.min, p.hard.min, -1e6}),
                 high = std::min({p.soft.max, p.hard.max, 1e6});
    if (!(low < high)) return {p.default_value};
    if (p.type == ParameterType::number) return {low, high};
    const auto first = static_cast<std::int64_t>(low), last = static_cast<std::int64_t>(high);
    return {first, std::min(last, std::max(2 * first, quick_limit))};
}

/// Sets what makes the parameter active, the last that does: of paths that is the one with all light. False
/// when nothing does.
inline bool activate(const MethodDescription& method, const ParameterDescription& p, Settings& settings,
                     int depth = 0) {
    if (is_active(p, settings)) return true;
    const auto* condition = find(method.parameters, p.active_when.key);
    if (!condition || depth > 8 || !activate(method, *condition, settings, depth + 1)) return false;
    const auto possible = tried_values(*condition);
    for (const auto& value : std::views::reverse(p.active_when.values)) {
        const bool is_choice = condition->type == ParameterType::choice;
        if (is_choice && std::find(possible.begin(), possible.end(), value) == possible.end()) continue;
        settings[condition->key] = value;
        if (is_active(p, settings)) return true;
    }
    return false;
}

/// Every other number in the middle of its slider, so that effects that cancel at the defaults show.
inline Settings middle_settings(const MethodDescription& method, Settings settings) {
    for (const auto& p : method.parameters) {
        const auto values = tried_values(p);
        if (p.type == ParameterType::number && values.size() == 2)
            settings[p.key] = 0.5 * (std::get<double>(values[0]) + std::get<double>(values[1]));
    }
    return settings;
}

struct Frame {
    FrameReport report;
    Image main, valid;
    std::map<std::string, std::vector<float>> images;  ///< outputs, all levels and layers
    std::map<std::string, std::vector<std::byte>> buffers;
};

struct Shot {
    std::string scene = scenes.front(), backend = "";
    std::uint64_t seed = 7;
    int frames = 1;
    Inspection inspection = {};
};

/// The outputs of a method after some frames in which everything was wanted.
inline Frame render(const graph::Method& method, const Settings& settings, const Shot& run = {}) {
    engine::Experiment experiment;
    experiment.scene = run.scene;
    experiment.method = method.description.id;
    experiment.settings = settings;
    experiment.width = 48;
    experiment.height = 32;
    experiment.seed = run.seed;
    engine::Execution execution(machine(run.backend), experiment);
    execution.inspect(run.inspection);
    graph::FrameOptions options;
    options.wanted = {"*"};
    Frame frame;
    for (int i = 0; i < run.frames; ++i) frame.report = execution.run_frame(options);
    frame.main = execution.main_result();
    frame.valid = execution.graph().read_image("valid").value_or(Image());
    for (const auto& output : method.description.outputs) {
        for (const auto& resource : frame.report.resources) {
            if (resource.key != output.key) continue;
            auto& texels = frame.images[output.key];
            for (int level = 0; level < resource.levels; ++level)
                for (int layer = 0; layer < resource.layers; ++layer)
                    if (const auto image = execution.graph().read_image(output.key, level, layer))
                        texels.insert(texels.end(), image->pixels.begin(), image->pixels.end());
        }
        if (auto bytes = execution.graph().read_buffer(output.key)) {
            for (const auto& resource : frame.report.resources)  // beyond the elements in use is rubbish
                if (resource.key == output.key)
                    bytes->resize(std::min<std::size_t>(
                        bytes->size(),
                        resource.elements * graph::stride(*execution.graph().buffer_desc(output.key))));
            frame.buffers[output.key] = std::move(*bytes);
        }
    }
    return frame;
}

/// `settings`, changed by `more`.
inline Settings with(Settings settings, const Settings& more) {
    for (const auto& [key, value] : more) settings[key] = value;
    return settings;
}

/// Mean absolute difference of the main results over pixels that are valid in both.
inline double difference(const Frame& a, const Frame& b) {
    EXPECT_EQ(a.main.pixels.size(), b.main.pixels.size());
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(a.main.pixels.size(), b.main.pixels.size()); ++i) {
        const auto pixel = i / a.main.channels;
        if (!a.valid.empty() && a.valid.pixels[pixel] < 0.5f) continue;
        if (!b.valid.empty() && b.valid.pixels[pixel] < 0.5f) continue;
        sum += std::abs(static_cast<double>(a.main.pixels[i]) - b.main.pixels[i]);
        ++count;
    }
    EXPECT_GT(count, 0u) << "no pixel counts";
    return sum / static_cast<double>(count);
}

}  // namespace ir::test
