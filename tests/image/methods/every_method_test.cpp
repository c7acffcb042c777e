// What every method owes, tested from its description alone.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "renderers/core/describe.h"
#include "tests/image/methods/every_method.h"
#include "tests/unit/gl/context_fixture.h"

namespace ir::test {
namespace {

/// For what does not depend on details.
constexpr glm::ivec2 small{24, 16};

class EveryMethod : public testing::TestWithParam<const graph::Method*> {
  protected:
    static void TearDownTestSuite() {
        usual_frames().clear();
        machines().clear();
    }
    const graph::Method& method() const { return *GetParam(); }
    const MethodDescription& description() const { return GetParam()->description; }

    /// On one of `scenes` with quick settings: rendered once for all tests of a method.
    const Frame& usual(const std::string& scene) const {
        auto& frame = usual_frames()[{description().id, scene}];
        if (frame.main.empty())
            frame = render(method(), quick_settings(description()), {.scene = scene, .size = small});
        return frame;
    }

  private:
    static std::map<std::pair<std::string, std::string>, Frame>& usual_frames() {
        static std::map<std::pair<std::string, std::string>, Frame> frames;
        return frames;
    }
};

std::string method_name(const testing::TestParamInfo<const graph::Method*>& info) {
    auto name = info.param->description.id;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(, EveryMethod, testing::ValuesIn(methods::all_methods()), method_name);

TEST_P(EveryMethod, DefaultsLieInBothRanges) {
    for (const auto& p : description().parameters) {
        EXPECT_NO_THROW(p.checked(p.default_value)) << p.key;
        if (p.type == ParameterType::toggle || p.type == ParameterType::choice) continue;
        const double value = p.type == ParameterType::number
                                 ? std::get<double>(p.default_value)
                                 : static_cast<double>(std::get<std::int64_t>(p.default_value));
        EXPECT_GE(value, p.soft.min) << p.key;
        EXPECT_LE(value, p.soft.max) << p.key;
        EXPECT_TRUE(std::isfinite(p.soft.min) && std::isfinite(p.soft.max)) << p.key << ": a slider has ends";
        EXPECT_LE(p.hard.min, p.soft.min) << p.key;
        EXPECT_GE(p.hard.max, p.soft.max) << p.key;
    }
}

TEST_P(EveryMethod, ValuesSurviveTextAndCompletion) {
    const auto& parameters = description().parameters;
    EXPECT_EQ(completed(parameters, {}), defaults(parameters));
    for (const auto& p : parameters) {
        auto values = tried_values(p);
        values.push_back(p.default_value);
        for (const auto& value : values) {
            EXPECT_EQ(p.parse(to_string(value)), value) << p.key;
            EXPECT_EQ(completed(parameters, {{p.key, value}}).at(p.key), value) << p.key;
        }
        if (p.active_when.key.empty()) continue;
        EXPECT_NE(find(parameters, p.active_when.key), nullptr) << p.key;
        auto settings = defaults(parameters);
        EXPECT_TRUE(activate(description(), p, settings)) << p.key << " is never active";
    }
    EXPECT_THROW(completed(parameters, {{"no such parameter", true}}), UsageError);
}

TEST_P(EveryMethod, DescribesItself) {
    const auto json = nlohmann::json::parse(describe_json(description()));
    EXPECT_EQ(json.at("id"), description().id);
    const auto page = describe_markdown(description());
    EXPECT_FALSE(description().title.empty());
    EXPECT_FALSE(description().summary.empty());
    for (const auto& p : description().parameters) {
        EXPECT_NE(page.find("`" + p.key + "`"), std::string::npos) << p.key;
        EXPECT_FALSE(p.label.empty()) << p.key;
        EXPECT_FALSE(p.doc.empty()) << p.key;
    }
    for (const auto& output : description().outputs) {
        EXPECT_NE(page.find("`" + output.key + "`"), std::string::npos) << output.key;
        EXPECT_FALSE(output.doc.empty()) << output.key;
    }
}

TEST_P(EveryMethod, OutputsExistAndAreFiniteWhereValid) {
    for (const auto& scene : scenes) {
        const auto settings = quick_settings(description());
        const auto& frame = usual(scene);
        ASSERT_FALSE(frame.main.empty());
        EXPECT_FALSE(frame.valid.empty()) << "every method writes a valid mask";
        for (const auto& output : description().outputs) {
            if (!is_active(description(), output, settings)) continue;
            const auto image = frame.images.find(output.key);
            EXPECT_TRUE(image != frame.images.end() || frame.buffers.count(output.key))
                << output.key << " on " << scene;
        }
        for (const auto& [key, images] : frame.images)
            for (const auto& image : images) {
                if (image.width != frame.main.width || image.height != frame.main.height) continue;
                for (std::size_t i = 0; i < image.pixels.size(); ++i) {
                    const bool counts = frame.valid.empty() || frame.valid.pixels[i / image.channels] > 0.5f;
                    ASSERT_TRUE(!counts || std::isfinite(image.pixels[i]))
                        << key << " at " << i << " on " << scene;
                }
            }
    }
}

/// Numbers of a buffer's elements that are not finite.
std::size_t count_not_finite(const std::vector<std::byte>& bytes, const std::vector<Field>& fields) {
    std::vector<bool> is_float;
    for (const auto& field : fields)
        is_float.insert(is_float.end(), static_cast<std::size_t>(field.count), field.type == FieldType::f32);
    std::size_t count = 0;
    for (std::size_t i = 0; i < bytes.size() / 4; ++i) {
        float value;
        std::memcpy(&value, bytes.data() + 4 * i, 4);
        count += is_float[i % is_float.size()] && !std::isfinite(value);
    }
    return count;
}

TEST_P(EveryMethod, ExplanationsAreFiniteAndLeaveTheResultAlone) {
    for (const auto& selector : description().selectors) {
        if (selector.parameter.empty()) {
            EXPECT_GT(selector.count, 0) << selector.key;
            continue;
        }
        const auto* count = find(description().parameters, selector.parameter);
        ASSERT_NE(count, nullptr) << selector.key;
        EXPECT_EQ(count->type, ParameterType::integer) << selector.key;
    }
    std::map<std::string, bool> is_filled;  // a list may be empty where nothing reaches the pixel
    for (const auto& scene : scenes) {
        const auto settings = quick_settings(description());
        const auto& expected = usual(scene);
        for (const int item : {1, Inspection::all}) {
            Inspection inspection{small.x / 2, small.y * 5 / 8, {}};
            for (const auto& selector : description().selectors) inspection.chosen[selector.key] = item;
            const auto frame =
                render(method(), settings, {.scene = scene, .inspection = inspection, .size = small});
            EXPECT_EQ(frame.main.pixels, expected.main.pixels) << scene;
            for (const auto& resource : frame.report.resources) {
                if (!resource.explains) continue;
                EXPECT_TRUE(resource.available) << resource.key;
                const auto found = frame.buffers.find(resource.key);
                if (found == frame.buffers.end()) continue;
                is_filled[resource.key] |= !found->second.empty();
                EXPECT_EQ(count_not_finite(found->second, resource.fields), 0u)
                    << resource.key << " on " << scene;
            }
        }
    }
    for (const auto& [key, filled] : is_filled) EXPECT_TRUE(filled) << key << " is always empty";
}

bool same_bits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

TEST_P(EveryMethod, SameSeedSameBits) {
    const auto settings = quick_settings(description());
    const Shot run{.scene = scenes.back(), .frames = 2, .size = small, .wanted = Wanted::results};
    const auto a = render(method(), settings, run), b = render(method(), settings, run);
    EXPECT_TRUE(same_bits(a.main, b.main));
}

TEST_P(EveryMethod, BothBackendsAgree) {
    EXPECT_EQ(machine().context().info().backend, gl::Backend::egl);
    const auto settings = quick_settings(description());
    for (const auto& scene : scenes) {
        const auto osmesa = render(method(), settings, {.scene = scene, .backend = "osmesa", .size = small});
        EXPECT_LT(difference(usual(scene), osmesa), 0.01) << scene;
    }
}

bool same_outputs(const Frame& a, const Frame& b) {
    if (a.images.size() != b.images.size()) return false;  // other outputs are active
    for (const auto& [key, images] : a.images) {
        const auto other = b.images.find(key);
        if (other == b.images.end() || !std::ranges::equal(images, other->second, same_bits)) return false;
    }
    return a.buffers == b.buffers;
}

/// Mean absolute difference that a cost parameter may make: builders may differ in single fragments.
constexpr double cost_tolerance = 1e-3;

/// Whether the choice gives the same picture as others of its parameter.
bool is_way_to_the_same(const ParameterDescription& p, const Value& value) {
    return std::any_of(p.choices.begin(), p.choices.end(), [&](const Choice& choice) {
        return choice.effect == Effect::cost && value == Value(choice.key);
    });
}

/// Whether the parameter's values give different outputs somewhere, and those that should not do not.
bool changes_outputs(std::vector<Studio>& studios, const ParameterDescription& p) {
    const auto& method = studios.front().method().description;
    const auto quick = quick_settings(method);
    auto unlimited = quick;  // light from any distance, where the method has it
    for (const auto& [key, value] : {std::pair<const char*, Value>{"paths", std::string("full")},
                                     std::pair<const char*, Value>{"max_distance", 0.0}})
        if (const auto* each = find(method.parameters, key)) {
            const auto tried = tried_values(*each);
            if (each->type == ParameterType::number ||
                std::find(tried.begin(), tried.end(), value) != tried.end())
                unlimited[key] = value;
        }
    const auto middle_of_all = middle_settings(method, quick), older = older_settings(method, unlimited);
    for (const auto* start :
         std::initializer_list<const Settings*>{&quick, &middle_of_all, &unlimited, &older}) {
        const int frames_rendered = start == &quick ? 1 : 2;  // some show in a history alone
        auto settings = *start;
        if (!activate(method, p, settings)) return false;
        for (auto& studio : studios) {
            std::vector<Frame> frames;
            std::vector<bool> same_picture;
            bool all_differ = true;
            for (const auto& value : tried_values(p)) {
                settings[p.key] = value;
                frames.push_back(studio.render(settings, frames_rendered));
                same_picture.push_back(is_way_to_the_same(p, value));
                for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
                    if (same_picture[i] && same_picture.back())
                        EXPECT_LT(difference(frames[i], frames.back()), cost_tolerance)
                            << p.key << " = " << to_string(value) << " on " << studio.scene();
                    else
                        all_differ = all_differ && !same_outputs(frames[i], frames.back());
                }
            }
            if (all_differ) return true;
        }
    }
    return false;
}

TEST_P(EveryMethod, EveryImageParameterChangesAnOutput) {
    auto all = studios(method(), small);  // in which most show already
    for (auto& larger : studios(method(), {48, 32})) all.push_back(std::move(larger));
    all.emplace_back(method(),  // which has glass
                     Shot{.scene = "builtin:caustics", .size = small, .wanted = Wanted::results});
    for (const auto& p : description().parameters) {
        if (p.effect != Effect::image || tried_values(p).size() < 2) continue;
        EXPECT_TRUE(changes_outputs(all, p)) << p.key;
    }
}

/// What a cost parameter may change: counters, bytes, passes and their slices, but no picture.
std::string costs(const FrameReport& report) {
    std::string text = std::to_string(report.memory_bytes);
    for (const auto& [key, value] : report.counters) text += ";" + key + "=" + std::to_string(value);
    for (const auto& pass : report.passes) text += ";" + pass.name + (pass.culled ? " culled" : "");
    for (const auto& resource : report.resources) text += ";" + resource.key + std::to_string(resource.bytes);
    return text;
}

TEST_P(EveryMethod, EveryCostParameterChangesOnlyCosts) {
    auto all = studios(method(), small);
    machine("").set_processor(Processor::gl);  // on which all costs count
    for (const auto& p : description().parameters) {
        if (p.effect != Effect::cost || tried_values(p).size() < 2) continue;
        bool changes_costs = false;  // a scene of which all is seen has nothing to cull
        for (auto& studio : all) {
            auto settings = quick_settings(description());
            ASSERT_TRUE(activate(description(), p, settings)) << p.key;
            std::vector<Frame> frames;
            for (const auto& value : tried_values(p)) {
                settings[p.key] = value;
                frames.push_back(studio.render(settings));
                if (frames.size() == 1) continue;
                const auto which = p.key + " = " + to_string(value) + " on " + studio.scene();
                EXPECT_LT(difference(frames[0], frames.back()), cost_tolerance) << which;
                changes_costs = changes_costs || costs(frames[0].report) != costs(frames.back().report);
            }
        }
        EXPECT_TRUE(changes_costs) << p.key;
    }
    machine("").set_processor({});
}

/// GLSL that writes each parameter, as the generated block and defines give it, into a buffer.
std::string reading_program(const std::vector<ParameterDescription>& parameters) {
    std::string text =
        "layout(local_size_x = 1) in;\nlayout(std430) buffer Out { float seen[]; };\n"
        "void main() {\n";
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        auto name = parameters[i].key;
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
        const bool define = parameters[i].on_change == OnChange::recompile;
        if (define) std::transform(name.begin(), name.end(), name.begin(), ::toupper);
        text += "    seen[" + std::to_string(i) + "] = float(" + (define ? name : "params." + name) + ");\n";
    }
    return text + "}\n";
}

float expected_in_glsl(const ParameterDescription& p, const Value& value) {
    switch (p.type) {
        case ParameterType::toggle:
            return std::get<bool>(value) ? 1 : 0;
        case ParameterType::choice:
            return static_cast<float>(p.choice_index(std::get<std::string>(value)));
        case ParameterType::integer:
            return static_cast<float>(std::get<std::int64_t>(value));
        default:
            return static_cast<float>(std::get<double>(value));
    }
}

TEST_P(EveryMethod, ShadersSeeEveryParameter) {
    const auto& parameters = description().parameters;
    if (parameters.empty()) return;
    gl::ShaderFolder folder;
    folder.write("read.comp", reading_program(parameters));
    auto& device = machine().device();
    gl::ProgramLibrary programs(machine().context(), folder.path());
    for (const bool last : {false, true}) {
        auto settings = defaults(parameters);
        for (const auto& p : parameters)
            settings[p.key] = last ? tried_values(p).back() : tried_values(p).front();
        gl::ProgramSource source{{"read.comp"}};
        source.preamble = gl::parameter_glsl(parameters, settings);
        const auto& program = programs.get(source);
        EXPECT_NO_THROW(gl::check_parameter_block(machine().context().api(), program.name(), parameters));
        auto words = gl::parameter_block(parameters, settings);
        words.push_back(0);
        std::vector<float> seen(parameters.size(), -12345);
        const auto block = device.create_buffer(4 * words.size(), "parameters");
        const auto out = device.create_buffer(4 * seen.size(), "seen");
        device.write_buffer(block, 0, std::as_bytes(std::span(words)));
        program.use();
        program.bind_buffer(gl::parameter_block_name, block);
        program.bind_buffer("Out", out);
        program.dispatch(1);
        device.barrier();
        device.read_buffer(out, 0, std::as_writable_bytes(std::span(seen)));
        for (std::size_t i = 0; i < seen.size(); ++i)
            EXPECT_EQ(seen[i], expected_in_glsl(parameters[i], settings.at(parameters[i].key)))
                << parameters[i].key;
        device.destroy_buffer(block);
        device.destroy_buffer(out);
    }
}

}  // namespace
}  // namespace ir::test
