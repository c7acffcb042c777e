// Batches of samples, in which deep screen space works where memory is short, change nothing but memory.
#include <stdexcept>

#include "renderers/core/error.h"
#include "tests/image/methods/ldm_explain.h"

namespace ir::test {
namespace {

constexpr int samples = 10;  // groups of 4, 4 and 2

class DssBatches : public LdmExplain {
  protected:
    std::string id() const override { return "deep-screen-space"; }

    Image frame(const Settings& settings, const graph::FrameOptions& options, Processor on) {
        const auto key = settings.contains("paths") ? "indirect.radiance" : "accessibility";
        auto inputs = inputs_of({.x = 12, .y = 20, .chosen = {}}, 0);
        inputs.processor = on;
        reset();
        report = graph().run(method(), settings, inputs, options);
        return graph().read_image(key).value();
    }
    /// The same with too little memory for all samples at once, and enough for a batch: between refusal and
    /// what was needed before.
    Image frame_in_batches(const Settings& settings, graph::FrameOptions options, Processor on) {
        auto most = report.peak_memory_bytes, least = most / 4;
        while (most - least > 1000) {
            options.memory_budget = (least + most) / 2;
            try {
                auto result = frame(settings, options, on);
                if (report.counters.at("batches") > 1) return result;
                most = options.memory_budget;
            } catch (const BudgetError&) {
                least = options.memory_budget;
            }
        }
        throw std::runtime_error("no batches");
    }
};

Settings settings_of(bool light) {
    Settings settings{{"samples", std::int64_t{samples}}, {"levels", std::int64_t{3}}};
    if (light) settings["paths"] = std::string("indirect");
    return settings;
}

TEST_F(DssBatches, ChangeNoBitAndNoCounter) {
    load("builtin:cornell");
    for (const bool light : {false, true})
        for (const auto on : {Processor::gl, Processor::host}) {
            const auto whole = frame(settings_of(light), {}, on);
            EXPECT_EQ(report.counters.at("batches"), 1);
            const auto counters = report.counters;
            const auto parts = frame_in_batches(settings_of(light), {}, on);
            EXPECT_EQ(parts.pixels, whole.pixels);
            std::vector<const char*> keys{"surfels.kept"};
            if (on == Processor::gl) keys.insert(keys.end(), {"splats.drawn", "splats.culled"});
            for (const char* key : keys) {
                ASSERT_TRUE(counters.contains(key)) << key;
                EXPECT_EQ(report.counters.at(key), counters.at(key)) << key;
            }
        }
}

TEST_F(DssBatches, WhoLooksAtASampleSeesTheSame) {
    load("builtin:cornell");
    for (const auto on : {Processor::gl, Processor::host}) {
        graph::FrameOptions options;
        options.wanted = {"splats.nearest", "bounce.distance"};
        frame(settings_of(false), options, on);
        std::vector<Image> whole;
        const auto look = [&] {
            std::vector<Image> layers;
            for (const auto* key : {"splats.nearest", "bounce.distance"})
                for (int s = 0; s < samples; ++s) layers.push_back(graph().read_image(key, 0, s).value());
            return layers;
        };
        const auto before = look();
        frame_in_batches(settings_of(false), options, on);
        const auto after = look();
        for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i].pixels, after[i].pixels) << i;
    }
}

TEST_F(DssBatches, ExplainTheSame) {
    load("builtin:cornell");
    for (const auto on : {Processor::gl, Processor::host}) {
        graph::FrameOptions options;
        options.wanted = {"splats.explain.*", "bounce.explain.*"};
        frame(settings_of(false), options, on);
        const auto candidates = elements("splats.explain.candidates"),
                   levels = elements("splats.explain.levels"), surfel = elements("splats.explain.surfel");
        const auto cover = image("splats.explain.cover");
        const auto sum = [&](const char* key) {
            const auto rays = elements(key);
            double all = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) all += rays.number(i, "contribution");
            return std::pair{rays.size(), all};
        };
        const auto own = sum("bounce.explain.rays"), others = sum("bounce.explain.neighbours");
        EXPECT_GT(candidates.size(), 0u);
        const auto picture = frame_in_batches(settings_of(false), options, on);
        EXPECT_EQ(elements("splats.explain.candidates").bytes(), candidates.bytes());
        EXPECT_EQ(elements("splats.explain.levels").bytes(), levels.bytes());
        EXPECT_EQ(elements("splats.explain.surfel").bytes(), surfel.bytes());
        EXPECT_EQ(image("splats.explain.cover").pixels, cover.pixels);
        EXPECT_EQ(sum("bounce.explain.rays").first, own.first);
        EXPECT_EQ(sum("bounce.explain.neighbours").first, others.first);
        EXPECT_NEAR(sum("bounce.explain.rays").second, own.second, 1e-5);
        EXPECT_NEAR(own.second + others.second, picture.at(12, 20), 1e-4);
    }
}

}  // namespace
}  // namespace ir::test
