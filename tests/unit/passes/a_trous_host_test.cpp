// The à-trous filter on the host's threads is that of the device, but for rounding.
#include "renderers/passes/a_trous/a_trous.h"

#include <cmath>
#include <random>

#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

namespace a_trous = passes::a_trous;

constexpr int a_trous_width = 83, a_trous_height = 61;

class ATrousOnHost : public PassTest {
  protected:
    Processor processor() const override { return processor_; }

    /// Numbers from 0.1 to 1; the fourth channel is as large as a variance.
    static std::vector<glm::vec4> noise(unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(0.1f, 1);
        std::vector<glm::vec4> texels(std::size_t{a_trous_width} * a_trous_height);
        for (auto& texel : texels) texel = {unit(random), unit(random), unit(random), 0.2f * unit(random)};
        return texels;
    }

    Image filtered(const Shot& shot, const a_trous::Options& options, Processor processor) {
        processor_ = processor;
        const auto values = noise(3);
        std::vector<glm::vec2> directions;
        for (const auto& value : noise(4)) directions.emplace_back(value);
        graph().reset_history();
        const auto report = run(shot, [&](graph::GraphBuilder& builder) {
            const auto gbuffer = passes::gbuffer(builder, passes::upload_scene(builder));
            a_trous::Signal input =
                a_trous::declare_signal(builder, {"input", "Input"}, !options.is_guided());
            builder.pass("make input").writes(input.value).execute([&, input](graph::PassContext& p) {
                p.upload(input.value, std::as_bytes(std::span(values)));
            });
            if (input.direction)
                builder.pass("make directions")
                    .writes(*input.direction)
                    .execute([&, input](graph::PassContext& p) {
                        p.upload(*input.direction, std::as_bytes(std::span(directions)));
                    });
            a_trous::smooth(builder, a_trous::pack_surfaces(builder, gbuffer), input, {"result", "Result"},
                            {"level", "Level"}, options);
        });
        EXPECT_EQ(ran_on_host(report, options.name), processor == Processor::host);
        return read("result");
    }

    void expect_equal(const Shot& shot, const a_trous::Options& options) {
        const auto device = filtered(shot, options, Processor::gl);
        const auto host = filtered(shot, options, Processor::host);
        double most = 0, moved = 0;
        const auto input = noise(3);
        for (std::size_t i = 0; i < device.pixels.size(); ++i) {
            most = std::max(most, 1.0 * std::abs(device.pixels[i] - host.pixels[i]));
            moved = std::max(moved, 1.0 * std::abs(device.pixels[i] - input[i / 4][static_cast<int>(i % 4)]));
        }
        EXPECT_LT(most, 2e-5);
        EXPECT_GT(moved, 0.2) << "nothing was filtered";
    }

    /// A folded sheet before nothing, with a step of depth.
    static Shot sheet(bool orthographic) {
        SmallWorld small;
        small.quad({-2, -1.5f, -1}, {0, -1.5f, 0}, {0, 1.5f, 0}, {-2, 1.5f, -1});
        small.quad({0, -1.5f, 0}, {1, -1.5f, -1}, {1, 1.5f, -1}, {0, 1.5f, 0});
        small.square({0.5f, 0.4f, 0.6f}, {0, 0.3f, 1}, 0.4f);
        return {small.scene(), looking_at({0.4f, 0.2f, 4}, {-0.3f, 0, 0}, orthographic, 4, {0, 0, 1}),
                a_trous_width, a_trous_height};
    }

    Processor processor_ = Processor::gl;
};

TEST_F(ATrousOnHost, DetailsAreClippedAsOnTheDevice) {
    for (const bool orthographic : {false, true})
        for (const auto kernel : {a_trous::Kernel::printed, a_trous::Kernel::b3_spline})
            for (const bool bounds : {false, true}) {
                a_trous::Options options;
                options.passes = 4;
                options.kernel = kernel;
                options.detail_clip = 0.1f;
                options.bounds_dark_details = bounds;
                expect_equal(sheet(orthographic), options);
            }
    a_trous::Options loose;
    loose.passes = 1;
    loose.sigma_normal = 0;
    loose.sigma_depth = 5;
    expect_equal(sheet(false), loose);
}

TEST_F(ATrousOnHost, VarianceGuidesAsOnTheDevice) {
    for (const int passes : {1, 5}) {
        a_trous::Options options;
        options.passes = passes;
        options.sigma_value = 1.5f;
        expect_equal(sheet(false), options);
    }
}

}  // namespace
}  // namespace ir::test
