// Which places splats cover: all pixels within reach of their surfels, in one sub-image each, and none beside
// it; culling takes away only splats that reach nothing.
#include <random>

#include "renderers/methods/deep-screen-space/splatting/splats.h"
#include "shaders/methods/deep-screen-space/splatting/show_culling.comp.h"
#include "tests/unit/methods/dss_fixture.h"

namespace ir::test {
namespace {

dss::Parameters same_reach() {
    auto parameters = published();
    parameters.influence = dss::Influence::constant;
    return parameters;
}

struct Cover {
    std::vector<Disc> surfels;
    dss::Parameters parameters = same_reach();
    int samples = 1;
    std::uint64_t seed = 0, capacity = 0;
    std::uint32_t uncounted = 0;
};

std::vector<Disc> random_surfels(int n, glm::vec3 centre, float spread, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<Disc> surfels;
    for (int i = 0; i < n; ++i) {
        const glm::vec3 offset(unit(random), unit(random), unit(random));
        surfels.push_back(disc(centre + spread * offset, random_direction(random), 0.05f,
                               static_cast<std::uint32_t>(i) + 1000 * seed));
    }
    return surfels;
}

/// A program that adds what a fragment shader says of splats to a target.
const gl::Program& adding(const graph::PassContext& p, const dss::Splats& splats,
                          const dss::SplatLayer& layer, const graph::PassContext::Attachment& target,
                          const std::string& fragments) {
    p.bind_framebuffer({target});
    const auto& program = p.use({{"methods/deep-screen-space/splatting/splat.vert", fragments}});
    program.set(dss::splat_constants(splats, layer));
    p.api().Enable(GL_BLEND);
    p.api().BlendEquation(GL_FUNC_ADD);
    p.api().BlendFunc(GL_ONE, GL_ONE);
    return program;
}

class SplatsTest : public DeepScreenSpaceTest {
  protected:
    /// As count_cover() does, into "cover", with 1 + index for the weight of surfels.
    FrameReport cover(const Shot& shot, const Cover& c) {
        auto inputs = shot.inputs();
        inputs.seed = c.seed;
        return run(inputs, [=](graph::GraphBuilder& builder) {
            const auto gbuffer = passes::gbuffer(builder, passes::upload_scene(builder));
            const auto hierarchy = dss::shuffle(builder, gbuffer, c.parameters);
            const auto surfels = upload(builder, c.surfels, c.capacity, c.uncounted);
            const auto splats = dss::declare_splats(builder, hierarchy, surfels, c.parameters,
                                                    passes::bounce::Batches(c.samples));
            const int layers = c.samples * hierarchy.levels;
            const auto image =
                builder.image({.text = {"cover", "Cover"},
                               .format = gl::Format::rg32f,
                               .extent = graph::Extent::fixed(hierarchy.width, hierarchy.height),
                               .layers = layers});
            dss::draw_splats(
                builder.pass("weigh").writes(image), splats,
                [=](const graph::PassContext& p, const dss::SplatLayer& layer) -> const gl::Program& {
                    const int index = layer.sample * hierarchy.levels + layer.level;
                    if (layer.is_first && index == 0) p.clear(image);
                    return adding(p, splats, layer, {image, index},
                                  SOURCE_ROOT "/tests/data/shaders/weighted_cover.frag");
                });
        });
    }

    /// Counted draws into a target of their own, "drawn".
    FrameReport draw(const Shot& shot, const Cover& c) {
        return run(shot, [=](graph::GraphBuilder& builder) {
            const auto gbuffer = passes::gbuffer(builder, passes::upload_scene(builder));
            const auto hierarchy = dss::shuffle(builder, gbuffer, c.parameters);
            const auto splats = dss::declare_splats(builder, hierarchy, upload(builder, c.surfels),
                                                    c.parameters, passes::bounce::Batches(c.samples));
            const auto drawn =
                builder.image({.text = {"drawn", "Drawn"},
                               .format = gl::Format::rg32f,
                               .extent = graph::Extent::fixed(hierarchy.width, hierarchy.height)});
            dss::show_culling(builder, splats);
            dss::draw_splats(
                builder.pass("draw").writes(drawn), splats,
                [=](const graph::PassContext& p, const dss::SplatLayer& layer) -> const gl::Program& {
                    if (layer.is_first && layer.level == 0) p.clear(drawn);
                    return adding(p, splats, layer, {drawn},
                                  "methods/deep-screen-space/splatting/cover.frag");
                });
        });
    }
    double total(std::size_t channel) const {
        const auto image = read("drawn");
        double sum = 0;
        for (std::size_t i = channel; i < image.pixels.size(); i += 2) sum += image.pixels[i];
        return sum;
    }

