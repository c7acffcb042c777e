// Haar pyramid and warping by themselves.
#include <random>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/emission/probability.h"
#include "tests/unit/methods/photon_mapping_emission_fixture.h"

namespace ir::test {
namespace {

class HaarTest : public PassTest {
  protected:
    std::vector<OutputDescription> outputs() const override { return pm::probability_outputs(); }
    /// Layers of the same side, row 0 first.
    pm::EmissionMaps transform(const std::vector<std::vector<float>>& layers, int side) {
        pm::EmissionMaps maps;
        run(Shot("builtin:plane", "top", 8, 8), [&](graph::GraphBuilder& builder) {
            graph::ImageDesc desc;
            desc.format = gl::Format::r32f;
            desc.extent = graph::Extent::fixed(side, side);
            desc.layers = static_cast<int>(layers.size());
            const auto map = builder.output("emission.probability", desc);
            builder.pass("upload").writes(map).execute([=](graph::PassContext& context) {
                for (std::size_t i = 0; i < layers.size(); ++i)
                    context.upload(map, std::as_bytes(std::span(layers[i])), 0, static_cast<int>(i));
            });
            maps = pm::haar_pyramid(builder, map, side, desc.layers, "");
        });
        return maps;
    }
    Image level(int level, int layer = 0) {
        auto image = graph().read_image("emission.haar", level, layer);
        if (!image) throw std::runtime_error("no level");
        return std::move(*image);
    }
};

/// [Smal19 fig. 5.4; the print lost the 1]
TEST_F(HaarTest, TransformsThePublishedExample) {
    const std::vector<float> row{8, 10, 9, 5, 0, 0, 4, 4};
    std::vector<float> map;
    for (int y = 0; y < 8; ++y) map.insert(map.end(), row.begin(), row.end());
    EXPECT_EQ(transform({map}, 8).levels, 3);
    std::vector<float> found{level(2).at(0, 0, 0)};
    for (int l = 2; l >= 0; --l)
        for (int x = 0; x < 4 >> l; ++x) found.push_back(level(l).at(x, 0, 1));
    EXPECT_EQ(found, (std::vector<float>{5, 3, 1, -2, -1, 2, 0, 0}));
    for (int l = 0; l < 3; ++l)
        for (int x = 0; x < 4 >> l; ++x) {
            EXPECT_EQ(level(l).at(x, 0, 2), 0) << "rows are equal";
            EXPECT_EQ(level(l).at(x, 0, 3), 0);
        }
}

TEST_F(HaarTest, EveryLevelKeepsTheSumAndRebuildsTheOneBelow) {
    for (const int side : {2, 32, 64, 256}) {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> unit(0, 1);
        std::vector<std::vector<float>> layers(2, std::vector<float>(static_cast<std::size_t>(side * side)));
        for (auto& layer : layers)
            for (auto& value : layer) value = unit(random);
        const auto maps = transform(layers, side);
        for (int layer = 0; layer < 2; ++layer) {
            Image below = read("emission.probability", layer);
            double sum = 0;
            for (const float value : layers[static_cast<std::size_t>(layer)]) sum += value;
            for (int l = 0; l < maps.levels; ++l) {
                const auto here = level(l, layer);
                ASSERT_EQ(here.width, side >> (l + 1));
                double mean = 0, error = 0;
                for (int y = 0; y < here.height; ++y)
                    for (int x = 0; x < here.width; ++x) {
                        const float s = here.at(x, y, 0), h = here.at(x, y, 1), v = here.at(x, y, 2),
                                    d = here.at(x, y, 3);
                        mean += s;
                        error = std::max<double>({error, std::abs(s + h + v + d - below.at(2 * x, 2 * y)),
                                                  std::abs(s - h + v - d - below.at(2 * x + 1, 2 * y)),
                                                  std::abs(s + h - v - d - below.at(2 * x, 2 * y + 1)),
                                                  std::abs(s - h - v + d - below.at(2 * x + 1, 2 * y + 1))});
                    }
                EXPECT_NEAR(mean * std::pow(4.0, l + 1) / sum, 1, 1e-5) << side << " level " << l;
                EXPECT_LT(error, 1e-6) << side << " level " << l;
                below = here;
            }
        }
    }
}

class WarpTest : public EmissionTest {
  protected:
    static std::vector<std::uint32_t> texels_of(const std::vector<std::uint32_t>& candidates, int layer,
                                                int side) {
        std::vector<std::uint32_t> texels;
        for (const auto word : candidates)
            if ((word >> 20 & 63) == static_cast<std::uint32_t>(layer))
                texels.push_back((word & 1023) + static_cast<std::uint32_t>(side) * (word >> 10 & 1023));
        return texels;
    }
    std::vector<float> map(int layer = 0) const { return read("emission.probability", layer).pixels; }
};

/// n = 40,000 points in 256 cells, alpha = 1e-4, one-sided: a low-discrepancy set lies far below the mean.
TEST_F(WarpTest, PointsFollowTheMap) {
    const auto shot = room({spot(10, 50)});
    auto parameters = quick();
    emit(shot, parameters);
    const auto table = elements<pm::HistogramCell>("emission.histogram");
    ASSERT_EQ(table.size(), 257u);
    const auto& all = table.back();
    EXPECT_EQ(all.found, 40'000);
    ASSERT_GT(all.degrees, 50);
    EXPECT_LT(all.chi_square, chi_square_limit(all.degrees));
    EXPECT_LT(all.chi_square, 0.5 * all.degrees) << "it is more even than random points";
    RecordProperty("chi_square", std::to_string(all.chi_square));
    RecordProperty("degrees", all.degrees);
    const auto weights = map();
    for (const auto texel : texels_of(elements<std::uint32_t>("emission.candidates"), 0, 128))
        ASSERT_GT(weights[texel], 0) << "no point comes to an empty texel";
    // the mutant: the same set, not warped
    parameters.emission = pm::Emission::uniform;
    emit(shot, parameters);
    const auto unwarped =
        pm::histogram(weights, 128, texels_of(elements<std::uint32_t>("emission.candidates"), 0, 128)).back();
    EXPECT_GT(unwarped.chi_square, chi_square_limit(all.degrees));
}

/// The same for every face of a point light, whose maps differ; and a flat map as mutant.
TEST_F(WarpTest, EveryLayerFollowsItsOwnMap) {
    const auto shot = room({lamp()});
    emit(shot, quick());
    const auto candidates = elements<std::uint32_t>("emission.candidates");
    int tested = 0;
    for (int layer = 0; layer < 6; ++layer) {
        auto weights = map(layer);
        const auto texels = texels_of(candidates, layer, 128);
        EXPECT_NEAR(static_cast<double>(texels.size()), 40'000 / 6.0, 1);
        if (std::ranges::all_of(weights, [](float value) { return value == 0; })) continue;
        ++tested;
        const auto all = pm::histogram(weights, 128, texels).back();
        EXPECT_LT(all.chi_square, chi_square_limit(all.degrees)) << layer;
        const std::vector<float> flat(weights.size(), 1.0f);
        const auto mutant = pm::histogram(flat, 128, texels).back();
        EXPECT_GT(mutant.chi_square, chi_square_limit(mutant.degrees)) << layer;
    }
    EXPECT_GE(tested, 3);
}

TEST_F(WarpTest, ViewsShowEveryStep) {
    const auto shot = room({spot(10, 50)});
    auto parameters = quick();
    parameters.photons = 1000;
    const int steps = 2 * 7 + 1;
    struct Element {
        glm::vec3 position;
        std::uint32_t source, warp, point, survives;
        float probability;
    };
    auto report = emit(shot, parameters, 1, 0, {-1, -1, {{"source", 0}, {"warp", Inspection::all}}});
    EXPECT_EQ(report.counters.at("emission.samples_shown"), 1000 * steps);
    auto all = elements<Element>("emission.samples");
    const auto candidates = elements<std::uint32_t>("emission.candidates");
    for (int i = 0; i < 1000; ++i) {
        const auto& last = all[static_cast<std::size_t>(i * steps + steps - 1)];
        ASSERT_EQ(last.point, static_cast<std::uint32_t>(i));
        ASSERT_EQ(last.warp, static_cast<std::uint32_t>(steps - 1));
        EXPECT_GT(last.probability, 0);
        // the last step's place lies in the texel that the frame found
        const float u = last.position.x - 1.125f * 7, v = 1 - (last.position.y + 1.125f);
        EXPECT_NEAR(u * 128, (candidates[static_cast<std::size_t>(i)] & 1023) + 0.5, 0.502);
        EXPECT_NEAR(v * 128, (candidates[static_cast<std::size_t>(i)] >> 10 & 1023) + 0.5, 0.502);
        EXPECT_EQ(last.survives, candidates[static_cast<std::size_t>(i)] >> 26 & 1);
    }
    report = emit(shot, parameters, 1, 0, {-1, -1, {{"source", 0}, {"warp", 0}}});
    EXPECT_EQ(report.counters.at("emission.samples_shown"), 1000);
    EXPECT_NE(graph().read_image("emission.points", 0, steps - 1), std::nullopt);
}

}  // namespace
}  // namespace ir::test
