#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <ranges>
#include <string>
#include <vector>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "renderers/methods/all_methods.h"
#include "tests/image/methods/machine.h"

namespace ir::test {

/// Scenes that are small and differ: one closed and coloured, one open with maps, masks and an environment.
inline const std::vector<std::string> scenes{"builtin:cornell", "builtin:atrium?detail=0.05"};

using engine::machine;
using engine::machines;

inline bool is_number(const std::string& text) {
    return std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Integers are what work is multiplied by: more than this of anything takes too long here.
inline constexpr std::int64_t quick_limit = 16;

/// Defaults, with every large integer lowered as far as its slider goes, and the lowest of chosen numbers.
inline Settings quick_settings(const MethodDescription& method) {
    auto settings = defaults(method.parameters);
    for (const auto& p : method.parameters) {
        if (p.type == ParameterType::choice && is_number(p.choices.front().key))
            settings[p.key] = p.choices.front().key;
        if (p.type != ParameterType::integer) continue;
        auto& value = std::get<std::int64_t>(settings.at(p.key));
        const auto least = static_cast<std::int64_t>(std::max(p.soft.min, -1e15));
        value = std::min(value, std::max(least, quick_limit));
    }
    return settings;
}

/// The values between which a parameter is tried: both ends of its slider, all choices, or the two lowest of
/// chosen numbers.
inline std::vector<Value> tried_values(const ParameterDescription& p) {
    if (p.type == ParameterType::toggle) return {false, true};
    if (p.type == ParameterType::choice) {
        std::vector<Value> values;
        for (const auto& choice : p.choices)
            if (p.supported.empty() ||
                std::find(p.supported.begin(), p.supported.end(), choice.key) != p.supported.end())
                values.push_back(choice.key);
        if (is_number(p.choices.front().key)) values.resize(2);  // larger ones take long and show no more
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
    if (p.active_when.key.empty()) return true;
    const auto* condition = find(method.parameters, p.active_when.key);
    if (!condition || depth > 8 || !activate(method, *condition, settings, depth + 1)) return false;
    if (is_active(p, settings)) return true;
    const auto possible = tried_values(*condition);
    for (const auto& value : std::views::reverse(p.active_when.values)) {
        const bool is_choice = condition->type == ParameterType::choice;
        if (is_choice && std::find(possible.begin(), possible.end(), value) == possible.end()) continue;
        settings[condition->key] = value;
        if (is_active(p, settings)) return true;
    }
    return false;
}

/// As projects have them that are older than some of the parameters: published, mostly.
inline Settings older_settings(const MethodDescription& method, Settings settings) {
    for (const auto& p : method.parameters)
        if (p.value_in_older_projects) settings[p.key] = *p.value_in_older_projects;
    return settings;
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
    std::map<std::string, std::vector<Image>> images;  ///< outputs, each level and layer
    std::map<std::string, std::vector<std::byte>> buffers;
};

/// The main result alone, all outputs but those that explain, or all.
enum class Wanted { main, results, all };

struct Shot {
    std::string scene = scenes.front(), backend = "";
    std::uint64_t seed = 7;
    int frames = 1;
    Inspection inspection = {};
    glm::ivec2 size{48, 32};
    Wanted wanted = Wanted::all;
};

/// A method on one scene. Settings are changed one after another, as in a window: what a change leaves valid
/// is not computed again.
class Studio {
  public:
    Studio(const graph::Method& method, Shot shot)
        : method_(method),
          shot_(std::move(shot)),
          execution_(std::make_unique<engine::Execution>(machine(shot_.backend), experiment({}))) {}

    const graph::Method& method() const { return method_; }
    const std::string& scene() const { return shot_.scene; }

    /// The outputs that the shot wants, after its frames.
    Frame render(const Settings& settings) { return render(settings, shot_.frames); }
    Frame render(const Settings& settings, int frames) {
        execution_->update(experiment(settings));
        execution_->restart();
        execution_->inspect(shot_.inspection);
        graph::FrameOptions options;
        options.wanted = wanted();
        Frame frame;
        for (int i = 0; i < frames; ++i) frame.report = execution_->run_frame(options);
        const auto& graph = execution_->graph();
        frame.main = main_result(*execution_);
        frame.valid = graph.read_image("valid").value_or(Image());
        for (const auto& resource : frame.report.resources) {
            if (!resource.is_output || !is_wanted(resource)) continue;
            if (auto images = read_images(resource); !images.empty())
                frame.images[resource.key] = std::move(images);
            if (const auto* desc = graph.buffer_desc(resource.key)) {
                // Beyond the elements in use is rubbish.
                auto bytes = graph.read_buffer(resource.key, resource.elements * graph::stride(*desc));
                if (!bytes) continue;
                frame.buffers[resource.key] = std::move(*bytes);
            }
        }
        return frame;
    }

  private:
    engine::Experiment experiment(const Settings& settings) const {
        engine::Experiment result;
        result.scene = shot_.scene;
        result.method = method_.description.id;
        result.settings = settings;
        result.width = shot_.size.x;
        result.height = shot_.size.y;
        result.seed = shot_.seed;
        return result;
    }

    std::vector<std::string> wanted() const {
        if (shot_.wanted == Wanted::all) return {"*"};
        std::vector<std::string> keys;
        for (const auto& output : method_.description.outputs)
            if (shot_.wanted == Wanted::results && !output.explains) keys.push_back(output.key);
        return keys;
    }

    bool is_wanted(const ResourceReport& resource) const {
        return shot_.wanted == Wanted::all || (shot_.wanted == Wanted::results && !resource.explains);
    }

    /// Of all levels and layers.
    std::vector<Image> read_images(const ResourceReport& resource) const {
        std::vector<Image> images;
        for (int level = 0; level < resource.levels; ++level)
            for (int layer = 0; layer < resource.layers; ++layer)
                if (auto image = execution_->graph().read_image(resource.key, level, layer))
                    images.push_back(std::move(*image));
        return images;
    }

    const graph::Method& method_;
    Shot shot_;
    std::unique_ptr<engine::Execution> execution_;
};

/// One for each of `scenes`, in which all but explanations is wanted.
inline std::vector<Studio> studios(const graph::Method& method, glm::ivec2 size) {
    std::vector<Studio> all;
    for (const auto& scene : scenes)
        all.emplace_back(method, Shot{.scene = scene, .size = size, .wanted = Wanted::results});
    return all;
}

/// With nothing left from another picture.
inline Frame render(const graph::Method& method, const Settings& settings, const Shot& shot = {}) {
    return Studio(method, shot).render(settings);
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