    /// What "cover" has to be, green.
    std::vector<float> expected_reached(const Cover& c, int level, int sample, float shell_radius) const {
        const auto positions = read("hierarchy.positions", level);
        const glm::ivec2 size(positions.width >> level, positions.height >> level);
        std::vector<float> sums(static_cast<std::size_t>(positions.width) * positions.height, 0);
        for (std::size_t s = 0; s < c.surfels.size(); ++s) {
            const auto words = pcg4d({c.surfels[s].identity, level, sample, c.seed});
            const auto corner = glm::ivec2(glm::uvec2(words) >> 16u << glm::uint(level) >> 16u) * size;
            for (int y = corner.y; y < corner.y + size.y; ++y)
                for (int x = corner.x; x < corner.x + size.x; ++x) {
                    const float distance = glm::distance(rgb(positions, x, y), c.surfels[s].centre_ws);
                    if (positions.at(x, y, 3) > 0 && distance <= std::ldexp(shell_radius, level))
                        sums[static_cast<std::size_t>(y * positions.width + x)] += static_cast<float>(s + 1);
                }
        }
        return sums;
    }
};

/// Views of a corner: from outside, from within the spheres, parallel.
std::vector<Shot> views() {
    SmallWorld small;
    small.square({0, -1, 0}, {0, 1, 0}, 3);
    small.square({0, 0, -1}, {0, 0, 1}, 2);
    std::vector<Shot> shots;
    shots.emplace_back(small.scene(), dss_camera({2, 2, 4}, {0, -0.5f, 0}), 45, 31);
    shots.emplace_back(small.scene(), dss_camera({0, -0.8f, -0.2f}, {0, -1, -1}), 32, 40);
    shots.emplace_back(small.scene(), dss_camera({3, 2, 3}, {0, 0, 0}, true, 3), 37, 29);
    shots.emplace_back(small.scene(), dss_camera({0, 0, 3}, {0, 0, 0}), 1, 1);
    return shots;
}

TEST_F(SplatsTest, AllPixelsWithinReachAreCoveredOnceAndNothingBesideTheSubImage) {
    for (const auto& shot : views())
        for (const float max_distance : {0.05f, 1.0f, 4.0f, 500.0f})
            for (const bool culls : {false, true}) {
                Cover c;
                c.surfels = random_surfels(40, {0, -0.5f, 0}, 1.5f, 3);
                c.parameters.levels = 4;
                c.parameters.transport.max_distance = max_distance;
                c.parameters.splat_culling = culls;
                c.samples = 2;
                c.seed = 5;
                cover(shot, c);
                for (int sample = 0; sample < 2; ++sample)
                    for (int level = 0; level < 4; ++level) {
                        const auto image = read("cover", sample * 4 + level);
                        const auto expected = expected_reached(c, level, sample, max_distance / 8);
                        for (std::size_t i = 0; i < expected.size(); ++i)
                            ASSERT_EQ(image.pixels[2 * i + 1], expected[i])
                                << level << ": " << i << ", " << max_distance << (culls ? " culled" : "");
                    }
            }
}

TEST_F(SplatsTest, CullingTakesAwayOnlySplatsWithoutAnyEffect) {
    const auto shots = views();
    Cover c;
    c.surfels = random_surfels(200, {0, -0.5f, 0}, 2, 8);
    c.parameters.levels = 4;
    c.parameters.transport.max_distance = 1;
    double culled = 0, cut = 0, whole = 0;
    for (const auto& shot : shots) {
        c.parameters.splat_culling = true;
        const auto with = draw(shot, c);
        const auto red_with = total(0);
        double shown_drawn = 0, shown_culled = 0;
        for (const auto& surfel : elements<dss::CulledSplats>("splats.by_surfel")) {
            shown_drawn += surfel.drawn;
            shown_culled += surfel.culled;
        }
        EXPECT_EQ(shown_drawn, with.counters.at("splats.drawn"));
        EXPECT_EQ(shown_culled, with.counters.at("splats.culled"));
        c.parameters.splat_culling = false;
        const auto without = draw(shot, c);
        EXPECT_EQ(with.counters.at("splats.drawn") + with.counters.at("splats.culled"),
                  without.counters.at("splats.drawn"));
        EXPECT_EQ(without.counters.at("splats.culled"), 0);
        EXPECT_LE(red_with, total(0));
        cut += red_with / with.counters.at("splats.drawn");
        whole += total(0) / without.counters.at("splats.drawn");
        culled += with.counters.at("splats.culled") / without.counters.at("splats.drawn");
    }
    EXPECT_GT(culled / static_cast<double>(shots.size()), 0.05) << "nothing to cull, nothing tested";
    EXPECT_LT(cut, whole) << "what is drawn is drawn whole";
}

TEST_F(SplatsTest, EachSurfelGoesToOneSubImageThatItsPlaceInTheBufferDoesNotDecide) {
    const Shot shot = views().at(0);
    Cover c;
    c.surfels = {disc({0, -0.9f, 0}, {0, 1, 0}, 0.05f, 1)};
    c.parameters.levels = 4;
    c.parameters.transport.max_distance = 8;
    cover(shot, c);
    std::vector<Image> alone;
    for (int level = 0; level < 4; ++level) alone.push_back(read("cover", level));
    // A surfel without reach before it: the other one is now the second, and counts 2.
    c.surfels.insert(c.surfels.begin(), disc({1e4f, 0, 0}, {0, 1, 0}, 0.05f, 9));
    cover(shot, c);
    for (int level = 0; level < 4; ++level) {
        const auto second = read("cover", level);
        for (std::size_t i = 1; i < second.pixels.size(); i += 2)
            ASSERT_EQ(second.pixels[i], 2 * alone[static_cast<std::size_t>(level)].pixels[i]);
    }
}

TEST_F(SplatsTest, SubImagesAreChosenUniformly) {
    // n = 4000 surfels over 16 sub-images of level 2, χ² at alpha = 1e-4: 44.3 at 15 degrees of freedom.
    std::vector<double> counts(16, 0);
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const auto words = pcg4d({disc({0, 0, 0}, {0, 1, 0}, 1, i).identity, 2, 0, 5});
        const auto at = glm::uvec2(words) >> 16u << 2u >> 16u;
        ++counts[at.y * 4 + at.x];
    }
    double chi = 0;
    for (const double n : counts) chi += (n - 250) * (n - 250) / 250;
    EXPECT_LT(chi, 44.3);
}

TEST_F(SplatsTest, OnlyStoredSurfelsAreRead) {
    // The counter says more than the buffer holds, as while it grows; and a larger buffer than there are.
    const Shot shot = views().at(0);
    Cover c;
    c.surfels = random_surfels(30, {0, -0.5f, 0}, 1.5f, 4);
    c.parameters.levels = 2;
    c.parameters.transport.max_distance = 1;
    c.capacity = 1000;
    cover(shot, c);
    const auto image = read("cover", 1);
    const auto expected = expected_reached(c, 1, 0, 0.5f);
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(image.pixels[2 * i + 1], expected[i]);
    c.capacity = 10;
    c.uncounted = 5000;
    cover(shot, c);
    c.surfels.resize(10);
    const auto part = read("cover", 1);
    const auto expected_part = expected_reached(c, 1, 0, 0.5f);
    for (std::size_t i = 0; i < expected_part.size(); ++i)
        ASSERT_EQ(part.pixels[2 * i + 1], expected_part[i]);
}

}  // namespace
}  // namespace ir::test
