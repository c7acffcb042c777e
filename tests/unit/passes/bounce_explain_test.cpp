// What a picked pixel is made of: its lines add up to it, and their weights are the blur's.
#include <cstring>
#include <map>
#include <random>

#include "tests/unit/passes/bounce_fixture.h"

namespace ir::test {
namespace {

using bounce::Spread;

/// Struct Line of shaders/passes/bounce/explain.comp.
template <int channels>
struct Line {
    glm::vec3 start, end;
    float distance, density;
    float incoming[channels], contribution[channels];
    float weight, apart;
    std::uint32_t hit, sample;
};

/// A floor, a wall and background.
Shot corner() {
    return {"builtin:corner", "view", 40, 40};
}

class BounceExplainTest : public BounceTest {
  protected:
    template <int channels>
    std::vector<Line<channels>> lines(const std::string& key) {
        auto all = elements<Line<channels>>(key);
        all.resize(std::min<std::size_t>(all.size(), count_.at(key)));
        return all;
    }
    void explain(const Shot& shot, BounceRun r, glm::ivec2 pixel) {
        r.inspection = {pixel.x, pixel.y, {}};
        const auto report = reconstruct(shot, r);
        for (const auto* key : {"bounce.explain.rays", "bounce.explain.neighbours"})
            count_[key] = static_cast<std::size_t>(report.counters.at(std::string(key) + "_count"));
    }
    template <int channels>
    double sum(int channel) {
        double total = 0;
        for (const auto* key : {"bounce.explain.rays", "bounce.explain.neighbours"})
            for (const auto& line : lines<channels>(key)) total += line.contribution[channel];
        return total;
    }

  private:
    std::map<std::string, std::size_t> count_;
};

/// Hits and radiance that differ from sample to sample.
Met random_meeting(glm::ivec2 pixel, int sample, glm::vec4) {
    std::mt19937 random(static_cast<unsigned>(1000 * pixel.y + 20 * pixel.x + sample));
    std::uniform_real_distribution<float> unit(0, 1);
    Met met;
    met.distance = unit(random) < 0.4f ? -1 : 0.9f * unit(random);
    met.radiance = {unit(random), unit(random), unit(random)};
    return met;
}

TEST_F(BounceExplainTest, LinesAddUpToThePixel) {
    for (const auto estimator : {bounce::Estimator::ratio, bounce::Estimator::published})
        for (const glm::ivec2 pixel : {glm::ivec2(20, 30), {20, 20}, {0, 0}}) {
            auto r = BounceRun::with(4, Spread::stratified, 3);
            r.reconstruction.estimator = estimator;
            r.meeting = random_meeting;
            r.transport.falloff = Transport::Falloff::smooth;
            explain(corner(), r, pixel);
            EXPECT_NEAR(sum<1>(0), read("result").at(pixel.x, pixel.y), 1e-5);
        }
    auto r = BounceRun::with(4, Spread::stratified, 3);
    r.options.light = true;
    r.meeting = random_meeting;
    explain(corner(), r, {20, 30});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum<3>(c), read("result").at(20, 30, c), 1e-5);
}

TEST_F(BounceExplainTest, TheLargestPartIsThatOfALine) {
    auto r = BounceRun::with(4, Spread::stratified, 3);
    r.meeting = random_meeting;
    r.options.light = true;
    for (const float balance : {0.0f, 0.25f}) {
        r.reconstruction.balance = balance;
        explain(corner(), r, {20, 30});
        double most = 0, sum = 0;
        for (const auto* key : {"bounce.explain.rays", "bounce.explain.neighbours"})
            for (const auto& line : lines<3>(key)) {
                const auto* c = line.contribution;
                const double part = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
                most = std::max(most, part);
                sum += part;
            }
        EXPECT_NEAR(read("bounce.weights").at(20, 30, 1), most / sum, 1e-5);
    }
}

/// 59² neighbours with 16 samples each: the widest filter, whose loops stay just below llvmpipe's limit.
TEST_F(BounceExplainTest, TheWidestFilterIsComplete) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 50);
    const Shot shot(small.scene(), scene::Camera{}, 59, 59);
    auto r = BounceRun::with(bounce::max_samples, Spread::stratified, 29);
    r.reconstruction.blur.plane_tolerance = 1e3f;
    r.meeting = [](glm::ivec2 pixel, int sample, glm::vec4) {
        return Met{pixel.y == 58 && pixel.x > 40 && sample > 7 ? 0.5f
                                                               : -1.0f};  // among the last that are looked at
    };
    explain(shot, r, {29, 29});
    EXPECT_EQ(lines<1>("bounce.explain.neighbours").size(), 16u * (59 * 59 - 1));
    const double found = read("result").at(29, 29);
    EXPECT_LT(found, 1 - 1e-4);
    EXPECT_NEAR(found, sum<1>(0), 2e-5);
}

TEST_F(BounceExplainTest, WeightsAreTheBlurs) {
    const auto shot = corner();
    auto r = BounceRun::with(1, Spread::stratified, 4);
    const glm::ivec2 pixel(20, 22);
    std::map<int, double> weights{{0, 1}};  // of the pixel's row, by offset
    run_gbuffer(shot);
    const auto position = read("gbuffer.position");
    explain(shot, r, pixel);
    double whole = 1;
    for (const auto& line : lines<1>("bounce.explain.neighbours"))
        for (int i = -4; i <= 4; ++i)
            if (i != 0 && line.start == rgb(position, pixel.x + i, pixel.y))
                whole += weights[i] = line.weight;
    ASSERT_GE(weights.size(), 5u);
    for (const auto& [offset, weight] : weights) {
        run(shot, [&, at = pixel.x + offset](graph::GraphBuilder& builder) {
            const auto gbuffer = passes::gbuffer(builder, passes::upload_scene(builder));
            graph::ImageDesc desc;
            desc.text = {"given", "Given"};
            desc.format = gl::Format::r32f;
            const auto given = builder.image(desc);
            builder.pass("give").writes(given).execute([=](graph::PassContext& context) {
                std::vector<float> texels(40 * 40);
                texels[static_cast<std::size_t>(40 * pixel.y + at)] = 1;
                context.upload(given, std::as_bytes(std::span(texels)));
            });
            passes::blur(builder, gbuffer, given, r.reconstruction.blur, {"blurred", "Blurred"});
        });
        EXPECT_NEAR(weight / whole, read("blurred.blurred_rows").at(pixel.x, pixel.y), 1e-5 * weight / whole)
            << offset;
    }
}

TEST_F(BounceExplainTest, OtherMaterialsCountLessForLightOnly) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 50);
    auto scene = small.scene();
    scene::Texture texture;  // green is roughness: 0.2 on one side of y = 0, 0.8 on the other
    texture.width = 2;
    texture.height = 1;
    texture.rgba = {0, 51, 0, 255, 0, 204, 0, 255};
    texture.sampler = {.wrap_s = scene::Wrap::clamp_to_edge,
                       .mag = scene::Filter::nearest,
                       .min = scene::Filter::nearest,
                       .mipmaps = false};
    scene.textures[0] = texture;
    scene.materials[SmallWorld::opaque].metallic_roughness_texture.texture = 0;
    const Shot shot(scene, scene::Camera{}, 16, 16);
    auto r = BounceRun::with(1, Spread::stratified, 4);
    const auto other_side = [&](bool light, float tolerance) {
        r.options.light = light;
        r.reconstruction.material_tolerance = tolerance;
        explain(shot, r, {8, 8});
        double sum = 0;
        const auto add = [&](const auto& all) {
            for (const auto& line : all) sum += line.start.y > 0 ? line.weight : 0;
        };
        light ? add(lines<3>("bounce.explain.neighbours")) : add(lines<1>("bounce.explain.neighbours"));
        return sum;
    };
    EXPECT_LT(other_side(true, 0.1f), 1e-6);
    const double free = other_side(false, 0.1f);
    EXPECT_GT(free, 1) << "the pixel lies beside the border";
    // e^(−(0.6/0.6)²); directions of light may be lost
    EXPECT_NEAR(other_side(true, 0.6f) / free, std::exp(-1.0), 0.05);
}

TEST_F(BounceExplainTest, MissesAreDrawnAndEmptyPixelsAreEmpty) {
    auto r = BounceRun::with(8, Spread::stratified, 0);
    r.meeting = [](glm::ivec2, int sample, glm::vec4) { return Met{sample < 3 ? 0.25f : -1.0f}; };
    explain(corner(), r, {20, 30});
    const auto own = lines<1>("bounce.explain.rays");
    ASSERT_EQ(own.size(), 8u);
    EXPECT_TRUE(lines<1>("bounce.explain.neighbours").empty());
    for (const auto& line : own) {
        EXPECT_EQ(line.hit, line.sample < 3 ? 1u : 0u);
        EXPECT_NEAR(glm::distance(line.start, line.end), line.hit ? 0.25f : 0.5f, 1e-5);
        EXPECT_EQ(line.incoming[0], line.hit ? 0 : 1);
        EXPECT_EQ(line.weight, 1);
        EXPECT_EQ(line.apart, 0);
    }
    for (const glm::ivec2 pixel : {glm::ivec2(-1, -1), {1, 38}, {40, 5}, {5, 4000}}) {
        explain(corner(), r, pixel);
        EXPECT_TRUE(lines<1>("bounce.explain.rays").empty()) << pixel.x;
    }
}

}  // namespace
}  // namespace ir::test
